#pragma once
// Predictions of the model for all samples of a recording.

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

// Predictions for one recording. Those of the last x are kept, since Ceres evaluates one sample after the other.
class RecordingEvaluator {
 public:
  RecordingEvaluator(const Scene& scene, const ChannelMap& channels, const std::vector<SceneParameter>& parameters,
                     const CalibrationRecording& data, const CalibrationOptions& options);

  // Predictions at x; nullptr where a sample has no solution.
  const std::vector<TipPrediction>* at(const double* x, bool derivatives);
  // The same for every sample of the recording, used or not.
  bool predictAll(const double* x, std::vector<TipPrediction>& predictions);

  // After this call the wrenches of loaded samples act on the tip, oriented as the tracker saw it; before, no wrench acts.
  void orientTips(const Registration& registration);

  Registration registration(const RegistrationVector& r) const;
  // Sets the registration that fits best at x, by fitRegistration(), as the new start of the registration's unknowns.
  void restart(const double* x);

  const Registration& startRegistration() const { return start_; }
  const CalibrationRecording& data() const { return data_; }
  const std::string& failure() const { return predictor_.failure(); }
  double correlation() const { return correlation_; }

 private:
  bool isPushed(size_t i) const { return !R_BT_.empty() && data_.loaded[i] && data_.recording.samples[i].tip_wrench; }
  void placeWrenches(const ForceSensorMount& mount, std::vector<ActuationSample>& samples) const;

  TipPredictor predictor_;
  const CalibrationRecording& data_;
  ForceSensorMount mount_;
  ForceReadings readings_;
  std::vector<Matrix3> R_BT_;  // of each sample, as seen by the tracker
  std::vector<ActuationSample> samples_;
  std::vector<TipPrediction> predictions_;
  Eigen::VectorXd cached_;
  bool has_cache_ = false, cache_has_derivatives_ = false, cache_ok_ = false;
  Registration start_;
  double correlation_ = 1.0;
};

}  // namespace live_stiffness
