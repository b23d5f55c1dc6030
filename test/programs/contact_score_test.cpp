#include "programs/contact_score.h"

#include <gtest/gtest.h>

#include <cmath>

namespace live_stiffness {
namespace {

constexpr double kInterval = 0.05;  // s

// Stiff along z: 1 mm/N, and 50 mm/N across.
const Matrix3 kCompliance = Vector3(0.05, 0.05, 0.001).asDiagonal();

// Pushed by `truth` from 2 to 4 s and from 6 to 8 s of ten.
std::vector<ContactSample> pushedTwice(const Vector3& truth, const Vector3& error) {
  std::vector<ContactSample> samples;
  for (int k = 0; k < 200; ++k) {
    ContactSample sample;
    sample.time = k * kInterval;
    sample.contact = (sample.time >= 2.0 && sample.time < 4.0) || (sample.time >= 6.0 && sample.time < 8.0);
    if (sample.contact) sample.truth = truth, sample.estimate = truth + error;
    sample.compliance = kCompliance;
    samples.push_back(sample);
  }
  return samples;
}

TEST(ContactScore, CountsPushesAndWhatIsSeenOfThem) {
  const ContactScore score = contactScore(pushedTwice(Vector3(0.3, 0.0, 0.4), Vector3::Zero()));
  EXPECT_EQ(score.pushes, 2);
  EXPECT_EQ(score.during, 80);
  EXPECT_EQ(score.rms, 0.0);
  EXPECT_EQ(score.seen, 1.0);
  EXPECT_EQ(score.longest_false, 0.0);
  EXPECT_NEAR(score.peak_truth, 0.5, 1e-15);
  EXPECT_NEAR(score.peak_compliant_truth, 0.3, 1e-15);
}

TEST(ContactScore, ErrorAlongTheStiffAxisIsNoErrorOfTheCompliantComponents) {
  const ContactScore score = contactScore(pushedTwice(Vector3(0.3, 0.0, 0.4), Vector3(0.0, 0.03, -0.4)));
  EXPECT_NEAR(score.rms, std::hypot(0.03, 0.4), 1e-15);
  EXPECT_NEAR(score.rms_compliant, 0.03, 1e-15);
  EXPECT_NEAR(score.stiff_compliance, 0.001, 1e-15);
}

TEST(ContactScore, ErrorThatTheSensorDoesNotSeeIsNoneOfTheForce) {
  std::vector<ContactSample> samples = pushedTwice(Vector3(0.3, 0.0, 0.0), Vector3(0.0, 0.03, -0.4));
  for (ContactSample& sample : samples) sample.seen = Vector3(1.0, 1.0, 0.0).asDiagonal();
  EXPECT_NEAR(contactScore(samples).rms, 0.03, 1e-15);
}

TEST(ContactScore, PushThatIsNotReportedIsNotSeen) {
  std::vector<ContactSample> samples = pushedTwice(Vector3(0.3, 0.0, 0.0), Vector3::Zero());
  for (ContactSample& sample : samples)
    if (sample.time > 5.0) sample.contact = false;
  EXPECT_NEAR(contactScore(samples).seen, 0.5, 1e-15);
}

TEST(ContactScore, LongestFalseContactBeginsAfterAPushHasSettled) {
  std::vector<ContactSample> samples = pushedTwice(Vector3(0.3, 0.0, 0.0), Vector3::Zero());
  for (ContactSample& sample : samples)
    if (sample.time >= 4.0 && sample.time < 5.9) sample.contact = true, sample.estimate.x() = 0.2;
  // The last push sample is at 3.95 s, so that it counts from the first sample after 4.95 s to the last before 5.9 s.
  EXPECT_NEAR(contactScore(samples).longest_false, 0.85, kInterval + 1e-9);
}

TEST(ContactScore, SmallEstimatesAndReportsWithoutSamplesAreNoFalseContact) {
  std::vector<ContactSample> samples = pushedTwice(Vector3::Zero(), Vector3::Zero());
  for (ContactSample& sample : samples) sample.contact = true, sample.estimate.x() = 0.09;
  EXPECT_EQ(contactScore(samples).longest_false, 0.0);
  EXPECT_EQ(contactScore(samples).pushes, 0);
  EXPECT_EQ(contactScore({}).rms, 0.0);
}

TEST(ContactScore, DelayIsTheShiftAtWhichTheEstimateFollowsTheTruthBest) {
  for (double delay : {0.0, 0.12, -0.2}) {
    std::vector<ContactSample> samples = pushedTwice(Vector3::Zero(), Vector3::Zero());
    const auto push = [](double time) { return 0.4 * std::exp(-std::pow((time - 5.0) / 0.8, 2)); };
    for (ContactSample& sample : samples) {
      sample.truth = Vector3(push(sample.time), 0.0, 0.0);
      // Half the force, and along z what position does not show.
      sample.estimate = Vector3(0.5 * push(sample.time - delay), 0.0, push(sample.time - 0.5));
    }
    EXPECT_NEAR(contactScore(samples).delay, delay, 0.005 + 1e-9);  // half a step
    EXPECT_NEAR(contactScore(samples).correlation, 1.0, 1e-3);      // chords over 50 ms
  }
  EXPECT_EQ(contactScore(pushedTwice(Vector3::Zero(), Vector3::Zero())).correlation, 0.0);
}

TEST(ContactScore, TableHoldsWhatTheTextSays) {
  const ContactScore score = contactScore(pushedTwice(Vector3(0.3, 0.0, 0.4), Vector3(0.0, 0.03, -0.4)));
  EXPECT_NE(score.table().find("\npushes,2\n"), std::string::npos);
  EXPECT_NE(score.table().find("\nrms_compliant_n,0.03\n"), std::string::npos);
}

}  // namespace
}  // namespace live_stiffness
