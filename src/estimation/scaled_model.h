#pragma once
// A stiffness model with a factor on all its moduli, and the derivative by that factor.

#include <memory>

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

class ScaledModel {
 public:
  // Models are rebuilt when the logarithm of the scale has changed by more than this; until then the solution is that of the
  // last rebuild (error: at most 1e-3 of the deflection).
  static constexpr double kRebuildAfter = 1e-3;
  static constexpr double kDifference = 1e-2;  // of the logarithm, for the derivative: truncation 1 % of it

  // Throws ConfigurationError on bad options or scene. with_derivative: keeps a second model for it.
  ScaledModel(Scene scene, const ModelOptions& options, bool with_derivative);

  // Factor exp(log_scale) on all moduli; allocates when it rebuilds.
  void setLogScale(double log_scale);

  // Equilibrium at the scale (see StiffnessModel::solve()).
  StiffnessSolution solve(PressuresRef pressures, const Wrench& tip_wrench);
  // Twist of T (base axes) by the logarithm of the scale, at the last solve's arguments; zero without derivative or
  // where the second model has no solution. X_BT: of the last solve.
  Twist derivative(PressuresRef pressures, const Wrench& tip_wrench, const Pose& X_BT);

  const StiffnessModel& model() const { return scaled_->model; }

 private:
  struct Solver {
    Solver(Scene scene, const ModelOptions& options)
        : model(std::move(scene), options), workspace(model.makeWorkspace()) {}
    StiffnessModel model;
    StiffnessWorkspace workspace;
  };
  void rebuild(double log_scale);

  Scene scene_;
  ModelOptions options_;
  bool with_derivative_;
  double log_scale_ = 0.0;
  std::unique_ptr<Solver> scaled_, stiffer_;
};

}  // namespace live_stiffness
