#pragma once
// Common practice in rod code: rotation matrices, RK4, shooting on the base wrench (six unknowns) with a Jacobian of
// forward differences, compliance by solving again under six small tip wrenches. With fixed-size matrices and a quick
// rate, in three forms: as it is commonly written, with a fresh Jacobian in every iteration; with all that can be saved, where
// the one Jacobian of a solve serves the six solves for the compliance and the next update; and by Levenberg's method, in the
// style of Till's optimised examples (ContinuumRobotExamples, CSG_IK_Speedup).

#include "benchmark/methods/rk4.h"
#include "benchmark/methods/stiffness_method.h"

namespace live_stiffness {

class CommonPractice : public StiffnessMethod {
 public:
  static constexpr int kSteps = 50;

  enum class Jacobians { kFresh, kReused, kDamped };

  // steps: of each segment, even.
  CommonPractice(const Scene& scene, Jacobians jacobians, int steps = kSteps);

  StiffnessSolution solve(PressuresRef pressures) override;
  void reset() override { warm_ = false; }

 private:
  // Residual of the tip wrench, moments over the length, N.
  Vector6 shoot(const Vector6& base_wrench, const Wrench& tip_wrench, RodState& tip) const;
  void findJacobian(const Vector6& base_wrench, const Wrench& tip_wrench, const Vector6& residual);
  bool iterate(const Wrench& tip_wrench, Vector6& base_wrench, RodState& tip, bool fresh_jacobians);
  Matrix6 materialCompliance(const Vector6& base_wrench) const;

  LoadedChain chain_;
  Jacobians jacobians_;
  int steps_;
  Vector6 base_wrench_ = Vector6::Zero();
  Matrix6 inverse_jacobian_ = Matrix6::Identity();  // base wrench per residual
  bool warm_ = false;
};

}  // namespace live_stiffness
