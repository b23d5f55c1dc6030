#pragma once
// The iterated extended Kalman filter of TipWrenchEstimator: what is believed, how it ages, how a pose changes it. What
// counts as contact or as an outlier, and which samples are fit to be used, is for the estimator to say.
//
// State x: wrench W at T (3 or 6 components), logarithm g of the stiffness scale, twist b of the model error.

#include <memory>

#include "live_stiffness/estimation/tip_wrench_estimator.h"

namespace live_stiffness {

class TipWrenchFilter {
 public:
  static constexpr int kMaxStates = 13;
  // Poses farther than this from what the prior expects count less, as in Huber's loss, and a robot without contact is
  // then taken to be touched; standard deviations.
  static constexpr double kRobustFrom = 2.0;
  using State = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxStates, 1>;
  using StateMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxStates, kMaxStates>;

  struct Belief {
    State x;
    StateMatrix P;  // covariance
  };
  struct Correction {
    Belief posterior;
    StiffnessSolution solution;  // equilibrium at the posterior
    double innovation = 0.0;     // of the pose, in standard deviations of what the prior expects
    int iterations = 0;
  };

  // options: checked; they must outlive this. Throws ConfigurationError on a bad scene.
  TipWrenchFilter(Scene scene, const ModelOptions& model_options, const TipWrenchOptions& options);

  // Without contact, at the stationary variances, scale 1.
  void reset();
  // What the model is given from now on: effective gauge pressures (Pa, one per chamber) and the known dead wrench at
  // T, base axes. The model takes the believed scale; allocates when that moved.
  void setInputs(PressuresRef effective, const Wrench& known);

  // False: the rotation of poses means nothing from now on.
  void setMeasuresRotation(bool measures) { measures_rotation_ = measures; }

  // The belief `elapsed` s later, pressures having changed by pressure_change (Pa, 2-norm over chambers).
  Belief predicted(double elapsed, double pressure_change, bool contact) const;
  // Equilibrium at a state; false: none, see status().
  bool solveAt(const State& x, StiffnessSolution& solution);
  // The belief after a pose (tip in base, m), by Gauss-Newton on the state. learn_scale: else the scale is held.
  // False: the model has no solution at the prior (status()), or the update broke down.
  bool correct(const Pose& measured_X_BT, const Belief& prior, bool learn_scale, Correction& result);
  void accept(const Belief& belief) { belief_ = belief; }

  const Belief& belief() const { return belief_; }
  Wrench wrench() const { return wrenchOf(belief_.x); }
  Matrix6 wrenchCovariance() const;  // zero where there is no component
  double stiffnessScale() const;
  double stiffnessScaleDeviation() const;
  Twist modelError() const { return belief_.x.segment<6>(biasIndex()); }
  // A tip pose with the model error of a state added.
  Pose withModelError(const Pose& X_BT, const State& x) const;

  const SolveStatus& status() const { return status_; }  // of the newest solve
  const StiffnessModel& model() const { return scaled_->model; }

 private:
  using Design = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxStates>;
  struct Solver {
    Solver(Scene scene, const ModelOptions& options)
        : model(std::move(scene), options), workspace(model.makeWorkspace()) {}
    StiffnessModel model;
    StiffnessWorkspace workspace;
  };

  int scaleIndex() const { return options_.components; }
  int biasIndex() const { return options_.components + 1; }
  // Of a component of the model error, 0 to 5: standard deviation, m or rad.
  double modelErrorSize(int k) const { return k < 3 ? options_.model_error_position : options_.model_error_rotation; }
  Wrench wrenchOf(const State& x) const;
  // Derivative of the tip's twist by the state, at an equilibrium.
  Design designAt(const State& x, const StiffnessSolution& solution);
  // Moves x towards x + step, halved until the model has a solution there; the share taken, or 0 if none was found.
  double moveBy(const State& step, State& x, StiffnessSolution& solution);
  // Makes the models with the factor exp(log_scale) on all moduli, if it has moved far enough since the last time.
  void setLogScale(double log_scale);

  const TipWrenchOptions& options_;
  const Scene scene_;
  const ModelOptions model_options_;
  std::unique_ptr<Solver> scaled_, stiffer_;  // at the scale, and a bit stiffer, for the derivative by it; none if it stays 1
  double log_scale_ = 0.0;                    // of scaled_
  Belief belief_;
  bool measures_rotation_ = true;
  Pressures effective_;
  Wrench known_ = Wrench::Zero();
  SolveStatus status_;
};

}  // namespace live_stiffness
