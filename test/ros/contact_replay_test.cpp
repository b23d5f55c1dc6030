// A recorded robot that is pushed through a force sensor, played through the node: estimated against measured force, and
// tip error, from the topics. Parameters: ~bag, ~registration.

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <rosgraph_msgs/Clock.h>

#include <map>

#include "live_stiffness/estimation/error_summary.h"
#include "programs/contact_score.h"
#include "estimation/interpolation.h"
#include "ros/conversions.h"
#include "support/contact_message.h"
#include "support/driven_node.h"

namespace live_stiffness {
namespace {

// The lateral force alone: the axial reading of these recordings does not act on the arm (docs/accuracy.md).
Vector3 lateral(const geometry_msgs::Vector3& f) { return {f.x, f.y, 0.0}; }

TEST(ContactReplay, ForceAndTipAreThoseMeasured) {
  std::vector<double> sensed_times;
  std::vector<Vector3> sensed;          // on the robot, axes of T, N
  std::map<ros::Time, Pose> poses;      // X_AS
  ros::Time end;
  rosbag::Bag bag(parameter("bag"));
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) {
    if (const auto message = instance.instantiate<geometry_msgs::WrenchStamped>()) {
      sensed_times.push_back(message->header.stamp.toSec());
      sensed.push_back(lateral(message->wrench.force));
    }
    if (const auto message = instance.instantiate<geometry_msgs::PoseStamped>())
      poses[message->header.stamp] = readPose(message->pose).value;
    end = std::max(end, instance.getTime());
  }
  ASSERT_GT(sensed.size(), 100u);
  const Registration registration = loadRegistrationFile(parameter("registration"));

  ros::NodeHandle node;
  std::vector<TipContact::ConstPtr> contacts;
  std::map<ros::Time, double> tracking_errors;
  const auto subscribers = {
      node.subscribe<TipContact>("/stiffness_node/tip_contact", 10000,
                                 [&](const TipContact::ConstPtr& m) { contacts.push_back(m); }),
      node.subscribe<TrackingError>("/stiffness_node/tracking_error", 10000, [&](const TrackingError::ConstPtr& m) {
        tracking_errors[m->header.stamp] = m->distance;
      })};
  ASSERT_TRUE(waitFor(
      [&] { return !contacts.empty() && contacts.back()->header.stamp >= poses.rbegin()->first - ros::Duration(0.2); },
      150.0))
      << contacts.size() << " estimates from " << subscribers.size() << " topics";

  std::vector<ContactSample> samples;
  std::vector<double> free_errors, corrected_errors;
  for (const auto& contact : contacts) {
    ASSERT_TRUE(isFinite(*contact));
    const ros::Time stamp = contact->header.stamp;
    ASSERT_EQ(poses.count(stamp), 1u) << "stamps are those of recorded poses";
    const Pose measured = registration.tipPose(poses.at(stamp));
    const double then = stamp.toSec() - registration.tracker_delay;
    const Vector3 force = measured.R * interpolated(sensed_times, sensed, then);
    samples.push_back({stamp.toSec(), force, vectorFrom(contact->wrench.force), translationalCompliance(*contact),
                       contact->contact != 0});
    corrected_errors.push_back((positionOf(contact->tip_pose) - measured.p).norm());
    if (force.norm() < ContactScore::kTouch && tracking_errors.count(stamp))
      free_errors.push_back(tracking_errors.at(stamp));
  }
  ASSERT_GT(samples.size(), 0.8 * poses.size());
  const ContactScore score = contactScore(samples);
  const ErrorSummary free = summarizeErrors(free_errors), corrected = summarizeErrors(corrected_errors);
  std::printf("%s\ntip, model alone, unloaded: %s\ntip, corrected: %s\n", score.text().c_str(),
              millimetreText(free).c_str(), millimetreText(corrected).c_str());
  EXPECT_GE(score.pushes, 4);
  // Along the stiff axis, nearly the tip's own, a push moves the tip by less than the model errs: that component is not
  // observable by the tracker, and the estimate's covariance says so. The target holds for the other two.
  EXPECT_LT(score.rms_compliant, 0.12);
  EXPECT_GT(score.seen, 0.9);
  EXPECT_LT(score.longest_false, 1.0);
  // Motion included. The sensor itself is 1 mm from the model's (RecordedMotion); at T, 15 mm from it, the orientation
  // counts too, some degrees off on this recording.
  EXPECT_LT(free.mean, 2.5e-3);
  EXPECT_LT(corrected.mean, 1e-3);  // half of the 2 mm that a sample may be off its own prediction
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "contact_replay_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
