#pragma once
// Common practice in its textbook form: the state as one long vector of run-time size, 100 steps, a fresh Jacobian of
// forward differences in every iteration, and every one of the six solves for the compliance from scratch.

#include <Eigen/LU>

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
  bool newton(const Eigen::VectorXd& tip_wrench, Eigen::VectorXd& base_wrench, States& states) const;

  LoadedChain chain_;
  int steps_;
  Eigen::VectorXd base_wrench_;  // empty: cold
};

}  // namespace live_stiffness
