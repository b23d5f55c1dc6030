// soak_rig HOURS NODE_PID: a rig and a clock as fast as stiffness_node answers, for scripts/soak. Prints lines of
// simulated hours, resident memory of the node in kB and estimates; progress on standard error.

#include <rosgraph_msgs/Clock.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "rig/rig_model.h"
#include "live_stiffness/rod/scene_file.h"
#include "programs/progress_bar.h"
#include "support/driven_node.h"

using namespace live_stiffness;

namespace {

constexpr double kRate = 40.0;       // Hz
constexpr double kRound = 60.0;      // s of the rig, played again and again
constexpr long kAhead = 6;           // samples under way; the node's queues hold ten
constexpr double kReport = 1.0 / 12;  // h

long residentKilobytes(const std::string& pid) {
  std::ifstream status("/proc/" + pid + "/status");
  for (std::string word; status >> word;)
    if (word == "VmRSS:") {
      long kilobytes = 0;
      status >> kilobytes;
      return kilobytes;
    }
  return -1;  // it is gone
}

std::vector<RigSample> oneRound() {
  RigOptions options;
  options.program.kind = "random_walk";
  options.drop_out_probability = 0.0;
  RigModel rig(loadSceneFile(parameter("scene_file")), options);
  std::vector<RigSample> samples;
  for (int i = 0; i < kRound * kRate; ++i) samples.push_back(rig.step(i / kRate));
  return samples;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "soak_rig");
  ros::NodeHandle node;
  const double hours = std::atof(argv[1]);
  const std::string pid = argv[2];
  const std::vector<RigSample> rig = oneRound();
  Watched watched("/stiffness_node");
  ros::Publisher clock = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
  ros::Publisher pressures = node.advertise<ChamberPressures>("chamber_pressures", 10);
  ros::Publisher poses = node.advertise<geometry_msgs::PoseStamped>("aurora_pose", 10);
  if (!waitFor([&] {
        return clock.getNumSubscribers() > 1 && pressures.getNumSubscribers() > 0 && poses.getNumSubscribers() > 0;
      })) {
    std::cerr << "soak_rig: stiffness_node does not subscribe\n";
    return 1;
  }
  const long total = static_cast<long>(hours * 3600.0 * kRate), report = static_cast<long>(kReport * 3600.0 * kRate);
  ProgressBar bar("soaking for " + numberText(hours) + " h of simulated time", total);
  const ros::Time begin(1000.0);
  long unanswered = 0;
  for (long i = 0; i < total && ros::ok(); ++i) {
    const ros::Time stamp = begin + ros::Duration(i / kRate);
    const RigSample& sample = rig[i % rig.size()];
    rosgraph_msgs::Clock now;
    now.clock = stamp;
    Pose X_AS = *sample.X_AS;
    X_AS.p.x() += 1e-9 * static_cast<double>(i % 1000);
    const auto publish = [&] {
      clock.publish(now);
      pressures.publish(toPressures(sample.measured_channels, stamp));
      poses.publish(toPoseStamped(X_AS, stamp, "aurora"));
    };
    // Again and again: samples may overtake the clock (roscpp subscribes to it without TCP_NODELAY), and are then taken
    // to be stamped by another.
    const ros::Time answered = stamp - ros::Duration(kAhead / kRate);
    const auto is_answered = [&] { return i < kAhead || (watched.error && watched.error->header.stamp >= answered); };
    if (!publishUntil(publish, is_answered, 2.0)) ++unanswered;
    if (i % report == 0 || i + 1 == total) {
      const long resident = residentKilobytes(pid);
      if (resident < 0) {
        std::cerr << "soak_rig: stiffness_node died\n";
        return 1;
      }
      std::cout << (i / kRate) / 3600.0 << ' ' << resident << ' ' << watched.estimates << std::endl;
    }
    bar.update(i + 1);
  }
  std::cerr << unanswered << " times the node did not answer within 2 s\n";
  return watched.always_finite && unanswered == 0 ? 0 : 1;
}
