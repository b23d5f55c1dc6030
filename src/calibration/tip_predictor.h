#pragma once
// Tip poses of many samples at once, with their derivatives by the scene's parameters.

#include <vector>

#include "calibration/scene_parameter.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

// Pressures and wrench on the robot at one time.
struct ActuationSample {
  double time = 0.0;                    // s, not decreasing, because of creep
  Pressures channels;                   // gauge, Pa, one per channel
  Wrench tip_wrench = Wrench::Zero();   // dead wrench at T, base axes
  bool wanted = true;                   // false: only for the creep; not solved
};

struct TipPrediction {
  Pose X_BT;
  // Twist of T (base axes) by parameter: d p / d value and the small rotation, SI; 6 x parameters.
  Eigen::Matrix<double, 6, Eigen::Dynamic> derivative;
  // Twist [v; w] of T by a dead wrench [f; m] there, base axes, SI, 6x6; zero if the model ignores loads.
  Matrix6 compliance;
};

class TipPredictor {
 public:
  TipPredictor(Scene scene, ModelOptions options, ChannelMap channels, std::vector<SceneParameter> parameters);

  // Predictions at these parameter values (SI), one per sample; those not wanted are not changed. False if a sample
  // has no solution; failure() has the reason.
  //
  // The equilibrium comes from the solver. Derivatives: material, load steps, creep and masses by automatic differentiation,
  // then the rod linearised along the equilibrium, and the base moment m0 eliminated by the implicit function theorem,
  // dX = X_theta - X_m0 r_m0^-1 r_theta, r the residual moment. No step size is needed, and no further solve.
  bool predict(const Eigen::VectorXd& values, const std::vector<ActuationSample>& samples, bool derivatives,
               std::vector<TipPrediction>& predictions);

  const std::string& failure() const { return failure_; }
  const Scene& scene() const { return scene_; }
  const ModelOptions& options() const { return options_; }
  const ChannelMap& channels() const { return channels_; }
  const std::vector<SceneParameter>& parameters() const { return parameters_; }

 private:
  Scene scene_;
  ModelOptions options_;
  ChannelMap channels_;
  std::vector<SceneParameter> parameters_;
  std::string failure_;
};

}  // namespace live_stiffness
