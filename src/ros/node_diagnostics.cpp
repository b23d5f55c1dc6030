// Diagnostics of a StiffnessNode.

#include "ros/stiffness_node.h"

namespace live_stiffness {

using Status = diagnostic_updater::DiagnosticStatusWrapper;

void StiffnessNode::addDiagnostics() {
  diagnostics_.add("Pressures", [this](Status& status) {
    const Lock lock(estimation_mutex_);
    pressure_input_.status().diagnose(estimator_->statusText(), status);
  });
  diagnostics_.add("Tracker", [this](Status& status) {
    const Lock lock(tracking_mutex_);
    tracker_input_.diagnose(status);
    status.add("tracking error (mm)", 1e3 * tracking_error_);
  });
  diagnostics_.add("Contact", [this](Status& status) {
    const Lock lock(tracking_mutex_);
    contact_.diagnose(status);
  });
  diagnostics_.add("Solver", [this](Status& status) {
    const Lock lock(estimation_mutex_);
    status.add("model", modelName(parameters_.model) + ", " + steppingName(parameters_.model.stepping));
    reportSolver(*estimator_, wrench_input_.error(), status);
    if (is_paused_) status.summary(diagnostic_msgs::DiagnosticStatus::WARN, newestError());
  });
  diagnostics_.add(frequency_);
  diagnostics_.add(time_stamps_);
}

}  // namespace live_stiffness
