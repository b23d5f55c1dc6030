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
    if (!segment) {
      if (!segments.empty()) segments.back().links.push_back(std::get<Link>(body));
      continue;
    }
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

FineRobot::RodState FineRobot::pass(const LoadedSegment& segment, const Vector3& gravity, RodState state) {
  const Vector3 line_load = segment.mass * gravity / segment.length;
  using Numbers = Eigen::Matrix<double, 10, 1>;  // of q (x, y, z, w), p and m
  const auto rate = [&](double s, const Numbers& at) {
    const Eigen::Quaterniond q = Eigen::Quaterniond(at.head<4>()).normalized();
    const Matrix3 R = q.toRotationMatrix();
    const Vector3 force = state.n - s * line_load;
    const Vector3 u = segment.rest_curvature + segment.c.bending_torsion * (R.transpose() * at.tail<3>());
    const Vector3 dp = R * (Vector3::UnitZ() + segment.c.shear_elongation * (R.transpose() * force));
    Numbers d;
    d << 0.5 * (q * Eigen::Quaterniond(0.0, u.x(), u.y(), u.z())).coeffs(), dp, -dp.cross(force);
    return d;
  };
  const double h = segment.length / kRodSteps;
  Numbers numbers;
  numbers << state.q.coeffs(), state.p, state.m;
  for (int step = 0; step < kRodSteps; ++step) {
    numbers = rungeKuttaStep(rate, step * h, h, numbers);
    numbers.head<4>().normalize();
  }
  state = {Eigen::Quaterniond(numbers.head<4>()), numbers.segment<3>(4), numbers.tail<3>(),
           state.n - segment.mass * gravity};
  for (const Link& link : segment.links) {
    const Vector3 along = link.length * (state.q * Vector3::UnitZ()), weight = link.mass * gravity;
    state.m -= along.cross(state.n - 0.5 * weight);
    state.n -= weight;
    state.p += along;
  }
  return state;
}

// What lacks between the end of a segment and the start of the next one, `start`: rotation (rad) and moment, in `unit`.
Vector6 FineRobot::jointGap(const RodState& end, const RodState& start, double unit) {
  Vector6 gap;
  gap << logSo3((end.q * start.q.conjugate()).toRotationMatrix()), (end.m - start.m) / unit;
  return gap;
}

// The moment, in `unit`, that is left over at T: what the rod carries there less what acts there.
Vector3 FineRobot::tipGap(const RodState& end, const Wrench& tip_wrench, double unit) const {
  return (end.m - angular(tip_wrench) - (end.q * scene_.tip_offset).cross(end.n)) / unit;
}

