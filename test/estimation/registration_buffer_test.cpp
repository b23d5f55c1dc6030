#include "estimation/registration_buffer.h"

#include <gtest/gtest.h>

#include "live_stiffness/rod/scene_file.h"
#include "support/simulated_recording.h"

namespace live_stiffness {
namespace {

Scene scene(double creep_share = 0.0) {
  Scene scene = loadSceneFile(SOURCE_DIR "/config/scenes/paper_one_segment.yaml");
  Material& material = std::get<Segment>(scene.chain.front()).section.material;
  material.creep_share = creep_share;
  material.creep_time = 2.0;
  return scene;
}

ModelOptions continuous() {
  ModelOptions options;
  options.stepping = Stepping::kContinuous;  // as the rig's fine model
  return options;
}

class RegistrationBufferTest : public ::testing::Test {
 protected:
  static SimulatedRecording exact(const std::string& program = "triangle") {
    SimulatedRecording simulated;
    simulated.position_noise = simulated.rotation_noise = 0.0;
    simulated.program = program;
    return simulated;
  }

  // Pressures and poses as recorded, at the same times.
  static void feed(RegistrationBuffer& buffer, const Recording& recording) {
    const ChannelMap map({0, 0, 1, 1, 2, 2});
    for (const RecordedSample& sample : recording.samples) {
      buffer.addPressures(map.expand(sample.pressures), sample.time);
      buffer.addPose(sample.tipPose(), Wrench::Zero(), false, sample.time);
    }
  }

  static double distance(const Registration& a, const Registration& b) {
    const auto apart = [](const Pose& X, const Pose& Y) {  // m and rad
      return (X.p - Y.p).norm() + logSo3(X.R.transpose() * Y.R).norm();
    };
    return apart(a.X_AB, b.X_AB) + apart(a.X_TS, b.X_TS);
  }

