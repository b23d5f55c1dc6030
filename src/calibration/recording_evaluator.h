#pragma once
// Predictions of the model for the samples of a recording, with their derivatives by the parameters.

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.h"
#include "calibration/carrying_moduli.h"

namespace live_stiffness {

// Unknowns: x, the parameters minus their start, in units of their prior sigmas; and for each recording 12 numbers
//   [w_AB, p_AB, p_TS, w_TS], R_AB = exp(w_AB) R_AB_start, R_TS = exp(w_TS) R_TS_start; m and rad.
constexpr int kRegistrationSize = 12;
constexpr double kOffsetSigma = 0.03;  // prior of the sensor's offset from T, per axis, m: it is on the tip
using RegistrationVector = Eigen::Matrix<double, kRegistrationSize, 1>;

struct CalibrationUnknowns {
  Eigen::VectorXd x;
  std::vector<RegistrationVector> registrations;  // one if it is shared or given, else one per recording
};

// One entry per sample of the recording; those of samples that are not used, or have no solution, stay as they are.
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

  // Predictions of the fitted samples at x, the derivatives only when asked for; nullptr where more than kFewShare or five of
  // them have no solution: a bad step of the fit. If fewer have none, these stay as they were, without derivatives, which are
  // central differences of solves: the solver is the only linearised rod there is, and a warm solve costs a few microseconds.
  const TipPredictions* at(const double* x, bool derivatives);
  // Poses of every sample of the recording, used or not, and which of them have a solution; the others are the identity.
  std::vector<bool> predictAll(const double* x, std::vector<Pose>& X_BT);

  // Leaves out from now on what has no solution at x. False, and the fit has lost its data, if this is more than kMostShare.
  bool chooseFitted(const double* x);
  bool fits(size_t sample) const { return fitted_[sample]; }
  long fittedCount() const;

  // After this call the wrenches of loaded samples act on the tip, oriented as the tracker saw it (what it does not measure: as
  // predicted at x); before, no wrench acts.
  void orientTips(const double* x, const Registration& registration);

  Registration registration(const RegistrationVector& r) const;
  // Adds the predicted tip poses at x of the fitted samples that nothing touches, and the sensor's poses, for fitRegistration().
  void addPairs(const double* x, std::vector<Pose>& X_BT, std::vector<Pose>& X_AS);
  // The start of the registration's unknowns.
  void startFrom(const Registration& registration) { start_ = registration; }

  const CalibrationRecording& data() const { return data_; }
  const std::string& failure() const { return failure_; }
  double correlation() const { return correlation_; }
  TrackerMeasures measures() const { return measures_; }

 private:
  // Sets the poses and `solved` of the samples `which`; false as soon as more than `most` of them have no solution.
  bool predict(const Eigen::VectorXd& values, const std::vector<bool>& which, long most, std::vector<Pose>& X_BT,
               std::vector<bool>& solved);
  // False where more than `most` samples have no solution on either side.
  bool differentiate(const Eigen::VectorXd& values, long most);

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
  TrackerMeasures measures_;
  std::vector<bool> fitted_, solved_;  // per sample; solved_: those of predictions_
  std::string failure_;
};

}  // namespace live_stiffness
