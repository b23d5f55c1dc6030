#include "live_stiffness/analysis/holding_wrench.h"

#include <Eigen/LU>
#include <algorithm>

#include "lie/matrix6.h"

namespace live_stiffness {
namespace {

// Size of a motion: the larger of its displacement divided by the robot's length and its rotation, rad.
constexpr double kTolerance = 1e-7;
constexpr double kLargestLeg = 0.2, kLeastLeg = 5e-3;
constexpr double kOnTheWay = 0.1;  // tolerance at the end of a step ("leg"), relative to its size
constexpr int kMostSolves = 60, kMostIterations = 8;

// Twist of T, base axes, from a pose to the goal.
Twist wayTo(const HoldGoal& goal, const Pose& X_BT) {
  Twist way;
  way << goal.position - X_BT.p,
      goal.orientation ? logSo3(*goal.orientation * X_BT.R.transpose()) : Vector3(Vector3::Zero());
  return way;
}

double sizeOf(const Twist& way, double length) { return std::max(linear(way).norm() / length, angular(way).norm()); }

// The goal of a step: short of the goal by `rest`.
HoldGoal before(const HoldGoal& goal, const Twist& rest) {
  HoldGoal earlier{goal.position - linear(rest), goal.orientation};
  if (goal.orientation) earlier.orientation = expSo3(-angular(rest)) * *goal.orientation;
  return earlier;
}

}  // namespace

HoldingWrench findHoldingWrench(const StiffnessModel& model, PressuresRef pressures, const Wrench& wrench,
                                const HoldGoal& goal, StiffnessWorkspace& workspace) {
  HoldingWrench result;
  const double length = model.scene().length();
  const auto solve = [&](const Wrench& added) {
    ++result.solves;
    return model.solve(pressures, wrench + added, workspace);
  };
  workspace.reset();
  result.before = result.held = solve(Wrench::Zero());
  if (!result.before.status.ok()) return result;

  // Newton's method to the end of a step. True if it converges, at least halving the remaining distance each time.
  const auto walkTo = [&](const HoldGoal& leg_goal, double tolerance) {
    Wrench trial_wrench = result.wrench;
    StiffnessSolution trial = result.held;
    Twist left = wayTo(leg_goal, trial.X_BT);
    for (int i = 0; i < kMostIterations && !(sizeOf(left, length) <= tolerance); ++i) {
      const double size = sizeOf(left, length);
      // The wrench that causes this motion, to first order.
      if (goal.orientation) trial_wrench += live_stiffness::solve(trial.compliance, left);
      else linear(trial_wrench) += trial.compliance.topLeftCorner<3, 3>().partialPivLu().solve(linear(left));
      trial = solve(trial_wrench);
      left = wayTo(leg_goal, trial.X_BT);
      if (!trial.status.ok() || !(sizeOf(left, length) < 0.5 * size)) return false;
    }
    if (!(sizeOf(left, length) <= tolerance)) return false;
    result.wrench = trial_wrench;
    result.held = trial;
    return true;
  };
  const Twist way = wayTo(goal, result.before.X_BT);
  const double size = sizeOf(way, length);
  double done = 0.0, leg = std::min(1.0, kLargestLeg / size);
  while (done < 1.0 && leg * size >= kLeastLeg * std::min(1.0, size) && result.solves < kMostSolves) {
    const double next = std::min(1.0, done + leg);
    const double tolerance = next < 1.0 ? std::max(kTolerance, kOnTheWay * leg * size) : kTolerance;
    if (walkTo(before(goal, (1.0 - next) * way), tolerance)) {
      done = next;
      leg = std::min(2.0 * leg, kLargestLeg / size);
    } else {
      leg *= 0.5;
      result.held = solve(result.wrench);  // the workspace holds a failed trial
      if (!result.held.status.ok()) return result;
    }
  }
  const Twist left = wayTo(goal, result.held.X_BT);
  result.miss = {linear(left).norm(), angular(left).norm()};
  result.reached = sizeOf(left, length) <= kTolerance;
  return result;
}

}  // namespace live_stiffness
