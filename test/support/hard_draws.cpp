#include "support/hard_draws.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "rod/statics.h"
#include "support/errors.h"
#include "support/moment_balance.h"
#include "support/random_source.h"
#include "support/scaled_scene.h"

namespace live_stiffness {
namespace {

// Of the unpressurised robot, rad / (N m).
double softnessOf(const Scene& scene) {
  double softness = 0.0;
  for (const Body& body : scene.chain)
    if (const auto* segment = std::get_if<Segment>(&body))
      softness += segment->length *
                  SectionMoments(segment->section).complianceDensity(1.0).bending_torsion.diagonal().maxCoeff();
  return softness;
}

class Draw {
 public:
  Draw(unsigned seed) : random(seed) {}

  RandomSource random;

  bool coin() { return random.uniform(0.0, 1.0) < 0.5; }
  int integer(int low, int high) { return low + static_cast<int>(random.uniform(0.0, high - low + 0.999)); }
  double logUniform(double low, double high) { return std::exp(random.uniform(std::log(low), std::log(high))); }

  // The paper's robot with 1 or 2 segments, gravity in any direction.
  HardDraw paper() {
    static const Scene one = paperScene(1), two = paperScene(2);
    HardDraw draw;
    draw.scene = coin() ? one : two;
    draw.scene.gravity = random.direction(9.81);
    draw.options.accuracy = logUniform(1e-10, 1e-4);
    draw.options.stepping = kSteppings[integer(0, 2)];
    draw.pressures = pressures(draw.scene, 0.0, 1.2e5);
    return draw;
  }
  Pressures pressures(const Scene& scene, double low, double high) {
    return random.pairs(scene.chamberCount(), low, high);
  }
  // A wrench that bends the unpressurised robot by about `bending` rad.
  Wrench wrench(const Scene& scene, double bending) {
    const double softness = softnessOf(scene);
    return random.wrench(bending / (softness * scene.length()), coin() ? 0.0 : bending / softness);
  }
};

// Radii times `factor`; with the modulus as it is.
void scaleRadii(Segment& segment, double factor) {
  for (double* r : {&segment.section.outer_radius, &segment.section.lumen_radius, &segment.section.chambers.radius,
                    &segment.section.chambers.pitch_radius})
    *r *= factor;
}

// A chain of n of the paper's segments, all of a length over radius; weight and pressure bend it by the order of 1 rad.
HardDraw proportioned(Draw& d, double length_over_radius) {
  HardDraw draw = d.paper();
  draw.options.stepping = Stepping::kContinuous;
  draw.scene.tip_mass = 0.0;
  for (int k = 0; k < draw.scene.segmentCount(); ++k) {
    Segment& segment = segmentOf(draw.scene, k);
    scaleRadii(segment, segment.length / (length_over_radius * segment.section.outer_radius));
  }
  const double softness = softnessOf(draw.scene);
  const Segment& first = segmentOf(draw.scene, 0);
  const double unit = first.section.chambers.actuationMoment(Pressures::Unit(first.section.chambers.count(), 0), 1.0)
                          .norm();
  draw.pressures = d.pressures(draw.scene, 0.0, 1.0 / (softness * unit));
  draw.scene.gravity = d.random.direction(d.logUniform(0.01, 2.0) / (first.mass() * softness * draw.scene.length()));
  draw.wrench = d.wrench(draw.scene, d.logUniform(0.01, 1.0));
  return draw;
}

// `count` of the paper's segments without anything between, with its tip mass, hanging or held out sideways.
HardDraw chainOf(Draw& d, int count) {
  HardDraw draw = d.paper();
  draw.scene = paperScene(1);
  draw.scene.chain.assign(count, draw.scene.chain.front());
  draw.scene.gravity = kStandardGravity * (d.coin() ? Vector3::UnitX() : Vector3::UnitZ());
  draw.pressures = d.pressures(draw.scene, 0.0, 0.6e5);
  return draw;
}

void scaleModulus(Segment& segment, double factor) {
  segment.section.youngs_modulus *= factor;
  segment.section.shear_modulus *= factor;
}

// Length of the paper's segment that stands for certain at a pressure in all chambers, its unstretched length, m: weight and
// tip mass, each over what would buckle it alone, add up to 1 (Dunkerley, who is on the safe side).
double standingLength(const Scene& scene, double pressure) {
  const Segment& segment = std::get<Segment>(scene.chain.front());
  const CrossSection& section = segment.section;
  const RestState rest = LoadStepper(section).restState(Pressures::Constant(section.chambers.count(), pressure),
                                                        Stepping::kContinuous, 1);
  const double c = rest.stretch * rest.stretch * rest.c.bending_torsion(0, 0) * kStandardGravity;
  const auto load = [&](double length) {
    return c * length * length * (section.linearDensity() * length / 7.837 + 4.0 * scene.tip_mass / (kPi * kPi));
  };
  double low = 0.0, high = 100.0;
  for (int i = 0; i < 60; ++i) (load(0.5 * (low + high)) < 1.0 ? low : high) = 0.5 * (low + high);
  return low;
}

const std::map<std::string, std::function<HardDraw(Draw&)>>& makers() {
  static const std::map<std::string, std::function<HardDraw(Draw&)>> makers = {
      {"near_straight",
       [](Draw& d) {
         HardDraw draw = d.paper();
         const double size = d.logUniform(1e-12, 1e-2);
         draw.pressures *= size;
         draw.wrench = d.wrench(draw.scene, size);
         if (d.coin()) draw.scene.gravity.reset();
         else *draw.scene.gravity *= size;
         return draw;
       }},
      {"pressure",
       [](Draw& d) {
         HardDraw draw = d.paper();
         const double highest = d.logUniform(1e3, 5e5);
         draw.pressures = d.pressures(draw.scene, 0.0, highest);
         if (d.coin()) draw.pressures.setConstant(0.4 * highest);
         if (d.coin()) draw.scene.gravity.reset();
         return draw;
       }},
      {"vacuum",
       [](Draw& d) {
         HardDraw draw = d.paper();
         draw.pressures = d.pressures(draw.scene, -1.013e5, d.coin() ? 0.0 : 1e5);
         return draw;
       }},
      {"slender", [](Draw& d) { return proportioned(d, d.logUniform(10.0, 1000.0)); }},
      {"stubby", [](Draw& d) { return proportioned(d, d.logUniform(1.0, 10.0)); }},
      {"stiffness_ratio",
       [](Draw& d) {
         HardDraw draw = d.paper();
         draw.options.stepping = Stepping::kContinuous;
         while (draw.scene.segmentCount() < 4) draw.scene.chain.push_back(segmentOf(draw.scene, 0));
         draw.pressures = d.pressures(draw.scene, 0.0, 0.8e5);
         for (int k = 0; k < draw.scene.segmentCount(); ++k) {
           const double ratio = d.logUniform(1.0, 1e6);
           scaleModulus(segmentOf(draw.scene, k), ratio);
           draw.pressures.segment(6 * k, 6) *= ratio;
         }
         draw.wrench = d.wrench(draw.scene, d.logUniform(0.01, 1.0));
         return draw;
       }},
      {"modulus",
       [](Draw& d) {
         HardDraw draw = d.paper();
         draw.options.stepping = Stepping::kContinuous;
         const Units units{1.0, d.logUniform(1e3, 1e12) / 9e4};
         draw.wrench = units.scale(d.wrench(draw.scene, d.logUniform(0.01, 1.0)));
         draw.pressures *= units.pressure();
         draw.scene = units.scale(draw.scene);
         return draw;
       }},
      {"units",
       [](Draw& d) {
         HardDraw draw = d.paper();
         draw.options.stepping = Stepping::kContinuous;
         const Units units{d.logUniform(1e-6, 1e6), d.logUniform(1e-6, 1e6)};
         draw.wrench = units.scale(d.wrench(draw.scene, d.logUniform(0.01, 1.0)));
         draw.pressures *= units.pressure();
         draw.scene = units.scale(draw.scene);
         return draw;
       }},
      {"gravity",
       [](Draw& d) {
         HardDraw draw = d.paper();
         draw.scene.gravity = d.random.direction(d.random.uniform(0.0, 20.0) * kStandardGravity);
         return draw;
       }},
      {"wrench",
       [](Draw& d) {
         HardDraw draw = d.paper();
         draw.wrench = d.wrench(draw.scene, d.logUniform(0.01, 30.0));
         if (d.coin()) draw.scene.gravity.reset();
         return draw;
       }},
      {"column",  // standing straight or nearly so, up to several times its buckling load
       [](Draw& d) {
         HardDraw draw = d.paper();
         draw.pressures.setConstant(d.random.uniform(0.0, 1.2e5));
         if (d.coin()) draw.pressures += d.pressures(draw.scene, 0.0, d.logUniform(1e-3, 1e4));
         draw.scene.gravity = d.random.uniform(0.0, 60.0) * -Vector3::UnitZ();
         return draw;
       }},
      {"chain",
       [](Draw& d) {
         HardDraw draw = d.paper();
         const int count = d.integer(3, 6);
         while (draw.scene.segmentCount() < count) draw.scene.chain.push_back(segmentOf(draw.scene, 0));
         draw.pressures = d.pressures(draw.scene, 0.0, 0.8e5);
         return draw;
       }},
      {"long_chain",
       [](Draw& d) {
         HardDraw draw = chainOf(d, d.integer(5, 32));
         if (d.coin()) linear(draw.wrench) = d.random.vector(0.05);
         if (d.coin()) draw.before.emplace_back(d.pressures(draw.scene, 0.0, 0.6e5), Wrench::Zero());
         return draw;
       }},
      {"long_rod",
       [](Draw& d) {
         HardDraw draw = chainOf(d, 1);
         segmentOf(draw.scene, 0).length = d.logUniform(0.2, 2.0);
         if (d.coin()) linear(draw.wrench) = d.random.vector(0.05);
         return draw;
       }},
      {"standing",  // below the critical length, as one rod or cut into up to 32 segments
       [](Draw& d) {
         constexpr double kHighest = 0.6e5;
         HardDraw draw = chainOf(d, d.integer(1, 32));
         draw.scene.gravity = -kStandardGravity * Vector3::UnitZ();
         draw.scene.tip_mass *= d.random.uniform(0.0, 1.0);
         const int count = draw.scene.segmentCount();
         const double length = d.random.uniform(0.3, 0.95) * standingLength(draw.scene, kHighest);
         for (int k = 0; k < count; ++k) segmentOf(draw.scene, k).length = length / count;
         if (d.coin()) draw.pressures.setConstant(d.random.uniform(0.0, kHighest));
         return draw;
       }},
      {"catheter",  // 1 mm x 1 m, of silicone rubber to nitinol
       [](Draw& d) {
         HardDraw draw = chainOf(d, 1);
         draw.options.stepping = Stepping::kContinuous;
         draw.scene.tip_mass = d.logUniform(1e-7, 1e-4);
         Segment& segment = segmentOf(draw.scene, 0);
         segment.length = 1.0;
         scaleRadii(segment, 0.5e-3 / segment.section.outer_radius);
         const double modulus = d.logUniform(2e6, 50e9);
         scaleModulus(segment, modulus / segment.section.youngs_modulus);
         draw.pressures = d.pressures(draw.scene, 0.0, std::min(1e6, 0.05 * modulus));
         if (d.coin()) draw.wrench = d.wrench(draw.scene, d.logUniform(0.01, 1.0));
         return draw;
       }},
      {"mixed_chain",  // soft segments, stiff ones and links, a tip off the axis
       [](Draw& d) {
         HardDraw draw = chainOf(d, d.integer(5, 32));
         draw.options.stepping = Stepping::kContinuous;
         *draw.scene.gravity += d.random.vector(4.0);
         draw.scene.tip_offset = d.random.vector(0.01);
         const std::vector<Body> segments = draw.scene.chain;
         draw.scene.chain.clear();
         for (size_t k = 0; k < segments.size(); ++k) {
           Segment segment = std::get<Segment>(segments[k]);
           const double ratio = d.coin() ? 1.0 : d.logUniform(1.0, 1e6);
           scaleModulus(segment, ratio);
           draw.pressures.segment(6 * k, 6) *= ratio;
           draw.scene.chain.emplace_back(segment);
           if (d.coin()) draw.scene.chain.emplace_back(Link{d.random.uniform(0.002, 0.04), d.random.uniform(0.0, 0.02)});
         }
         if (d.coin()) linear(draw.wrench) = d.random.vector(0.02);
         return draw;
       }},
      {"warm",  // a few steps of a random walk before
       [](Draw& d) {
         HardDraw draw = d.paper();
         draw.wrench = d.wrench(draw.scene, d.logUniform(0.01, 1.0));
         for (int i = 0; i < 3; ++i)
           draw.before.emplace_back(draw.pressures + d.pressures(draw.scene, -0.3e5, 0.3e5), Wrench::Zero());
         return draw;
       }},
      {"garbage",  // wild pressures and wrenches, failures and NaN before
       [](Draw& d) {
         HardDraw draw = d.paper();
         draw.wrench = d.wrench(draw.scene, d.logUniform(0.01, 1.0));
         for (int i = 0; i < 2; ++i) {
           draw.before.emplace_back(d.pressures(draw.scene, -1e5, 3e5), d.wrench(draw.scene, d.logUniform(0.01, 30.0)));
           if (d.coin()) draw.before.back().first[0] = std::numeric_limits<double>::quiet_NaN();
         }
         return draw;
       }},
      {"nonsense",  // input that must be refused
       [](Draw& d) {
         HardDraw draw = d.paper();
         const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e6,
                               1e9, 1e300};
         draw.pressures[d.integer(0, 5)] = bad[d.integer(0, 4)];
         if (d.coin()) draw.wrench[d.integer(0, 5)] = bad[d.integer(0, 4)];
         return draw;
       }}};
  return makers;
}

double errorBetween(const StiffnessSolution& a, const StiffnessSolution& exact, double length) {
  return std::max({poseError(a.X_BT, exact.X_BT, length), complianceError(a.compliance, exact.compliance, length),
                   complianceError(a.material_compliance, exact.material_compliance, length)});
}

}  // namespace

