// rig_simulator: a node that plays a rig. Publishes chamber_pressures, aurora_pose and, as truth, ~true_tip_pose and
// ~true_tip_wrench (of the pusher, base axes); with a pusher also tip_force_torque, which a force sensor at T measures.

#include <ros/ros.h>

#include "live_stiffness/rod/scene_file.h"
#include "rig/rig_model.h"
#include "ros/conversions.h"
#include "ros/node_process.h"
#include "ros/node_parameters.h"
#include "parameter_reader.h"

namespace {

using namespace live_stiffness;

// Private parameters; rig/parameters.h says what each is.
struct RigParameters {
  Scene scene;
  RigOptions options;
  double rate = kSampleRate.standard;                     // samples per second
  std::string tracker_frame = kRigTrackerFrame.standard;  // frame_id of the tracker's poses
  std::string base_frame = kRigBaseFrame.standard;        // frame_id of the true tip pose and of the true wrench
};

Vector3 readVector3(ParameterReader& read, const NumbersParameter& parameter, FaultList& faults) {
  std::vector<double> values = parameter.standard;
  read(parameter, values);
  if (values.size() == 3) return {values[0], values[1], values[2]};
  faults.add(parameter.key + (" has " + std::to_string(values.size())) + " entries: must have three, x, y and z");
  return Vector3::Zero();
}

// Reads and validates all of them. Throws ConfigurationError with every fault. Warns of unknown ones.
RigParameters loadRigParameters(const ros::NodeHandle& private_node) {
  FaultList faults("parameters of " + private_node.getNamespace(), "~");
  ParameterReader read(privateParameters(private_node), faults);
  RigParameters parameters;
  RigOptions& options = parameters.options;
  RigOptions::forEachParameter(options, read);
  options.contact.wrench << readVector3(read, kPushForce, faults), readVector3(read, kPushMoment, faults);
  read(kSampleRate, parameters.rate);
  read(kRigTrackerFrame, parameters.tracker_frame);
  read(kRigBaseFrame, parameters.base_frame);
  read.file(kSceneFile, loadSceneFile, parameters.scene, "must be the path of a scene; launch files take it as scene:=FILE");
  read.file(kRigRegistrationFile, loadRegistrationFile, options.registration);
  warnOfUnknown(read.unknown(), "rig_simulator");
  faults.check(kSampleRate, parameters.rate);
  faults.checkAll(options);
  options.contact.check(faults);
  faults.throwIfAny();
  return parameters;
}

class RigSimulator {
 public:
  RigSimulator(ros::NodeHandle node, const ros::NodeHandle& private_node)
      : parameters_(loadRigParameters(private_node)),
        rig_(parameters_.scene, parameters_.options),
        pressures_(node.advertise<ChamberPressures>("chamber_pressures", 10)),
        tracker_(node.advertise<geometry_msgs::PoseStamped>("aurora_pose", 10)),
        truth_(ros::NodeHandle(private_node).advertise<geometry_msgs::PoseStamped>("true_tip_pose", 10)),
        true_wrench_(ros::NodeHandle(private_node).advertise<geometry_msgs::WrenchStamped>("true_tip_wrench", 10)),
        timer_(node.createTimer(ros::Duration(1.0 / parameters_.rate), &RigSimulator::onTimer, this)) {
    if (parameters_.options.contact.exists())
      force_sensor_ = node.advertise<geometry_msgs::WrenchStamped>("tip_force_torque", 10);
  }

 private:
  void onTimer(const ros::TimerEvent&) {
    const ros::Time now = ros::Time::now();
    if (start_.isZero() || now < start_) start_ = now;
    const double time = (now - start_).toSec();
    if (time < last_time_) return;  // simulated time jumped back: wait until it has caught up
    last_time_ = time;
    try {
      const RigSample sample = rig_.step(time);
      pressures_.publish(toPressures(sample.measured_channels, now));
      if (sample.X_AS) tracker_.publish(toPoseStamped(*sample.X_AS, now, parameters_.tracker_frame));
      truth_.publish(toPoseStamped(sample.X_BT, now, parameters_.base_frame));
      true_wrench_.publish(toWrenchStamped(sample.contact_wrench, now, parameters_.base_frame));
      if (force_sensor_) force_sensor_.publish(toWrenchStamped(sample.sensedContact(), now, kForceSensorFrame));
    } catch (const std::runtime_error& error) {
      ROS_ERROR_THROTTLE(1.0, "%s", error.what());
    }
  }

  RigParameters parameters_;
  RigModel rig_;
  ros::Time start_;
  double last_time_ = 0.0;
  ros::Publisher pressures_, tracker_, truth_, true_wrench_, force_sensor_;
  ros::Timer timer_;
};

}  // namespace

int main(int argc, char** argv) { return runNode<RigSimulator>(argc, argv, "rig_simulator"); }
