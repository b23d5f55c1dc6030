// parallel_node: the node that watches a parallel continuum robot; config/parallel_node.yaml has its parameters.
//
// Rod lengths in; pose and compliance of the platform, tf, markers and diagnostics out. Two threads: one takes inputs and
// publishes estimates; markers and diagnostics, on the global callback queue, lock its state only while they copy it.

#include <live_stiffness/PlatformEstimate.h>
#include <ros/callback_queue.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/parallel/parallel_scene_file.h"
#include "parallel/parameters.h"
#include "programs/parallel_markers.h"
#include "ros/any_type_subscriber.h"
#include "ros/marker_publisher.h"
#include "ros/node_process.h"
#include "ros/node_parameters.h"
#include "parameter_reader.h"
#include "ros/pose_output.h"
#include "ros/shared_diagnostics.h"
#include "ros/wrench_input.h"

namespace {

using namespace live_stiffness;

// Private parameters; parallel/parameters.h says what each is.
struct ParallelParameters {
  ParallelScene scene;
  ParallelOptions model;
  double heartbeat = kParallelHeartbeat.standard;  // Hz
  std::string length_unit = kLengthUnit.standard;       // of the lengths on the topic
  double length_timeout = kLengthTimeout.standard;      // s
  double wrench_timeout = kPlatformWrenchTimeout.standard;              // s; 0: keep the last one for ever
  FrameNames frames{kParallelBaseFrame.standard, kPlatformFrame.standard};  // B, P
  ParallelMarkerStyle style;                            // its frame is that of B
  double marker_rate = kParallelMarkerRate.standard;    // Hz

  template <class Parameters, class Visit>
  static void forEachParameter(Parameters& p, Visit&& visit) {
    visit(kParallelAccuracy, p.model.accuracy);
    visit(kParallelHeartbeat, p.heartbeat);
    visit(kLengthUnit, p.length_unit);
    visit(kLengthTimeout, p.length_timeout);
    visit(kPlatformWrenchTimeout, p.wrench_timeout);
    visit(kParallelBaseFrame, p.frames.base);
    visit(kPlatformFrame, p.frames.body);
    visit(kParallelEllipsoidScale, p.style.ellipsoid_scale);
    visit(kRotationEllipsoidScale, p.style.rotation_scale);
    visit(kParallelMarkerRate, p.marker_rate);
  }
};

// Reads and validates all of them. Throws ConfigurationError with every fault. Warns of unknown ones.
ParallelParameters loadParallelParameters(const ros::NodeHandle& private_node) {
  FaultList faults("parameters of " + private_node.getNamespace(), "~");
  ParameterReader read(privateParameters(private_node), faults);
  ParallelParameters parameters;
  ParallelParameters::forEachParameter(parameters, read);
  read.file(kSceneFile, loadParallelSceneFile, parameters.scene,
            "must be the path of a scene; launch files take it as scene:=FILE");
  warnOfUnknown(read.unknown(), "parallel_node");
  faults.checkAll(parameters);
  checkFrames(parameters.frames, kPlatformFrame, faults);
  faults.throwIfAny();
  parameters.style.frame = parameters.frames.base;
  return parameters;
}

PlatformEstimate toEstimate(const ParallelEstimate& estimate, const ros::Time& stamp, const std::string& frame) {
  PlatformEstimate message;
  fillEstimate(estimate, estimate.ellipsoids.translation, stamp, frame, message);
  message.platform_pose = toPose(estimate.solution.X_BP);
  message.length = estimate.lengths;
  message.wrench = toWrench(estimate.wrench);
  return message;
}

class ParallelNode {
 public:
  ParallelNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
      : parameters_(loadParallelParameters(private_node)),
        estimator_(parameters_.scene, parameters_.model),
        length_status_({"rod_lengths", "rod lengths", "rod lengths", "", parameters_.scene.rodCount(),
                        parameters_.length_timeout}),
        wrench_input_("platform_wrench", parameters_.frames, parameters_.wrench_timeout),
        pose_output_(private_node, "platform_pose", parameters_.frames),
        marker_publisher_(private_node, parameters_.frames.base),
        diagnostics_(node, private_node) {
    ros::NodeHandle own(private_node), estimation(node);
    estimate_publisher_ = own.advertise<PlatformEstimate>("estimate", 10);
    addDiagnostics();
    estimation.setCallbackQueue(&estimation_queue_);
    length_subscriber_.subscribe(estimation, "rod_lengths", 100, &ParallelNode::onLengths, this);
    wrench_subscriber_ = estimation.subscribe("platform_wrench", 10, &ParallelNode::onWrench, this);
    // Wall time: simulated time may stand still or jump back.
    timers_ = {estimation.createWallTimer(ros::WallDuration(1.0 / parameters_.heartbeat), &ParallelNode::onHeartbeat, this),
               node.createWallTimer(ros::WallDuration(1.0 / parameters_.marker_rate), &ParallelNode::onMarkers, this)};
    ROS_INFO("%d rods", parameters_.scene.rodCount());
    estimation_spinner_.start();
  }

