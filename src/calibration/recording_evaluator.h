#pragma once
// Predictions of the model for all samples of a recording.

#include <string>
#include <vector>

#include "calibration/calibration_unknowns.h"
#include "calibration/calibration.h"

namespace live_stiffness {

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
