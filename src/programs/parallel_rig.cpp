// parallel_rig: a node that moves a parallel robot. Publishes the rod lengths that lead its platform round a circle.

#include <live_stiffness/RodLengths.h>
#include <ros/ros.h>

#include <cmath>

#include "live_stiffness/parallel/parallel_model.h"
#include "live_stiffness/parallel/parallel_scene_file.h"
#include "parallel/parameters.h"
#include "ros/node_process.h"
#include "ros/node_parameters.h"
#include "parameter_reader.h"

namespace {

using namespace live_stiffness;

struct Motion {
  double radius = kCircleRadius.standard;  // m
  double height = kCircleHeight.standard;  // m
  double period = kCirclePeriod.standard;  // s, of a round; 0: the platform stands still on the circle, at x = radius
  double rate = kLengthRate.standard;      // lengths per second

  template <class Options, class Visit>
  static void forEachParameter(Options& motion, Visit&& visit) {
    visit(kCircleRadius, motion.radius);
    visit(kCircleHeight, motion.height);
    visit(kCirclePeriod, motion.period);
    visit(kLengthRate, motion.rate);
  }

  Pose at(double time) const {
    const double angle = period > 0.0 ? 2.0 * kPi * time / period : 0.0;
    return {Matrix3::Identity(), Vector3(radius * std::cos(angle), radius * std::sin(angle), height)};
  }
};

class ParallelRig {
 public:
  ParallelRig(ros::NodeHandle node, const ros::NodeHandle& private_node)
      : model_(load(private_node, motion_), ParallelOptions()),
        workspace_(model_.makeWorkspace()),
        lengths_(node.advertise<RodLengths>("rod_lengths", 10)),
        timer_(node.createTimer(ros::Duration(1.0 / motion_.rate), &ParallelRig::onTimer, this)) {}

 private:
  static ParallelScene load(const ros::NodeHandle& private_node, Motion& motion) {
    FaultList faults("parameters of " + private_node.getNamespace(), "~");
    ParameterReader read(privateParameters(private_node), faults);
    ParallelScene scene;
    read.file(kSceneFile, loadParallelSceneFile, scene, "must be the path of a scene; launch files take it as scene:=FILE");
    Motion::forEachParameter(motion, read);
    warnOfUnknown(read.unknown(), "parallel_rig");
    faults.checkAll(motion);
    faults.throwIfAny();
    return scene;
  }

  void onTimer(const ros::TimerEvent&) {
    const ros::Time now = ros::Time::now();
    if (start_.isZero() || now < start_) start_ = now;
    const ParallelSolution solution =
        model_.solveForLengths(motion_.at((now - start_).toSec()), Wrench::Zero(), workspace_);
    if (!solution.status.ok()) {
      ROS_ERROR_THROTTLE(1.0, "%s", model_.describe(solution.status).c_str());
      return;
    }
    RodLengths message;
    message.header.stamp = now;
    message.length = workspace_.lengths();
    lengths_.publish(message);
  }

  Motion motion_;
  ParallelModel model_;
  ParallelWorkspace workspace_;
  ros::Time start_;
  ros::Publisher lengths_;
  ros::Timer timer_;
};

}  // namespace

int main(int argc, char** argv) { return runNode<ParallelRig>(argc, argv, "parallel_rig"); }