 private:
  using Lock = std::lock_guard<std::mutex>;
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  // In the estimation thread.
  void onLengths(const AnyMessage& message) {
    const Lock lock(mutex_);
    Parsed<Eigen::VectorXd> lengths = readRodLengths(*message.getConstMessage(), metresPerUnit(parameters_.length_unit));
    if (!length_status_.accept(lengths, message.getPublisherName())) return;
    length_stamp_ = lengths.stamp;
    estimator_.setLengths({lengths.value.data(), lengths.value.data() + lengths.value.size()});
    onSolved();
  }
  void onWrench(const geometry_msgs::WrenchStamped& message) {
    const Lock lock(mutex_);
    const Pose* const X_BP = estimator_.estimate() ? &estimator_.estimate()->solution.X_BP : nullptr;
    if (const auto wrench = wrench_input_.read(message, X_BP)) {
      estimator_.setWrench(*wrench);
      onSolved();
    }
  }
  void onHeartbeat(const ros::WallTimerEvent&) {
    const Lock lock(mutex_);
    length_status_.checkClock();
    if (wrench_input_.expires()) {
      estimator_.setWrench(Wrench::Zero());
      onSolved();
    }
    if (isStale()) publishEstimate();
  }

  // With the mutex locked.
  void onSolved() {
    if (!estimator_.status().ok()) length_status_.logError(estimator_.statusText());
    else estimate_stamp_ = length_stamp_;
    publishEstimate();
  }
  // Why the estimate is not that of the newest lengths; empty: it is.
  std::string newestError() const {
    return length_status_.error().empty() ? estimator_.statusText() : length_status_.error();
  }
  bool isStale() const { return !newestError().empty() || length_status_.isStale(); }
  // The last good estimate, with the truth about how good it still is.
  void publishEstimate() {
    if (estimator_.estimate() == nullptr) return;
    const ParallelEstimate& estimate = *estimator_.estimate();
    PlatformEstimate message = toEstimate(estimate, estimate_stamp_, parameters_.frames.base);
    setStatus(estimator_.status().code, newestError(), length_status_.isStale(), parameters_.length_timeout,
              "rod lengths", message);
    estimate_publisher_.publish(message);
    if (!message.stale) pose_output_.publish(estimate.solution.X_BP, estimate_stamp_);
  }

  // In the thread of the global callback queue.
  void onMarkers(const ros::WallTimerEvent&) {
    std::optional<ParallelEstimate> newest;
    ros::Time stamp;
    bool stale;
    {
      const Lock lock(mutex_);
      if (estimator_.estimate() != nullptr) newest = *estimator_.estimate();
      stamp = estimate_stamp_;
      stale = isStale();
    }
    if (newest)
      marker_publisher_.publish(makeParallelMarkers(*newest, parameters_.scene, stale, parameters_.style, stamp));
  }
  void addDiagnostics() {
    diagnostics_.add("Rod lengths", [this](Status& status) {
      const Lock lock(mutex_);
      length_status_.diagnose(estimator_.statusText(), "", "", status);
    });
    diagnostics_.add("Solver", [this](Status& status) {
      const Lock lock(mutex_);
      reportSolver(estimator_, wrench_input_.error(), status);
    });
  }

  ros::CallbackQueue estimation_queue_;
  ParallelParameters parameters_;

  std::mutex mutex_;  // of these
  ParallelEstimator estimator_;
  ArrayStatus length_status_;
  WrenchInput wrench_input_;
  PoseOutput pose_output_;
  ros::Time length_stamp_;    // of the newest usable lengths
  ros::Time estimate_stamp_;  // of the lengths of the last good estimate

  ros::Publisher estimate_publisher_;
  MarkerPublisher marker_publisher_;
  NodeDiagnostics diagnostics_;

  // Last, so that no callback runs before the rest exists; and the spinner stops first.
  AnyTypeSubscriber length_subscriber_;
  ros::Subscriber wrench_subscriber_;
  std::vector<ros::WallTimer> timers_;
  ros::AsyncSpinner estimation_spinner_{1, &estimation_queue_};
};

}  // namespace

int main(int argc, char** argv) { return runNode<ParallelNode>(argc, argv, "parallel_node"); }
