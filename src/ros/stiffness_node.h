#pragma once
// The node, alone or as a nodelet: inputs, estimator, outputs. No mathematics and no message fields here.
//
// Four threads, so that nothing delays an estimate. The live lane takes pressures and known wrenches and publishes
// estimates. The tracking lane takes tracker poses and estimates contact. The drawing lane makes markers and answers the
// handle: on the global callback queue it would keep a subscriber in the same process waiting. All else (services,
// diagnostics) runs where the process spins that queue. Each looks at another's state under its mutex, for as long as it
// takes to copy it. Order of locking: drawing, tracking, live.

#include <diagnostic_updater/diagnostic_updater.h>
#include <diagnostic_updater/update_functions.h>
#include <dynamic_reconfigure/server.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <string>
#include <vector>

#include "estimation/motion_history.h"
#include "ros/callback_lane.h"
#include "ros/clock_watch.h"
#include "ros/contact_output.h"
#include "ros/markers.h"
#include "ros/node_parameters.h"
#include "ros/pose_output.h"
#include "ros/pressure_input.h"
#include "ros/reconfiguration.h"
#include "ros/registration_service.h"
#include "ros/stiffness_services.h"
#include "ros/tip_handle.h"
#include "ros/tracker_input.h"
#include "ros/wrench_input.h"

namespace live_stiffness {

class StiffnessNode {
 public:
  // Subscribes and advertises. Throws ConfigurationError with every fault of the parameters. Spin the global callback
  // queue, in one thread.
  StiffnessNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  ~StiffnessNode();

 private:
  using Lock = std::lock_guard<std::mutex>;
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  // On the live lane.
  void onPressures(const Pressures& pressures, const ros::Time& stamp);
  void onHeartbeat(const ros::TimerEvent&);
  void react(StiffnessEstimator::Outcome outcome);
  // Why the estimate is not that of the newest pressures; empty: it is.
  std::string newestFault() const;
  bool isStale() const { return !newestFault().empty() || pressure_input_.isStale(); }
  void publishEstimate();
  std::shared_ptr<const StiffnessModel> model() const { return {estimator_, &estimator_->model()}; }
  NewestEstimate newestOfLane() const;

  // On the tracking lane.
  void onTracked(const Pose& X_AS, const Pose& measured_X_BT, const ros::Time& stamp);

  // On the drawing lane.
  void onMarkers(const ros::TimerEvent&);
  // The robot's shape, base to tip.
  std::vector<Station> shapeOf(const NewestEstimate& newest);

  // Elsewhere; newest() everywhere but on the live lane.
  NewestEstimate newest();
  void addDiagnostics();
  void addServices();
  bool reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool reload(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  void onReconfigure(StiffnessConfig& config, uint32_t level);
  // Makes estimators by the parameters, which from then on hold; throws ConfigurationError, and then nothing has changed.
  void renew(const NodeParameters& parameters, bool keeps_inputs);

  NodeParameters parameters_;
  CallbackLane live_, tracking_, drawing_;
  ros::NodeHandle node_, private_node_;
  std::shared_ptr<StiffnessEstimator> estimator_;
  MotionHistory history_;  // of the live lane
  PoseOutput pose_output_;
  OwnSolver shape_solver_;  // of the drawing lane
  ros::Publisher estimate_publisher_, backbone_publisher_, marker_publisher_, error_publisher_;
  ContactOutput contact_;
  ClockWatch clock_watch_;
  diagnostic_updater::Updater diagnostics_;
  double lowest_rate_, highest_rate_ = 1e5;  // of estimates, Hz
  diagnostic_updater::FrequencyStatus frequency_;
  diagnostic_updater::TimeStampStatus time_stamps_;

  ros::Time pressure_stamp_;  // of the newest usable pressures
  ros::Time estimate_stamp_;  // of the pressures of the last good estimate
  std::string input_fault_;   // why the newest pressures cannot even be read; empty: they can
  bool is_paused_ = false;
  double tracking_error_ = 0.0;  // newest distance, m

  // Last, so that no callback runs before the rest exists.
  WrenchInput wrench_input_;
  PressureInput pressure_input_;
  TrackerInput tracker_input_;
  StiffnessServices services_;
  RegistrationService registration_;
  std::unique_ptr<TipHandle> tip_handle_;  // none unless enabled
  std::vector<ros::ServiceServer> servers_;
  std::vector<ros::Timer> timers_;
  ros::WallTimer diagnostics_timer_;  // wall time: a paused or missing clock is just what it must report
  StiffnessConfig config_;            // that holds
  std::unique_ptr<dynamic_reconfigure::Server<StiffnessConfig>> reconfiguration_;
};

}  // namespace live_stiffness