// Multiple shooting: every segment has a start of its own, so that nothing grows along the robot; Newton's method on the gaps,
// with finite differences of one segment at a time.
bool FineRobot::newton(const std::vector<LoadedSegment>& segments, const Vector3& gravity, const Wrench& tip_wrench,
                       std::vector<RodState>& starts, RodState& end) const {
  constexpr int kMaxIterations = 50;
  constexpr double kDifference = 1e-7;
  // Moment that bends the robot by about a radian: the scale of all moments here.
  double bend_per_moment = 0.0;
  Vector3 force = linear(tip_wrench) + scene_.tip_mass * gravity;
  for (const LoadedSegment& segment : segments) {
    bend_per_moment += segment.length * segment.c.bending_torsion(0, 0);
    force += segment.mass * gravity;
    for (const Link& link : segment.links) force += link.mass * gravity;
  }
  const double unit = 1.0 / bend_per_moment;
  const auto count = static_cast<Eigen::Index>(segments.size()), size = 6 * count - 3;

  // Gaps of all joints and T, with position and force at every start on the way.
  const auto gapsOf = [&](std::vector<RodState>& at, RodState& tip) {
    Eigen::VectorXd gaps(size);
    at[0].n = force;
    for (Eigen::Index k = 0; k < count; ++k) {
      tip = pass(segments[k], gravity, at[k]);
      if (k + 1 == count) break;
      at[k + 1].p = tip.p;
      at[k + 1].n = tip.n;
      gaps.segment<6>(6 * k) = jointGap(tip, at[k + 1], unit);
    }
    gaps.tail<3>() = tipGap(tip, tip_wrench, unit);
    return gaps;
  };
  // A start, turned and with more moment; the first one is clamped.
  const auto moved = [&](RodState start, const Vector6& change) {
    start.q = Eigen::Quaterniond(expSo3(change.head<3>())) * start.q;
    start.m += unit * change.tail<3>();
    return start;
  };

  Eigen::VectorXd gaps = gapsOf(starts, end);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    if (gaps.norm() < 1e-12) return true;  // some ten times the rounding of kRodSteps steps
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index k = 0; k < count; ++k)
      for (int i = k == 0 ? 3 : 0; i < 6; ++i) {
        const Eigen::Index column = 6 * k - 3 + i;
        const RodState after = pass(segments[k], gravity, moved(starts[k], kDifference * Vector6::Unit(i)));
        if (k + 1 < count)
          J.block<6, 1>(6 * k, column) = (jointGap(after, starts[k + 1], unit) - gaps.segment<6>(6 * k)) / kDifference;
        else
          J.block<3, 1>(6 * k, column) = (tipGap(after, tip_wrench, unit) - gaps.tail<3>()) / kDifference;
        if (k > 0) J(column - 3, column) = -1.0;  // of the gap before it; exact where that is zero
      }
    const Eigen::VectorXd step = -J.partialPivLu().solve(gaps);
    bool better = false;
    for (double factor = 1.0; factor > 1e-3 && !better; factor *= 0.5) {
      std::vector<RodState> next = starts;
      RodState next_end;
      for (Eigen::Index k = 0; k < count; ++k) {
        Vector6 change = Vector6::Zero();
        if (k > 0) change = factor * step.segment<6>(6 * k - 3);
        else change.tail<3>() = factor * step.head<3>();
        next[k] = moved(starts[k], change);
      }
      const Eigen::VectorXd next_gaps = gapsOf(next, next_end);
      better = next_gaps.norm() < gaps.norm();
      if (better) {
        starts = next;
        end = next_end;
        gaps = next_gaps;
      }
    }
    if (!better) break;
  }
  return gaps.norm() < 1e-10;  // rounding stopped it, and the pose is good to 1e-10 of the length
}

std::optional<Pose> FineRobot::solve(PressuresRef pressures, const Wrench& tip_wrench) {
  std::vector<LoadedSegment> segments;
  if (!tip_wrench.allFinite() || !loadSegments(pressures, segments)) return std::nullopt;
  const Vector3 gravity = scene_.gravity.value_or(Vector3::Zero());
  RodState end;
  if (starts_.empty() || !newton(segments, gravity, tip_wrench, starts_, end)) {
    // From nothing to the full load, which stays on the branch that the robot is on.
    starts_.assign(1, RodState());
    for (const Body& body : scene_.chain) {
      if (std::holds_alternative<Segment>(body)) break;
      starts_[0].p.z() += std::get<Link>(body).length;
    }
    for (const LoadedSegment& segment : segments) starts_.push_back(pass(segment, Vector3::Zero(), starts_.back()));
    starts_.pop_back();
    constexpr int kLoadIncrements = 40;
    for (int k = 1; k <= kLoadIncrements; ++k) {
      const double share = static_cast<double>(k) / kLoadIncrements;
      if (newton(segments, share * gravity, share * tip_wrench, starts_, end)) continue;
      starts_.clear();
      return std::nullopt;
    }
  }
  const Matrix3 R = end.q.toRotationMatrix();
  return Pose{R, end.p + R * scene_.tip_offset};
}

}  // namespace live_stiffness