const std::vector<HardDrawClass>& hardDrawClasses() {
  // Pressures beyond the section's range, dead moments beyond half a turn, columns that may lean in any direction and
  // nonsense have no ok result.
  static const std::vector<HardDrawClass> classes = {
      {"near_straight", 8, 1.0}, {"pressure", 8, 0.9}, {"vacuum", 8, 1.0}, {"slender", 8, 0.99},
      {"stubby", 4, 0.6}, {"stiffness_ratio", 4, 0.98}, {"modulus", 4, 0.99}, {"units", 4, 0.99},
      {"gravity", 2, 0.99}, {"wrench", 4, 0.75}, {"column", 2, 0.6}, {"chain", 1, 0.98},
      {"long_chain", 1, 1.0}, {"long_rod", 1, 1.0}, {"standing", 1, 1.0}, {"catheter", 1, 0.99}, {"mixed_chain", 1, 0.99},
      {"warm", 8, 0.99}, {"garbage", 2, 0.98}, {"nonsense", 8, 0.0}};
  return classes;
}

int totalHardDrawWeight() {
  int total = 0;
  for (const HardDrawClass& c : hardDrawClasses()) total += c.weight;
  return total;
}

HardDraw hardDraw(const std::string& draw_class, unsigned long number) {
  unsigned seed = 2166136261u;
  for (char c : draw_class) seed = (seed ^ static_cast<unsigned char>(c)) * 16777619u;
  Draw draw(seed + static_cast<unsigned>(number));
  return makers().at(draw_class)(draw);
}

