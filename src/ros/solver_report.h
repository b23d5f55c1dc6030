#pragma once
// Diagnostics of the solver, for both kinds of robot.

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <string>

namespace live_stiffness {

// estimator: StiffnessEstimator or ParallelEstimator. wrench_error: what is wrong with the known wrench,
// or empty.
template <class Estimator>
void reportSolver(const Estimator& estimator, const std::string& wrench_error,
                  diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!estimator.status().ok())
    status.summary(DiagnosticStatus::ERROR, estimator.statusText());
  else if (estimator.estimate() == nullptr)
    status.summary(DiagnosticStatus::WARN, "nothing solved yet");
  else if (!wrench_error.empty())
    status.summary(DiagnosticStatus::WARN, wrench_error);
  else
    status.summary(DiagnosticStatus::OK, "ok");
  if (estimator.estimate() == nullptr) return;
  status.add("solve time (us)", 1e6 * estimator.estimate()->solve_time);
  status.add("iterations", estimator.estimate()->solution.iterations);
  status.add("numerical error", estimator.estimate()->solution.numerical_error);
}

}  // namespace live_stiffness
