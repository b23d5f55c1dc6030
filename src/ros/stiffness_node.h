#pragma once
// The node, alone or as a nodelet: inputs, estimator, outputs. No mathematics here.
//
// Three threads, so that nothing delays an estimate, and two mutexes. The estimation thread takes pressures and known
// wrenches and publishes estimates, under estimation_mutex_. The tracking thread takes tracker poses and estimates
// contact, under tracking_mutex_. Everything else (markers, handle, services, diagnostics) runs in the thread that spins
// the global callback queue, and holds a mutex only while it copies. Order of locking: tracking, estimation.

#include <diagnostic_updater/update_functions.h>
#include <dynamic_reconfigure/server.h>
#include <live_stiffness/ComplianceAt.h>
#include <live_stiffness/DirectionalStiffness.h>
#include <live_stiffness/PredictDeflection.h>
#include <live_stiffness/StiffnessConfig.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ros/any_type_subscriber.h"
#include "ros/estimate_snapshot.h"
#include "ros/estimate_updater.h"
#include "ros/marker_publisher.h"
#include "ros/pose_output.h"
#include "ros/registration_service.h"
#include "ros/shared_diagnostics.h"
#include "ros/tip_comparison.h"

namespace live_stiffness {

class TipHandle;

class StiffnessNode : private EstimateOutput {
 public:
  // Subscribes and advertises. Throws ConfigurationError with every fault of the parameters. The caller must spin the global
  // callback queue, in one thread.
  StiffnessNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  ~StiffnessNode() override;

 private:
  using Lock = std::lock_guard<std::mutex>;

  void subscribe(const ros::NodeHandle& node);
  void addDiagnostics();

  // In the estimation thread.
  void onPressures(const AnyMessage& message);
  void onChannelPressure(const sensor_msgs::FluidPressure& message, size_t channel);
  void onTipWrench(const geometry_msgs::WrenchStamped& message);
  void onHeartbeat(const ros::WallTimerEvent&);
  // With estimation_mutex_ locked.
  void onEstimate(const StiffnessEstimate::ConstPtr& estimate, const Pose* X_BT) override;
  std::shared_ptr<const StiffnessModel> model() const { return {updater_.estimator(), &updater_.estimator()->model()}; }

  // In the tracking thread.
  void onTrackerPose(const AnyMessage& message);
  void onTf(const tf2_msgs::TFMessage& transforms, bool is_static);
  void onTrackingHeartbeat(const ros::WallTimerEvent&);
  // With tracking_mutex_ locked.
  void compare(const std::optional<Parsed<Pose>>& X_AS);
  void onTrackingError(const TrackingError& error) override { error_publisher_.publish(error); }
  void onContact(const TipContact& contact, const geometry_msgs::WrenchStamped& wrench) override;

  // In the thread of the global callback queue.
  EstimateSnapshot snapshot();  // locks estimation_mutex_
  void onMarkers(const ros::WallTimerEvent&);
  void addServices();
  // All services return true; a request that cannot be fulfilled gets success = false.
  bool reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool reload(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);
  bool predictDeflection(PredictDeflection::Request& request, PredictDeflection::Response& response);
  bool complianceAt(ComplianceAt::Request& request, ComplianceAt::Response& response);
  bool directionalStiffness(DirectionalStiffness::Request& request, DirectionalStiffness::Response& response);
  // Fills what the last three answers share. answer: fills the rest for the newest estimate; returns why it cannot, empty if
  // it can.
  template <class Response, class Answer>
  bool reply(Response& response, Answer answer);
  void reconfigure(StiffnessConfig& wanted, uint32_t level);
  // Makes estimators with these parameters and stores them. Throws ConfigurationError, and then nothing has changed.
  void setParameters(const NodeParameters& parameters, bool keeps_inputs);

  NodeParameters parameters_;
  ros::CallbackQueue estimation_queue_, tracking_queue_;
  std::mutex estimation_mutex_, tracking_mutex_;
  ros::NodeHandle node_, private_node_;
  ros::Publisher estimate_publisher_, backbone_publisher_, error_publisher_, contact_publisher_, wrench_publisher_;
  MarkerPublisher marker_publisher_;

  EstimateUpdater updater_;   // of the estimation thread
  PoseOutput pose_output_;    // the same
  TipComparison comparison_;  // of the tracking thread

  ModelWorkspace solver_;  // of the services
  RegistrationService registration_;
  std::unique_ptr<TipHandle> tip_handle_;  // none unless enabled

  double highest_rate_ = 1e5;  // of estimates, Hz
  diagnostic_updater::FrequencyStatus frequency_{{&parameters_.heartbeat, &highest_rate_}, "Estimates"};
  // Of pressures when their estimate is published: at most 0.1 s ahead, at most 1 s behind.
  diagnostic_updater::TimeStampStatus time_stamps_{{-0.1, 1.0}, "Time stamps"};
  NodeDiagnostics diagnostics_;  // after these, which it reads

  StiffnessConfig config_;               // the present one
  boost::recursive_mutex config_mutex_;  // ours: with its own, updateConfig() warns of deadlocks
  dynamic_reconfigure::Server<StiffnessConfig> config_server_{config_mutex_, private_node_};

  // Last, so that no callback runs before the rest exists; and the spinners stop first.
  AnyTypeSubscriber pressure_subscriber_, pose_subscriber_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> servers_;
  std::vector<ros::WallTimer> timers_;
  ros::AsyncSpinner estimation_spinner_{1, &estimation_queue_}, tracking_spinner_{1, &tracking_queue_};
};

}  // namespace live_stiffness
