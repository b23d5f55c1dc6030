// The tip wrench that stiffness_node estimates while the simulated rig is pushed, against the rig's own. See contact.test.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>

#include "programs/contact_score.h"
#include "ros/conversions.h"
#include "support/contact_message.h"
#include "support/ros_wait.h"

namespace live_stiffness {
namespace {

TEST(Contact, ForceOfTwoPushesIsEstimatedAndReportedDuringThemAlone) {
  ros::NodeHandle node;
  std::map<ros::Time, Vector3> truth;
  std::vector<TipContact::ConstPtr> contacts;
  std::map<ros::Time, geometry_msgs::WrenchStamped> wrenches;
  std::vector<std::string> said;  // diagnostics while in contact
  bool drawn = false, drawn_without = false, in_contact = false;
  int ended = 0;  // pushes
  double last_truth = 0.0;
  ros::Time newest;
  const auto subscribers = {
      node.subscribe<geometry_msgs::WrenchStamped>("/rig_simulator/true_tip_wrench", 1000,
                                                   [&](const geometry_msgs::WrenchStamped::ConstPtr& m) {
                                                     const Vector3 force = vectorFrom(m->wrench.force);
                                                     truth[m->header.stamp] = force;
                                                     if (force.norm() == 0.0 && last_truth > 0.0) ++ended;
                                                     last_truth = force.norm();
                                                     newest = m->header.stamp;
                                                   }),
      node.subscribe<TipContact>("/stiffness_node/tip_contact", 1000,
                                 [&](const TipContact::ConstPtr& m) {
                                   contacts.push_back(m);
                                   in_contact = m->contact;
                                 }),
      node.subscribe<geometry_msgs::WrenchStamped>(
          "/stiffness_node/tip_wrench_estimate", 1000,
          [&](const geometry_msgs::WrenchStamped::ConstPtr& m) { wrenches[m->header.stamp] = *m; }),
      node.subscribe<diagnostic_msgs::DiagnosticArray>("/diagnostics", 100,
                                                       [&](const diagnostic_msgs::DiagnosticArray::ConstPtr& m) {
                                                         for (const auto& status : m->status)
                                                           if (in_contact && status.name == "stiffness_node: Contact")
                                                             said.push_back(status.message);
                                                       }),
      node.subscribe<visualization_msgs::MarkerArray>(
          "/stiffness_node/markers", 100, [&](const visualization_msgs::MarkerArray::ConstPtr& m) {
            for (const auto& marker : m->markers) {
              if (marker.ns != "contact" || marker.type != visualization_msgs::Marker::ARROW) continue;
              (marker.action == visualization_msgs::Marker::ADD ? drawn : drawn_without) = true;
            }
          })};
  ros::Time second_end;
  ASSERT_TRUE(waitFor(
      [&] {
        if (ended >= 2 && second_end.isZero()) second_end = newest;
        return !second_end.isZero() && newest > second_end + ros::Duration(3.0);
      },
      60.0))
      << ended << " pushes from " << subscribers.size() << " topics";

  std::vector<ContactSample> samples;
  for (const auto& contact : contacts) {
    ASSERT_TRUE(isFinite(*contact));
    EXPECT_EQ(contact->header.frame_id, "base");
    const auto known = truth.find(contact->header.stamp);
    if (known == truth.end()) continue;  // before this test had subscribed to the truth
    samples.push_back({contact->header.stamp.toSec(), known->second, vectorFrom(contact->wrench.force),
                       translationalCompliance(*contact), contact->contact != 0});
    const auto wrench = wrenches.find(contact->header.stamp);
    if (wrench == wrenches.end()) continue;
    EXPECT_EQ(vectorFrom(wrench->second.wrench.force), samples.back().estimate) << "nothing is known beside it";
    EXPECT_EQ(wrench->second.header.frame_id, "base");
  }
  ASSERT_GT(samples.size(), 400u);
  const ContactScore score = contactScore(samples);
  std::printf("%s\n", score.text().c_str());
  EXPECT_EQ(score.pushes, 2);
  // Over the compliance of some 0.02 m/N: creep and regulator error, 5 % of 60 kPa and 1 kPa, move the tip by about 1 mm,
  // 0.05 N, more while pressures are high; and a node that starts late has seen less of the robot before the first push.
  EXPECT_LT(score.rms, 0.1);
  EXPECT_NEAR(score.peak, score.peak_truth, 0.15);
  EXPECT_GT(score.seen, 0.98);
  EXPECT_LT(score.longest_false, 1.0);
  EXPECT_TRUE(drawn && drawn_without) << "the arrow must come with contact and go";
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const std::string& text) {
    return text.find("contact, 0.") == 0;
  })) << "diagnostics must tell of the contact";
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "contact_test");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
