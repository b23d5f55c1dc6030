#pragma once
// The opponent of the benchmark: one segment solved as is common practice in rod code. Rotation matrices, RK4 in 50
// steps, shooting on the base wrench with a Jacobian of forward differences, and compliance by solving again under six
// small wrenches. Load stepping is the library's, and so is the favourable formulation (pressure as rest strain).

#include "live_stiffness/rod/backbone.h"

namespace live_stiffness {

class CommonPractice {
 public:
  static constexpr int kSteps = 50;

  struct Solution {
    bool converged = false;
    Pose X_BT;
    Matrix6 compliance = Matrix6::Zero();  // of T under a dead wrench at T, base axes
  };

  // The scene holds one segment, T at its end, and outlives this.
  explicit CommonPractice(const Scene& scene);

  // Starts from the last solution unless reset() was called.
  Solution solve(const RestState& rest);
  void reset() { base_wrench_.setZero(); }

 private:
  struct State {
    Pose X;
    Vector3 n, m;
  };
  State rate(const RestState& rest, const State& at) const;
  Vector6 shoot(const RestState& rest, const Vector6& base_wrench, const Wrench& tip_wrench, Pose& X_BT) const;
  bool newton(const RestState& rest, const Wrench& tip_wrench, Vector6& base_wrench, Pose& X_BT) const;

  const Scene& scene_;
  const Segment& segment_;
  Vector6 base_wrench_ = Vector6::Zero();
};

}  // namespace live_stiffness