bool DrawOutcome::isAccurate(double accuracy) const {
  // Ten times the estimate, as everywhere; and the balance, which is measured by quadrature over the same shape.
  const double tolerance = 10.0 * std::max(accuracy, estimate);
  return (reference_failed || other_branch || error <= tolerance + reference_estimate) &&
         imbalance <= std::max(tolerance, 1e-8);
}

bool DrawOutcome::isHonest(double accuracy) const {
  return finite && !threw && iterations <= StaticsSolver::kMaxIterations &&
         (code != SolveCode::kOk || isAccurate(accuracy));
}

DrawOutcome runHardDraw(const HardDraw& draw) {
  DrawOutcome outcome;
  try {
    const StiffnessModel model(draw.scene, draw.options);
    StiffnessWorkspace workspace = model.makeWorkspace();
    for (const auto& [pressures, wrench] : draw.before) model.solve(pressures, wrench, workspace);
    const StiffnessSolution solution = model.solve(draw.pressures, draw.wrench, workspace);
    outcome.code = solution.status.code;
    outcome.iterations = solution.iterations;
    outcome.finite = solution.X_BT.p.allFinite() && solution.X_BT.R.allFinite() && solution.compliance.allFinite() &&
                     solution.material_compliance.allFinite() && std::isfinite(solution.numerical_error);
    if (!solution.status.ok()) return outcome;
    outcome.estimate = solution.numerical_error;
    const double length = draw.scene.length();
    if (workspace.loaded()) {
      const Vector3 gravity = draw.scene.gravity.value_or(Vector3::Zero());
      const double load =
          DeadLoads{gravity, draw.wrench}.baseForce(Chain(draw.scene)).norm() * length + angular(draw.wrench).norm();
      const double softness = softnessOf(draw.scene);
      // With 8 quadrature is off by 6e-8 where a segment bends by several turns; and what bends near the base of a long soft
      // rod under tension is shorter than it by the root of load times softness.
      const int panels = 24 + static_cast<int>(std::min(1000.0, std::sqrt(load * softness)));
      const Vector3 moment = momentOfLoads(model, workspace, solution.X_BT, draw.wrench, panels);
      outcome.imbalance = (baseMoment(model, workspace, draw.wrench) - moment).norm() / (load + 1.0 / softness);
    }
    ModelOptions fine = draw.options;
    fine.accuracy = 1e-12;
    const StiffnessSolution reference = solveCold(StiffnessModel(draw.scene, fine), draw.pressures, draw.wrench);
    outcome.reference_failed = !reference.status.ok();
    if (outcome.reference_failed) return outcome;
    outcome.error = errorBetween(solution, reference, length);
    outcome.reference_estimate = 10.0 * reference.numerical_error;
    outcome.other_branch = !draw.before.empty() && poseError(solution.X_BT, reference.X_BT, length) > 0.01;
  } catch (const std::exception&) {
    outcome.threw = true;
  }
  return outcome;
}

}  // namespace live_stiffness
