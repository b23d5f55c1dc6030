#pragma once
// The least-squares problem of a calibration: evaluation of predictions, residuals and their derivatives, and its
// solution by Ceres for any choice of data left out.

#include <limits>
#include <memory>

#include "live_stiffness/calibration/calibration.h"

namespace live_stiffness {

// Unknowns: x, the parameters in units of their prior sigmas from their start; and for each recording 12 numbers
//   [w_AB, p_AB, p_TS, w_TS], R_AB = exp(w_AB) R_AB_start, R_TS = exp(w_TS) R_TS_start; m and rad.
constexpr int kRegistrationSize = 12;
constexpr double kOffsetSigma = 0.03;  // prior of the sensor's offset from T, per axis, m: it is on the tip
using RegistrationVector = Eigen::Matrix<double, kRegistrationSize, 1>;

struct CalibrationUnknowns {
  Eigen::VectorXd x;
  std::vector<RegistrationVector> registrations;
};

// Predictions of one recording, kept for the x of the last call, since Ceres asks sample by sample.
class RecordingEvaluator {
 public:
  RecordingEvaluator(const Scene& scene, const ChannelMap& channels, const std::vector<SceneParameter>& parameters,
                     const CalibrationRecording& data, const CalibrationOptions& options);

  // Predictions at x; nullptr where a sample has no solution. All samples, used or not, where `all`.
  const std::vector<TipPrediction>* at(const double* x, bool derivatives);
  // The same for every sample of the recording.
  bool predictAll(const double* x, std::vector<TipPrediction>& predictions);

  // Wrenches of the loaded samples, with the tip oriented as the tracker saw it.
  void updateWrenches(const Registration& registration);

  Registration registration(const RegistrationVector& r) const;
  // Registration that fits best at x, by fitRegistration(), as the new start from which registrations are counted.
  void restart(const double* x);

  const Registration& startRegistration() const { return start_; }
  const CalibrationRecording& data() const { return data_; }
  const std::string& failure() const { return predictor_.failure(); }
  double correlation() const { return correlation_; }

 private:
  TipPredictor predictor_;
  const CalibrationRecording& data_;
  ForceSensorMount mount_;
  std::vector<ActuationSample> samples_;
  std::vector<TipPrediction> predictions_;
  Eigen::VectorXd cached_;
  bool has_cache_ = false, cache_has_derivatives_ = false, cache_ok_ = false;
  Registration start_;
  double correlation_ = 1.0;
};

class CalibrationProblem {
 public:
  CalibrationProblem(const Scene& scene, const ChannelMap& channels, const std::vector<SceneParameter>& parameters,
                     const std::vector<CalibrationRecording>& recordings, const std::vector<ComplianceRow>& rows,
                     const CalibrationOptions& options);

  struct Sigmas {
    double position, rotation;
  };
  // What to leave out: a block of a recording or a row; none by default.
  struct LeftOut {
    int recording = -1, block = -1, row = -1;
  };
  struct Solution {
    CalibrationUnknowns unknowns;
    bool converged = false;
    std::string message;
    int iterations = 0;
    Eigen::MatrixXd jacobian;  // of all whitened, robustified residuals without priors; columns x, then registrations
    Eigen::VectorXd residuals;
  };
  // tolerance: relative change of the cost at which the search ends.
  Solution solve(const CalibrationUnknowns& start, const Sigmas& sigmas, const LeftOut& left_out, double tolerance,
                 bool want_jacobian = false);

  CalibrationUnknowns start();
  Eigen::VectorXd values(const Eigen::VectorXd& x) const;  // SI
  RecordingEvaluator& evaluator(size_t recording) { return *evaluators_[recording]; }
  // Block of a sample, 0 to options.blocks - 1: equal spans of time of the samples used.
  int blockOf(size_t recording, size_t sample) const { return blocks_[recording][sample]; }
  // Compliance of a row at x, m/N. False if there is no solution.
  bool rowCompliance(size_t row, const double* x, Matrix3& compliance) const;

 private:
  const Scene& scene_;
  const std::vector<SceneParameter>& parameters_;
  const std::vector<ComplianceRow>& rows_;
  const CalibrationOptions& options_;
  std::vector<std::unique_ptr<RecordingEvaluator>> evaluators_;
  std::vector<std::vector<int>> blocks_;
};

}  // namespace live_stiffness
