#pragma once
// Common practice in its textbook form, in the style of Till's tutorials (ContinuumRobotExamples): the state as one long vector
// of run-time size, 100 steps, shooting on the base wrench by Levenberg's method with forward differences. The compliance takes
// six more solves, each under a small tip wrench.

#include "benchmark/methods/loaded_chain.h"
#include "benchmark/methods/stiffness_method.h"

namespace live_stiffness {

class Textbook : public StiffnessMethod {
 public:
  explicit Textbook(const Scene& scene, int steps = 100);

  StiffnessSolution solve(PressuresRef pressures) override;
  void reset() override { base_wrench_ = Eigen::VectorXd(); }

 private:
  using States = std::vector<Eigen::VectorXd>;  // [p, R by columns, n, m] at every step of every segment, then at T
  States shoot(const Eigen::VectorXd& base_wrench) const;
  Eigen::VectorXd residual(const Eigen::VectorXd& tip, const Eigen::VectorXd& tip_wrench) const;
  bool iterate(const Eigen::VectorXd& tip_wrench, Eigen::VectorXd& base_wrench, States& states) const;

  LoadedChain chain_;
  int steps_;
  Eigen::VectorXd base_wrench_;  // empty: cold
};

}  // namespace live_stiffness
