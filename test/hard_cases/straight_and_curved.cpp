// Straight, nearly straight and far more curved than a robot will be: where the functions of an angle change branch.

#include <cmath>

#include "hard_cases/hard_case.h"
#include "compliance/material_compliance.h"
#include "rod/backbone.h"
#include "rod/shooting.h"
#include "support/bare_rod.h"
#include "support/errors.h"
#include "support/planar_chain.h"
#include "support/scenes.h"
#include "support/rest_state.h"

namespace live_stiffness {
namespace {

// Too small to bend anything, but it keeps the solve out of the closed form.
const Wrench kNegligible = Wrench::Unit(0) * 1e-25;

ModelOptions linearOptions() {
  ModelOptions options = accurateTo(1e-13);
  options.stepping = Stepping::kLinear;
  return options;
}

double relative(double actual, long double expected) {
  if (expected == 0.0L) return std::abs(actual);
  return static_cast<double>(std::abs((actual - expected) / expected));
}

// The paper's segment with a straight pair of chambers driven towards -x, so that the plane is xz.
Scene planarScene(int segments) {
  Scene scene;
  Scene paper = weightlessPaperScene(1);
  for (int k = 0; k < segments; ++k) scene.chain.push_back(segmentOf(paper, 0));
  return scene;
}

PlanarChain chainOf(const StiffnessWorkspace& workspace, Scene scene) {
  std::vector<PlanarArc> arcs;
  for (int k = 0; k < scene.segmentCount(); ++k)
    arcs.push_back(PlanarArc::of(workspace.backbone().rest[k], segmentOf(scene, k).length));
  return PlanarChain(arcs);
}

// Curvature of the first segment times its length at pressures [P, P, 0, ...], Pa, linear in P but for the stretch.
double pressureForBending(const Scene& scene, double bending) {
  Scene copy = scene;
  const Segment& segment = segmentOf(copy, 0);
  double pressure = 0.0;
  for (int i = 0; i < 50; ++i) {
    const RestState unit = restState(segment.section, bars(1e-5, {1, 1, 0, 0, 0, 0}), Stepping::kLinear, 1);
    const RestState at = restState(segment.section, bars(1e-5 * pressure, {1, 1, 0, 0, 0, 0}), Stepping::kLinear, 1);
    pressure = bending / (std::abs(unit.curvature.y()) * at.stretch * segment.length);
  }
  return pressure;
}

// Every entry relative to itself, also those that vanish with the curvature: no digit may be lost.
void compareDigits(HardOutcome& outcome, const Pose& X, const Matrix6& C, const PlanarChain& chain, double tolerance) {
  const PlanarPose tip = chain.tip();
  outcome.error(relative(X.p.x(), tip.x), tolerance, "x");
  outcome.error(relative(X.p.z(), tip.z), tolerance, "z");
  outcome.error(relative(X.R(0, 2), std::sin(tip.angle)), tolerance, "angle");
  const PlanarCompliance c = chain.compliance();
  outcome.error(relative(C(0, 0), c.xx), tolerance, "C xx");
  outcome.error(relative(C(0, 2), c.xz), tolerance, "C xz");
  outcome.error(relative(C(2, 2), c.zz), tolerance, "C zz");
  outcome.error(relative(C(0, 4), c.x_angle), tolerance, "C x angle");
  outcome.error(relative(C(2, 4), c.z_angle), tolerance, "C z angle");
  outcome.error(relative(C(4, 4), c.angle_angle), tolerance, "C angle angle");
}

void nearlyStraight(HardOutcome& outcome, const Wrench& wrench, double tolerance) {
  const Scene scene = planarScene(1);
  const StiffnessModel model(scene, linearOptions());
  for (double bending : {0.0, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    StiffnessWorkspace workspace = model.makeWorkspace();
    const double pressure = pressureForBending(scene, bending);
    const StiffnessSolution solution =
        outcome.solve(model, bars(1e-5 * pressure, {1, 1, 0, 0, 0, 0}), wrench, workspace);
    const PlanarChain chain = chainOf(workspace, scene);
    compareDigits(outcome, solution.X_BT, solution.compliance, chain, tolerance);
    compareDigits(outcome, solution.X_BT, solution.material_compliance, chain, tolerance);
  }
}

void compareChain(HardOutcome& outcome, const Scene& scene, const Pressures& pressures, const Wrench& wrench,
                  double tolerance) {
  const StiffnessModel model(scene, linearOptions());
  StiffnessWorkspace workspace = model.makeWorkspace();
  const StiffnessSolution solution = outcome.solve(model, pressures, wrench, workspace);
  const PlanarChain chain = chainOf(workspace, scene);
  const PlanarPose tip = chain.tip();
  Pose expected;
  expected.p << static_cast<double>(tip.x), 0.0, static_cast<double>(tip.z);
  expected.R = expSo3(Vector3::UnitY() * static_cast<double>(std::remainder(tip.angle, 2.0L * std::acos(-1.0L))));
  const double length = workspace.backbone().length(0) * scene.segmentCount();
  outcome.error(poseError(solution.X_BT, expected, length), tolerance, "pose");
  const PlanarCompliance c = chain.compliance();
  const auto entry = [&](int i, int j, long double truth, double scale) {
    const double largest = static_cast<double>(c.angle_angle) * length * length;
    for (const Matrix6& C : {solution.compliance, solution.material_compliance})
      outcome.error(std::abs(C(i, j) - static_cast<double>(truth)) * scale / largest, tolerance, "compliance");
  };
  entry(0, 0, c.xx, 1.0);
  entry(0, 2, c.xz, 1.0);
  entry(2, 2, c.zz, 1.0);
  entry(0, 4, c.x_angle, length);
  entry(2, 4, c.z_angle, length);
  entry(4, 4, c.angle_angle, length * length);
}

void turns(HardOutcome& outcome, double turns, const Wrench& wrench, double tolerance) {
  Scene scene = planarScene(1);
  const Pressures pressures = bars(0.9, {1, 1, 0, 0, 0, 0});
  const RestState rest = restState(segmentOf(scene, 0).section, pressures, Stepping::kLinear, 1);
  segmentOf(scene, 0).length = turns * 2.0 * kPi / (rest.curvature.norm() * rest.stretch);
  compareChain(outcome, scene, pressures, wrench, tolerance);
}

void sShape(HardOutcome& outcome, int segments, const Wrench& wrench, double tolerance) {
  Pressures pressures(6 * segments);
  for (int k = 0; k < segments; ++k)  // towards -x with the first pair, towards +x with the other two together
    pressures.segment(6 * k, 6) = k % 2 == 0 ? bars(1.0, {1, 1, 0, 0, 0, 0}) : bars(0.9, {0, 0, 1, 1, 1, 1});
  compareChain(outcome, planarScene(segments), pressures, wrench, tolerance);
}

// Position along a constant rotation rate u in body axes, from the components of e3 along and across u.
Vector3 helixPoint(const Vector3& u, double s) {
  const double rate = u.norm();
  const Vector3 axis = u / rate, along = axis.z() * axis, across = Vector3::UnitZ() - along;
  return s * along + std::sin(rate * s) / rate * across + (1.0 - std::cos(rate * s)) / rate * axis.cross(across);
}

// Three turns of curvature and two of twist at rest.
void helixAtRest(HardOutcome& outcome) {
  BareRod rod = BareRod::elastica();
  rod.rest.curvature = 2.0 * kPi * Vector3(1.8, 2.4, 2.0);
  Backbone closed = rod.backbone();
  StaticsSolver unloaded(rod.scene, 1e-12);
  Matrix6 unused;
  unloaded.prepareUnloaded(closed);
  solveUnloaded(unloaded.chain(), 1e-12, closed, unused);
  const Vector3 expected = helixPoint(rod.rest.curvature, 1.0);
  outcome.error((closed.X_BT.p - expected).norm(), 1e-14, "closed form");
  Backbone solved = rod.backbone();
  StaticsSolver solver(rod.scene, 1e-12);
  DeadLoads loads;
  loads.tip = kNegligible;
  outcome.solve(solver, loads, solved);
  outcome.error((solved.X_BT.p - expected).norm(), 1e-11, "boundary value problem");
}

// A straight rod that a force along an axis and a moment coil into a helix of curvature kappa, torsion tau and twist w:
// f = sqrt(kappa^2 + tau^2) (GJ w - EI tau) along the axis, m = EI kappa b + GJ w t (Love, article 270). Moments below
// pi EI / L, beyond which a dead one is not stable.
void helixUnderLoad(HardOutcome& outcome) {
  BareRod rod = BareRod::elastica();
  constexpr double kGJ = 0.8;
  rod.rest.c.bending_torsion(2, 2) = 1.0 / kGJ;
  for (const Vector3& shape : {Vector3(1.0, 0.3, 0.5), Vector3(2.0, 1.0, 1.5), Vector3(2.1, 0.5, 0.6)}) {
    const double kappa = shape[0], tau = shape[1], twist = shape[2];
    const Vector3 darboux(0.0, kappa, tau);  // start: tangent z, normal x, binormal y
    const Matrix3 frame = expSo3(darboux);   // of the curve at the tip, in the same order
    DeadLoads loads;
    linear(loads.tip) = (kGJ * twist - tau) * darboux;
    angular(loads.tip) = kappa * frame.col(1) + kGJ * twist * frame.col(2);
    Backbone backbone = rod.backbone();
    StaticsSolver solver(rod.scene, 1e-12);
    outcome.solve(solver, loads, backbone);
    const Pose expected = {frame * expSo3((twist - tau) * Vector3::UnitZ()), helixPoint(darboux, 1.0)};
    outcome.error(poseError(backbone.X_BT, expected, 1.0), 1e-10, "pose");
  }
}

}  // namespace

HardTheme straightAndCurved() {
  const Wrench none = Wrench::Zero();
  const std::string arcs = "circular arcs in long double";
  HardTheme theme{"straight_and_curved", {}};
  const auto add = [&](const std::string& name, const std::string& truth, std::function<void(HardOutcome&)> run) {
    theme.cases.push_back({name, truth, std::move(run)});
  };
  // Bent far, the quadrature of an element of 1.5 rad is good to about the 1e-14 that the estimate states; ten times
  // that is its promise. Nearly straight, entry by entry, each relative to itself: a few units in the last place in
  // closed form.
  add("nearly_straight", arcs, [=](HardOutcome& o) { nearlyStraight(o, none, 4e-15); });
  add("nearly_straight_solved", arcs, [=](HardOutcome& o) { nearlyStraight(o, kNegligible, 1e-12); });
  for (double n : {1.0, 2.0}) {
    const std::string name = n == 1.0 ? "full_circle" : "turns_of_720_deg";
    add(name, arcs, [=](HardOutcome& o) { turns(o, n, none, 1e-13); });
    add(name + "_solved", arcs, [=](HardOutcome& o) { turns(o, n, kNegligible, 1e-11); });
  }
  for (int n : {2, 6}) {
    const std::string name = "s_shape_of_" + std::to_string(n) + "_segments";
    add(name, arcs, [=](HardOutcome& o) { sShape(o, n, none, 1e-13); });
    add(name + "_solved", arcs, [=](HardOutcome& o) { sShape(o, n, kNegligible, 1e-11); });
  }
  add("helix_at_rest", "helix", helixAtRest);
  add("helix_under_load", "Love's helix under a wrench", helixUnderLoad);
  return theme;
}

}  // namespace live_stiffness
