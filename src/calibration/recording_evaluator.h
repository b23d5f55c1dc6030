#pragma once
// Predictions of the model for the samples of a recording, with their derivatives by the parameters.

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.h"

namespace live_stiffness {

// Unknowns: x, the parameters minus their start, in units of their prior sigmas; and for each recording 12 numbers
//   [w_AB, p_AB, p_TS, w_TS], R_AB = exp(w_AB) R_AB_start, R_TS = exp(w_TS) R_TS_start; m and rad.
constexpr int kRegistrationSize = 12;
constexpr double kOffsetSigma = 0.03;  // prior of the sensor's offset from T, per axis, m: it is on the tip
using RegistrationVector = Eigen::Matrix<double, kRegistrationSize, 1>;

struct CalibrationUnknowns {
  Eigen::VectorXd x;
  std::vector<RegistrationVector> registrations;
};

// One entry per sample of the recording; those of samples that are not used stay as they are.
struct TipPredictions {
  std::vector<Pose> X_BT;
  // Twist of T (base axes) by parameter: d p / d value and the small rotation, SI; 6 x parameters.
  std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>> derivative;
};

// The last predictions are kept, since Ceres evaluates one sample after the other.
class RecordingEvaluator {
 public:
  RecordingEvaluator(const Scene& scene, const ChannelMap& channels, const std::vector<SceneParameter>& parameters,
                     const CalibrationRecording& data, const CalibrationOptions& options);

  // Predictions at x, the derivatives only when asked for; nullptr where a sample has no solution. Derivatives are central
  // differences of solves: the solver is the only linearised rod there is, and a warm solve costs a few microseconds.
  const TipPredictions* at(const double* x, bool derivatives);
  // Poses of every sample of the recording, used or not.
  bool predictAll(const double* x, std::vector<Pose>& X_BT) { return predict(valuesAt(parameters_, x), true, X_BT); }

  // After this call the wrenches of loaded samples act on the tip, oriented as the tracker saw it; before, no wrench acts.
  void orientTips(const Registration& registration);

  Registration registration(const RegistrationVector& r) const;
  // Sets the registration that fits best at x, by fitRegistration(), as the new start of the registration's unknowns, and
  // returns it.
  const Registration& restart(const double* x);

  const CalibrationRecording& data() const { return data_; }
  const std::string& failure() const { return failure_; }
  double correlation() const { return correlation_; }

 private:
  bool predict(const Eigen::VectorXd& values, bool all, std::vector<Pose>& X_BT);
  bool differentiate(const Eigen::VectorXd& values);

  const Scene& scene_;
  const ChannelMap& channels_;
  const std::vector<SceneParameter>& parameters_;
  const CalibrationRecording& data_;
  ModelOptions model_;
  ForceSensorMount mount_;
  ForceReadings readings_;
  std::vector<Matrix3> R_BT_;  // of each sample, as seen by the tracker
  TipPredictions predictions_;
  std::optional<Eigen::VectorXd> cached_;  // values of the predictions
  bool cache_has_derivatives_ = false, cache_ok_ = false;
  Registration start_;
  double correlation_ = 1.0;
  std::string failure_;
};

}  // namespace live_stiffness
