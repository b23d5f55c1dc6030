#pragma once
// The least-squares problem of a calibration, and its solution by Ceres for any choice of data left out.

#include <ceres/problem.h>

#include <memory>
#include <string>
#include <vector>

#include "calibration/calibration_costs.h"

namespace live_stiffness {

class CalibrationProblem {
 public:
  CalibrationProblem(const Scene& scene, const ChannelMap& channels, const std::vector<SceneParameter>& parameters,
                     const std::vector<CalibrationRecording>& recordings, const std::vector<ComplianceRow>& rows,
                     const CalibrationOptions& options);

  // What to leave out: a block of a recording or a row; none by default.
  struct LeftOut {
    int recording = -1, block = -1, row = -1;
  };
  struct Solution {
    CalibrationUnknowns unknowns;
    bool converged = false;
    std::string message;
    int iterations = 0;
    Eigen::MatrixXd jacobian;  // of residuals without priors, divided by sigmas, with Huber's loss; columns x, then registrations
    Eigen::VectorXd residuals;
  };
  // tolerance: relative change of the cost at which the search ends.
  Solution solve(const CalibrationUnknowns& start, const ResidualSigmas& sigmas, const LeftOut& left_out, double tolerance,
                 bool want_jacobian = false);

  // Leaves out samples that have no solution there. Throws ConfigurationError when a fifth of a recording's have none.
  // advice: added then.
  CalibrationUnknowns start(const std::string& advice = "");
  Eigen::VectorXd values(const Eigen::VectorXd& x) const;  // SI
  RecordingEvaluator& evaluator(size_t recording) { return *evaluators_[recording]; }
  size_t registrationIndex(size_t recording) const { return options_.shared_registration || options_.given ? 0 : recording; }
  Registration registration(const CalibrationUnknowns& unknowns, size_t recording) const {
    return evaluators_[recording]->registration(unknowns.registrations[registrationIndex(recording)]);
  }
  // Block of a sample, 0 to options.blocks - 1: equal spans of time of the samples used.
  int blockOf(size_t recording, size_t sample) const { return blocks_[recording][sample]; }
  // Compliance of a row at these values (SI) of the parameters, m/N. False if there is no solution.
  bool rowCompliance(size_t row, const Eigen::VectorXd& values, Matrix3& compliance) const;

 private:
  // Adds the residuals of all data but those left out, and returns their blocks; then those of the priors.
  std::vector<ceres::ResidualBlockId> addData(ceres::Problem& problem, CalibrationUnknowns& unknowns,
                                              const ResidualSigmas& sigmas, const LeftOut& left_out);
  void addPriors(ceres::Problem& problem, CalibrationUnknowns& unknowns, const ResidualSigmas& sigmas) const;
  bool measuresRotation(size_t registration) const;  // all three angles of the sensor, in one of its recordings
  void search(ceres::Problem& problem, double tolerance, Solution& solution) const;

  const Scene& scene_;
  const std::vector<SceneParameter>& parameters_;
  const std::vector<ComplianceRow>& rows_;
  const CalibrationOptions& options_;
  std::vector<std::unique_ptr<RecordingEvaluator>> evaluators_;
  std::vector<std::vector<int>> blocks_;
};

}  // namespace live_stiffness
