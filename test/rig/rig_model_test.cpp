#include "rig/rig_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "live_stiffness/checks.h"
#include "live_stiffness/rod/scene_file.h"

namespace live_stiffness {
namespace {

Scene scene() { return loadSceneFile(SOURCE_DIR "/config/scenes/stiff_flop_recorded.yaml"); }

RigOptions rigOptions() {
  RigOptions options;
  options.drop_out_probability = 0.0;
  options.channel_of_chamber = {0, 0, 1, 1, 2, 2};
  options.program = {"triangle", 80000.0, 10.0};
  options.registration.X_AB = {expSo3(Vector3(0.4, -0.2, 2.0)), Vector3(0.1, 0.2, -0.3)};
  options.registration.X_TS = {expSo3(Vector3(0.1, 0.3, -1.0)), Vector3(0.01, 0.0, 0.003)};
  return options;
}

RigOptions ideal() {
  RigOptions o = rigOptions();
  o.regulator_time_constant = o.regulator_error = o.creep_fraction = o.position_noise = o.rotation_noise = 0.0;
  return o;
}

std::vector<RigSample> run(RigModel rig, double end, double step) {
  std::vector<RigSample> samples;
  for (int k = 0; k * step <= end + 1e-9; ++k) samples.push_back(rig.step(k * step));
  return samples;
}

TEST(RigModel, EqualSeedsGiveEqualSamples) {
  RigOptions o = rigOptions();
  o.program.kind = "random_walk";
  o.drop_out_probability = 0.05;
  const auto a = run(RigModel(scene(), o), 10.0, 0.05), b = run(RigModel(scene(), o), 10.0, 0.05);
  o.seed = 2;
  const auto other = run(RigModel(scene(), o), 10.0, 0.05);
  for (size_t k = 0; k < a.size(); ++k) {
    ASSERT_EQ(a[k].X_AS.has_value(), b[k].X_AS.has_value());
    if (a[k].X_AS) {
      ASSERT_EQ(a[k].X_AS->p, b[k].X_AS->p);
      ASSERT_EQ(a[k].X_AS->R, b[k].X_AS->R);
    }
    ASSERT_EQ(a[k].actual_chambers, b[k].actual_chambers);
  }
  EXPECT_GT((a.back().command - other.back().command).norm(), 1.0);
  EXPECT_GT((a.back().actual_chambers - other.back().actual_chambers).norm(), 1.0);
}

TEST(RigModel, IdealRigShowsTheFineRobotThroughTheTracker) {
  const RigOptions o = ideal();
  FineRobot robot(scene());
  for (const RigSample& sample : run(RigModel(scene(), o), 10.0, 0.5)) {
    ASSERT_EQ(sample.measured_channels, sample.command);
    ASSERT_EQ(sample.effective_chambers, sample.measured_chambers);
    const std::optional<Pose> X_BT = robot.solve(ChannelMap(o.channel_of_chamber).expand(sample.command));
    ASSERT_TRUE(X_BT && sample.X_AS);
    EXPECT_LT((sample.X_BT.p - X_BT->p).norm(), 1e-12);
    const Pose X_AS = o.registration.X_AB * *X_BT * o.registration.X_TS;
    EXPECT_LT((sample.X_AS->p - X_AS.p).norm(), 1e-12);
    EXPECT_LT((sample.X_AS->R - X_AS.R).norm(), 1e-11);
  }
}

TEST(RigModel, LateTrackerShowsWhereTheRobotWas) {
  RigOptions o = ideal();
  o.registration.tracker_delay = 0.25;
  const std::vector<RigSample> samples = run(RigModel(scene(), o), 10.0, 0.125);
  for (size_t k = 2; k < samples.size(); ++k) {
    const Pose then = o.registration.sensorPose(samples[k - 2].X_BT);
    EXPECT_LT((samples[k].X_AS->p - then.p).norm(), 1e-12);
    EXPECT_LT((samples[k].X_AS->R - then.R).norm(), 1e-11);
  }
}

TEST(RigModel, RegulatorErrorStaysWithinItsBoundAndUsesMostOfIt) {
  double worst = 0.0;
  for (const RigSample& sample : run(RigModel(scene(), rigOptions()), 120.0, 0.25)) {
    ASSERT_GE(sample.actual_chambers.minCoeff(), 0.0);
    worst = std::max(worst, (sample.actual_chambers - sample.measured_chambers).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(worst, 3000.0 * (1.0 + 1e-12));
  EXPECT_GT(worst, 1500.0);  // three sines of a third each are all beyond half of it somewhere in two periods
}

TEST(RigModel, RegulatorErrorIsSlow) {
  const auto samples = run(RigModel(scene(), rigOptions()), 30.0, 0.05);
  // Sum of the three sines' slopes: 3000 / 3 * 2 pi / 60 * (1 + 2 + 3) Pa/s.
  const double steepest = 3000.0 / 3.0 * 2.0 * kPi / 60.0 * 6.0;
  for (size_t k = 1; k < samples.size(); ++k) {
    if (samples[k].actual_chambers.minCoeff() == 0.0 || samples[k - 1].actual_chambers.minCoeff() == 0.0) continue;
    const Pressures error = samples[k].actual_chambers - samples[k].measured_chambers;
    const Pressures before = samples[k - 1].actual_chambers - samples[k - 1].measured_chambers;
    ASSERT_LE((error - before).cwiseAbs().maxCoeff(), steepest * 0.05 * 1.001) << samples[k].time;
  }
}

TEST(RigModel, RegulatorTrailsARampByItsTimeConstant) {
  RigOptions o = ideal();
  o.regulator_time_constant = 0.2;
  RigModel rig(scene(), o);
  rig.step(0.0);
  RigSample sample;
  for (int k = 1; k <= 30; ++k) sample = rig.step(0.1 * k);
  // 16 kPa/s for 3 s, 15 time constants: what is left of the start is 3e-7.
  EXPECT_NEAR(sample.command[0] - sample.measured_channels[0], 0.2 * 16000.0, 0.01);
}

TEST(RigModel, DoesNotDependOnTheStepWhereTheCommandIsLinear) {
  RigOptions o = rigOptions();
  o.regulator_error = 0.0;
  RigModel coarse(scene(), o), fine(scene(), o);
  const RigSample a = coarse.step(2.0);
  RigSample b;
  for (int k = 1; k <= 40; ++k) b = fine.step(0.05 * k);
  // The lag is exact for a linear input; the creep's input is the lagged one, which bends over 0.1 s at the start,
  // and that reaches the creeping 5 % only: 0.1 s * 16 kPa/s * 5 % at most.
  EXPECT_LT((a.measured_channels - b.measured_channels).norm(), 1e-6);
  EXPECT_LT((a.effective_chambers - b.effective_chambers).cwiseAbs().maxCoeff(), 80.0);
}

TEST(RigModel, CreepRelaxesToTheActualPressure) {
  RigOptions o = ideal();
  o.creep_fraction = 0.1;
  o.program = {"staircase", 60000.0, 20.0};  // first level, 20 kPa, from 4 s to 20 s
  const auto samples = run(RigModel(scene(), o), 19.9, 0.1);
  const auto missing = [&](double time) {
    const RigSample& sample = samples[std::lround(time / 0.1)];
    return (sample.actual_chambers - sample.effective_chambers)[0];
  };
  EXPECT_NEAR(missing(6.0), std::exp(-1.0) * missing(4.0), 1e-6);  // 2 s are its time constant
  EXPECT_GT(missing(4.0), 0.2 * 2000.0);  // of the 10 %: the blend takes 4 s, two time constants
  EXPECT_LT(missing(4.0), 2000.0);
  EXPECT_LT(missing(19.9), 2000.0 * std::exp(-7.9));
}

TEST(RigModel, TrackerNoiseHasTheSpecifiedRmsMagnitude) {
  RigOptions o = rigOptions();
  o.program.amplitude = 0.0;
  double p_squares = 0.0, R_squares = 0.0;
  const auto samples = run(RigModel(scene(), o), 100.0, 0.05);
  for (const RigSample& sample : samples) {
    const Pose X_AS = o.registration.sensorPose(sample.X_BT);
    p_squares += (sample.X_AS->p - X_AS.p).squaredNorm();
    R_squares += logSo3(X_AS.R.transpose() * sample.X_AS->R).squaredNorm();
  }
  // RMS of 3 * 2001 normal numbers: standard error 0.9 %; four times that.
  EXPECT_NEAR(std::sqrt(p_squares / samples.size()), 0.48e-3, 0.037 * 0.48e-3);
  EXPECT_NEAR(std::sqrt(R_squares / samples.size()), radians(0.30), 0.037 * radians(0.30));
}

TEST(RigModel, DropOutsLastTheirDuration) {
  RigOptions o = rigOptions();
  o.program.amplitude = 0.0;
  o.drop_out_probability = 0.02;
  o.drop_out_duration = 0.475;  // ten samples of 0.05 s: no rounding at the end
  const auto samples = run(RigModel(scene(), o), 100.0, 0.05);
  int length = 0, lost = 0;
  for (const RigSample& sample : samples) {
    if (!sample.X_AS) {
      ++length;
      ++lost;
      continue;
    }
    EXPECT_EQ(length % 10, 0) << sample.time;  // two may follow each other at once
    length = 0;
  }
  // Expected share 0.02 * 10 / (1 + 0.02 * 9) = 17 %; some 34 drop-outs of 2001 samples, so 17 % of it is one sigma.
  EXPECT_GT(lost, 100);
  EXPECT_LT(lost, 650);
}

TEST(RigModel, NoDropOutsUnlessAsked) {
  for (const RigSample& sample : run(RigModel(scene(), rigOptions()), 5.0, 0.05)) EXPECT_TRUE(sample.X_AS.has_value());
}

TEST(RigModel, ContactMovesTheTipAsTheSameDeadWrenchDoesAndOnlyWhileItLasts) {
  RigOptions o = ideal();
  const RigSample free = RigModel(scene(), o).step(7.0);
  o.contact.wrench << 0.2, -0.1, 0.05, 0.0, 1e-3, 0.0;
  o.contact.start = 5.0;
  o.contact.duration = 4.0;
  RigModel touched(scene(), o);
  EXPECT_EQ(touched.step(4.9).contact_wrench, Wrench::Zero());
  const RigSample pushed = touched.step(7.0), released = touched.step(9.5);
  EXPECT_EQ(pushed.contact_wrench, o.contact.wrench);
  EXPECT_LT((pushed.X_BT.R * linear(pushed.sensedContact()) - linear(o.contact.wrench)).norm(), 1e-15);
  EXPECT_GT((pushed.X_BT.p - free.X_BT.p).norm(), 1e-3);
  // The same equilibria, to the tolerance of Newton's method.
  const std::optional<Pose> dead = FineRobot(scene()).solve(pushed.effective_chambers, o.contact.wrench);
  ASSERT_TRUE(dead.has_value());
  EXPECT_LT((pushed.X_BT.p - dead->p).norm(), 1e-9);
  EXPECT_LT((released.X_BT.p - RigModel(scene(), ideal()).step(9.5).X_BT.p).norm(), 1e-9);
}

TEST(RigModel, RefusesBadOptionsAllAtOnce) {
  RigOptions o = rigOptions();
  o.program.amplitude = -1.0;
  o.program.period = 0.0;
  o.regulator_time_constant = -0.1;
  o.regulator_error = std::nan("");
  o.creep_fraction = 0.6;
  o.creep_time_constant = 0.0;
  o.position_noise = -1.0;
  o.rotation_noise = 1.0;
  o.drop_out_probability = 1.1;
  o.drop_out_duration = -1.0;
  o.registration.X_AB.R.setZero();
  o.registration.tracker_delay = -0.1;
  o.registration.X_TS.p.x() = std::nan("");
  o.contact.duration = 0.0;
  o.channel_of_chamber = {0, 2};  // wrong number
  try {
    RigModel(scene(), o);
    FAIL() << "accepted";
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.faults().size(), 16u) << error.what();
  }
}

TEST(RigModel, RefusesPressuresBeyondTheSectionsRange) {
  RigOptions o = rigOptions();
  o.program.amplitude = 3e5;
  EXPECT_THROW(RigModel(scene(), o), ConfigurationError);
}

TEST(RigModel, TimeMustNotGoBack) {
  RigModel rig(scene(), rigOptions());
  rig.step(1.0);
  EXPECT_THROW(rig.step(0.9), std::invalid_argument);
  EXPECT_THROW(rig.step(std::nan("")), std::invalid_argument);
  EXPECT_NO_THROW(rig.step(1.0));
}

}  // namespace
}  // namespace live_stiffness
