#include "rig/fine_robot.h"

#include <Eigen/LU>
#include <cmath>

#include "live_stiffness/checks.h"
#include "section/section_moments.h"

namespace live_stiffness {
namespace {

// Derivative of [stretch; curvature x, y] by the share of the load that is on:
//   dlam = lam F / (E A(lam)),   du = (E I(lam))^-1 T(1) / sqrt(lam), the moment arm shrinking with the section,
// with E and what the pressures add as the material has them.
struct Load {
  double force;
  Vector3 moment;
  ChamberStiffness stiffness;  // of all pressures
};

// NaN where the section's area or moments run out.
Vector3 loadRate(const SectionMoments& section, const Load& load, double share, const Vector3& state) {
  const double lam = state[0];
  if (!section.isValidAt(lam)) return Vector3::Constant(std::nan(""));
  const ChamberStiffness on{share * load.stiffness.axial, share * load.stiffness.bending};
  Vector3 rate;
  rate[0] = lam * load.force / section.axialStiffness(lam, on);
  rate.tail<2>() = section.bendingStiffness(lam, on).inverse() * load.moment.head<2>() / std::sqrt(lam);
  return rate;
}

// One step h of the classical Runge-Kutta method for y' = rate(t, y).
template <class State, class Rate>
State rungeKuttaStep(const Rate& rate, double t, double h, const State& y) {
  const State k1 = rate(t, y);
  const State k2 = rate(t + 0.5 * h, y + 0.5 * h * k1);
  const State k3 = rate(t + 0.5 * h, y + 0.5 * h * k2);
  const State k4 = rate(t + h, y + h * k3);
  return y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

// [stretch; curvature] under the whole load; false if the section's area or moments run out on the way.
bool followLoad(const SectionMoments& section, const Load& load, Vector3& state) {
  const double h = 1.0 / FineRobot::kLoadSteps;
  state = Vector3(1.0, 0.0, 0.0);
  for (int step = 0; step < FineRobot::kLoadSteps; ++step) {
    state = rungeKuttaStep([&](double share, const Vector3& at) { return loadRate(section, load, share, at); }, step * h, h,
                           state);
    if (!section.isValidAt(state[0])) return false;
  }
  return true;
}

}  // namespace

FineRobot::FineRobot(Scene scene) : scene_(std::move(scene)) {
  if (scene_.segmentCount() == 0) throw ConfigurationError("fine robot", {"chain: must hold at least one segment"});
}

bool FineRobot::loadSegments(PressuresRef pressures, std::vector<LoadedSegment>& segments) const {
  if (pressures.size() != scene_.chamberCount() || !pressures.allFinite()) return false;
  int first = 0;
  for (const Body& body : scene_.chain) {
    const auto* segment = std::get_if<Segment>(&body);
    if (!segment) continue;
    const Chambers& chambers = segment->section.chambers;
    const auto own = pressures.segment(first, chambers.count());
    first += chambers.count();
    const SectionMoments section(segment->section);
    Vector3 state;
    const Load load{chambers.actuationForce(own), chambers.actuationMoment(own, 1.0),
                    chamberStiffness(segment->section, own)};
    if (!followLoad(section, load, state)) return false;
    LoadedSegment& loaded = segments.emplace_back();
    loaded.length = state[0] * segment->length;
    loaded.rest_curvature << state[1], state[2], 0.0;
    loaded.c = section.complianceDensity(state[0]);
    loaded.mass = segment->mass();
  }
  return true;
}

bool FineRobot::inRange(PressuresRef pressures) const {
  std::vector<LoadedSegment> segments;
  return loadSegments(pressures, segments);
}

FineRobot::RodState FineRobot::integrateChain(const std::vector<LoadedSegment>& segments, const Vector3& gravity,
                                              const Wrench& tip_wrench, const Vector3& base_moment) const {
  // What the part beyond exerts: all weight and the tip force, less what is passed on the way.
  Vector3 n = linear(tip_wrench) + scene_.tip_mass * gravity;
  for (const LoadedSegment& segment : segments) n += segment.mass * gravity;
  for (const Body& body : scene_.chain)
    if (const auto* link = std::get_if<Link>(&body)) n += link->mass * gravity;

  RodState state;
  state << Eigen::Quaterniond::Identity().coeffs(), Vector3::Zero(), base_moment;
  auto segment = segments.begin();
  for (const Body& body : scene_.chain) {
    if (const auto* link = std::get_if<Link>(&body)) {
      const Vector3 along = link->length * (Eigen::Quaterniond(state.head<4>()) * Vector3::UnitZ());
      const Vector3 weight = link->mass * gravity;
      n -= weight;
      state.tail<3>() -= along.cross(n) + 0.5 * along.cross(weight);
      state.segment<3>(4) += along;
      continue;
    }
    const Vector3 line_load = segment->mass * gravity / segment->length;
    const auto rate = [&](double s, const RodState& at) {
      const Eigen::Quaterniond q = Eigen::Quaterniond(at.head<4>()).normalized();
      const Matrix3 R = q.toRotationMatrix();
      const Vector3 force = n - s * line_load;
      const Vector3 u = segment->rest_curvature + segment->c.bending_torsion * (R.transpose() * at.tail<3>());
      const Vector3 dp = R * (Vector3::UnitZ() + segment->c.shear_elongation * (R.transpose() * force));
      RodState d;
      d << 0.5 * (q * Eigen::Quaterniond(0.0, u.x(), u.y(), u.z())).coeffs(), dp, -dp.cross(force);
      return d;
    };
    const double h = segment->length / kRodSteps;
    for (int step = 0; step < kRodSteps; ++step) {
      state = rungeKuttaStep(rate, step * h, h, state);
      state.head<4>().normalize();
    }
    n -= segment->mass * gravity;
    ++segment;
  }
  return state;
}

Vector3 FineRobot::residual(const std::vector<LoadedSegment>& segments, const Vector3& gravity, const Wrench& tip_wrench,
                            const Vector3& base_moment, RodState& end) const {
  end = integrateChain(segments, gravity, tip_wrench, base_moment);
  const Vector3 arm = Eigen::Quaterniond(end.head<4>()) * scene_.tip_offset;
  return end.tail<3>() - angular(tip_wrench) - arm.cross(linear(tip_wrench) + scene_.tip_mass * gravity);
}

bool FineRobot::newton(const std::vector<LoadedSegment>& segments, const Vector3& gravity, const Wrench& tip_wrench,
                       Vector3& base_moment, RodState& end) const {
  constexpr int kMaxIterations = 50;
  // Moment that bends the robot by about a radian: the scale of all moments here.
  double bend_per_moment = 0.0;
  for (const LoadedSegment& segment : segments) bend_per_moment += segment.length * segment.c.bending_torsion(0, 0);
  const double unit = 1.0 / bend_per_moment;

  RodState tried;
  const auto residualAt = [&](const Vector3& m) { return residual(segments, gravity, tip_wrench, m, tried); };
  Vector3 r = residualAt(base_moment);
  end = tried;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    if (r.norm() < 1e-12 * unit) return true;  // some ten times the rounding of kRodSteps steps
    Matrix3 J;
    for (int k = 0; k < 3; ++k) {
      const Vector3 h = 1e-6 * unit * Vector3::Unit(k);
      J.col(k) = (residualAt(base_moment + h) - residualAt(base_moment - h)) / (2.0 * h[k]);
    }
    const Vector3 step = -J.fullPivLu().solve(r);
    bool better = false;
    for (double factor = 1.0; factor > 1e-3 && !better; factor *= 0.5) {
      const Vector3 next = base_moment + factor * step, next_r = residualAt(next);
      better = next_r.norm() < r.norm();
      if (better) {
        base_moment = next;
        end = tried;
        r = next_r;
      }
    }
    if (!better) break;
  }
  return r.norm() < 1e-10 * unit;  // rounding stopped it, and the pose is good to 1e-10 of the length
}

std::optional<Pose> FineRobot::solve(PressuresRef pressures, const Wrench& tip_wrench) {
  std::vector<LoadedSegment> segments;
  if (!tip_wrench.allFinite() || !loadSegments(pressures, segments)) return std::nullopt;
  const Vector3 gravity = scene_.gravity.value_or(Vector3::Zero());
  RodState end;
  Vector3 base_moment = base_moment_;
  if (!newton(segments, gravity, tip_wrench, base_moment, end)) {
    // From nothing to the full load, which stays on the branch that the robot is on.
    base_moment.setZero();
    constexpr int kLoadIncrements = 40;
    for (int k = 1; k <= kLoadIncrements; ++k) {
      const double share = static_cast<double>(k) / kLoadIncrements;
      if (!newton(segments, share * gravity, share * tip_wrench, base_moment, end)) return std::nullopt;
    }
  }
  base_moment_ = base_moment;
  const Matrix3 R = Eigen::Quaterniond(end.head<4>()).toRotationMatrix();
  return Pose{R, end.segment<3>(4) + R * scene_.tip_offset};
}

}  // namespace live_stiffness
