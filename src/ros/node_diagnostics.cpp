// Diagnostics of a StiffnessNode.

#include "ros/stiffness_node.h"

namespace live_stiffness {

using Status = diagnostic_updater::DiagnosticStatusWrapper;

void StiffnessNode::addDiagnostics() {
  diagnostics_.add("Pressures", [this](Status& status) {
    const Lock lock(estimation_mutex_);
    updater_.pressures().diagnose(updater_.estimator()->statusText(), status);
  });
  diagnostics_.add("Tracker", [this](Status& status) {
    const Lock lock(tracking_mutex_);
    comparison_.diagnoseTracker(status);
  });
  diagnostics_.add("Contact", [this](Status& status) {
    const Lock lock(tracking_mutex_);
    comparison_.diagnoseContact(status);
  });
  diagnostics_.add("Solver", [this](Status& status) {
    const Lock lock(estimation_mutex_);
    status.add("model", modelName(parameters_.model) + ", " + steppingName(parameters_.model.stepping));
    reportSolver(*updater_.estimator(), updater_.wrenches().error(), status);
    if (updater_.isPaused()) status.summary(diagnostic_msgs::DiagnosticStatus::WARN, updater_.newestError());
  });
  diagnostics_.add(frequency_);
  diagnostics_.add(time_stamps_);
}

}  // namespace live_stiffness