  StiffnessModel model_{scene(), continuous()};
  RegistrationBuffer buffer_{model_, 100.0, 0.5};
};

TEST_F(RegistrationBufferTest, RecoversTheRegistrationOfAMovingRobot) {
  const SimulatedRecording simulated = exact();
  feed(buffer_, simulated.record(scene()));
  const LiveRegistration result = buffer_.fit({});
  ASSERT_EQ(result.fault, "");
  EXPECT_TRUE(result.fit.determined());
  // Two models of the same physics agree to 1e-8; the offset is known some ten times worse than a tip position.
  EXPECT_LT(distance(result.fit.registration, simulated.registration()), 1e-6);
  EXPECT_EQ(result.used, 400);
  EXPECT_EQ(result.outliers, 0);
}

TEST_F(RegistrationBufferTest, PosesBetweenThePressuresAreMetByInterpolation) {
  // The triangle moves linearly: at its corners alone is interpolation wrong. Poses at every tenth, pressures at every
  // fifth of a second.
  const SimulatedRecording simulated = exact();
  const Recording recording = simulated.record(scene());
  const ChannelMap map({0, 0, 1, 1, 2, 2});
  for (size_t i = 0; i < recording.samples.size(); ++i) {
    const RecordedSample& sample = recording.samples[i];
    if (i % 2 == 0) buffer_.addPressures(map.expand(sample.pressures), sample.time);
    buffer_.addPose(sample.tipPose(), Wrench::Zero(), false, sample.time);
  }
  const LiveRegistration result = buffer_.fit({});
  ASSERT_EQ(result.fault, "");
  // Held instead, pressures would be off by 1.3 kPa at every other pose, which is 0.3 mm.
  EXPECT_LT(result.fit.position.mean, 0.02e-3);
}

TEST_F(RegistrationBufferTest, AppliesTheCreepOfTheScene) {
  SimulatedRecording simulated = exact("staircase");
  simulated.seconds = 90.0;
  simulated.creep_share = 0.1;
  const Recording recording = simulated.record(scene());
  const StiffnessModel creeping(scene(0.1), continuous());
  RegistrationBuffer with(creeping, 100.0, 0.5);
  feed(with, recording);
  feed(buffer_, recording);
  // The buffer's creep holds pressures between samples, the rig's is linear: 0.1 s of 2 s, of a tenth of the motion.
  EXPECT_LT(with.fit({}).fit.position.rms, 0.2 * buffer_.fit({}).fit.position.rms);
}

TEST_F(RegistrationBufferTest, AFewOutliersChangeNothing) {
  SimulatedRecording simulated = exact();
  simulated.position_noise = 0.2e-3;
  const Recording clean = simulated.record(scene());
  simulated.outlier_share = 0.03;
  const Recording spoilt = simulated.record(scene());
  RegistrationBuffer of_clean(model_, 100.0, 0.5);
  feed(of_clean, clean);
  feed(buffer_, spoilt);
  const LiveRegistration a = of_clean.fit({}), b = buffer_.fit({});
  EXPECT_GT(b.outliers, 4);
  EXPECT_LT(b.outliers, 24);
  // Other random numbers: as far apart as two fits of 0.2 mm noise are.
  EXPECT_LT(distance(a.fit.registration, b.fit.registration), 5e-3);
  EXPECT_LT(b.fit.position.max, 1.5e-3);
}

TEST_F(RegistrationBufferTest, UsesTheNewestPastAlone) {
  const SimulatedRecording simulated = exact();
  feed(buffer_, simulated.record(scene()));
  RegistrationWindow window;
  window.duration = 20.0;
  const LiveRegistration result = buffer_.fit(window);
  EXPECT_LE(result.span, 20.0);
  EXPECT_NEAR(result.used, 200, 1);
}

TEST_F(RegistrationBufferTest, ForgetsWhatIsOlderThanItsCapacity) {
  RegistrationBuffer small(model_, 10.0, 0.5);
  feed(small, exact().record(scene()));
  EXPECT_NEAR(small.fit({}).used, 100, 1);
}

TEST_F(RegistrationBufferTest, SaysWhenNothingIsQuasiStatic) {
  feed(buffer_, exact().record(scene()));  // a triangle never rests
  RegistrationWindow window;
  window.quasi_static_only = true;
  const LiveRegistration result = buffer_.fit(window);
  EXPECT_NE(result.fault.find("quasi-static"), std::string::npos) << result.fault;
}

TEST_F(RegistrationBufferTest, QuasiStaticSamplesOfAStaircaseAreUsedAlone) {
  SimulatedRecording simulated = exact("staircase");
  simulated.seconds = 90.0;
  feed(buffer_, simulated.record(scene()));
  RegistrationWindow window;
  window.duration = 90.0;
  const int all = buffer_.fit(window).used;
  window.quasi_static_only = true;
  const LiveRegistration result = buffer_.fit(window);
  ASSERT_EQ(result.fault, "");
  EXPECT_LT(result.used, 0.9 * all);
  EXPECT_LT(distance(result.fit.registration, simulated.registration()), 1e-5);
}

TEST_F(RegistrationBufferTest, SaysWhatIsMissing) {
  EXPECT_NE(buffer_.fit({}).fault.find("no pressures"), std::string::npos);
  buffer_.addPressures(Pressures::Zero(6), 1.0);
  EXPECT_NE(buffer_.fit({}).fault.find("no tracker poses"), std::string::npos);
  buffer_.addPose(Pose(), Wrench::Zero(), false, 3.0);
  EXPECT_NE(buffer_.fit({}).fault.find("share a clock"), std::string::npos);
  buffer_.addPressures(Pressures::Zero(6), 3.1);
  buffer_.addPose({Matrix3::Identity(), Vector3(1e-3, 0.0, 0.0)}, Wrench::Zero(), false, 3.2);
  const std::string fault = buffer_.fit({}).fault;
  EXPECT_NE(fault.find("1 usable samples"), std::string::npos) << fault;
  EXPECT_NE(fault.find("at least 20"), std::string::npos) << fault;
}

TEST_F(RegistrationBufferTest, LeavesOutContactWhenAsked) {
  const Recording recording = exact().record(scene());
  const ChannelMap map({0, 0, 1, 1, 2, 2});
  for (const RecordedSample& sample : recording.samples) {
    const bool in_contact = sample.time > 10.0;
    buffer_.addPressures(map.expand(sample.pressures), sample.time);
    buffer_.addPose(sample.tipPose(), Wrench::Zero(), in_contact, sample.time);
  }
  RegistrationWindow window;
  window.leave_out_contact = true;
  window.duration = 100.0;
  EXPECT_NEAR(buffer_.fit(window).used, 100, 1);
  window.duration = 20.0;
  EXPECT_NE(buffer_.fit(window).fault.find("in contact"), std::string::npos);
}

TEST_F(RegistrationBufferTest, ARobotThatDoesNotMoveDeterminesNothing) {
  SimulatedRecording simulated;
  simulated.amplitude = 0.0;
  feed(buffer_, simulated.record(scene()));
  const LiveRegistration result = buffer_.fit({});
  ASSERT_EQ(result.fault, "");
  EXPECT_FALSE(result.fit.determined());
  EXPECT_NE(result.text().find("NOT determined"), std::string::npos);
}

TEST_F(RegistrationBufferTest, OrientationsThatAreNotMeasuredAreFoundAndSaid) {
  const SimulatedRecording simulated = exact();
  Recording recording = simulated.record(scene());
  for (RecordedSample& sample : recording.samples) sample.tip_orientation.setIdentity();
  feed(buffer_, recording);
  RegistrationWindow window;
  const LiveRegistration found = buffer_.fit(window);
  ASSERT_EQ(found.fault, "");
  EXPECT_TRUE(found.fit.determined()) << found.text();
  EXPECT_EQ(found.fit.measures, TrackerMeasures::kPosition);
  EXPECT_NE(found.text().find("rotation is not measured"), std::string::npos) << found.text();
  EXPECT_LT((found.fit.registration.X_TS.p - simulated.registration().X_TS.p).norm(), 1e-5);
  window.measures = TrackerMeasures::kPose;
  EXPECT_NE(buffer_.fit(window).text().find("NOT determined: the orientation hardly changes"), std::string::npos);
}

TEST_F(RegistrationBufferTest, AnInvertedOrientationIsNamedAndNotDetermined) {
  Recording recording = exact().record(scene());
  for (RecordedSample& sample : recording.samples) sample.tip_orientation = sample.tip_orientation.conjugate();
  feed(buffer_, recording);
  const LiveRegistration result = buffer_.fit({});
  EXPECT_FALSE(result.fit.determined());
  EXPECT_NE(result.text().find("NOT determined: the orientations fit when inverted"), std::string::npos) << result.text();
}

TEST_F(RegistrationBufferTest, ATrackerThatRepeatsItselfCountsOnce) {
  for (int k = 0; k < 100; ++k) {
    buffer_.addPressures(Pressures::Zero(6), 0.1 * k);
    buffer_.addPose(Pose(), Wrench::Zero(), false, 0.1 * k);
  }
  EXPECT_EQ(buffer_.fit({}).poses, 1);
}

TEST_F(RegistrationBufferTest, ForgetsAllWhenTheClockIsSetBack) {
  const SimulatedRecording simulated = exact();
  const Recording recording = simulated.record(scene());
  feed(buffer_, recording);
  feed(buffer_, recording);
  EXPECT_EQ(buffer_.fit({}).used, 400);
}

}  // namespace
}  // namespace live_stiffness
