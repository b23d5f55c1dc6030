#include "calibration/recording_evaluator.h"

#include <gtest/gtest.h>

#include <optional>

#include "support/scenes.h"

namespace live_stiffness {
namespace {

// A segment of every kind of softness, hanging or standing, bent out of plane, with a wrench at the tip.
Scene fullScene(StretchLaw law, int segments) {
  Scene scene = paperScene(segments);
  for (Body& body : scene.chain) {
    if (auto* segment = std::get_if<Segment>(&body)) {
      Material& material = segment->section.material;
      material.law = law;
      material.gent_limit = 20.0;
      material.yeoh_c2 = 0.1;
      material.yeoh_c3 = 0.02;
      material.pressure_stiffening = law == StretchLaw::kSectionUpdate ? 0.0 : 0.4;
      material.creep_share = 0.1;
      material.creep_time = 2.0;
      segment->section.chambers.area_growth = 5e-7;
    }
  }
  scene.gravity = Vector3(1.0, -2.0, 9.0);  // hanging, and leaning: nothing buckles
  scene.chain.emplace_back(Link{0.0145, 0.0135});
  scene.tip_offset = Vector3(0.001, 0.002, 0.003);
  return scene;
}

// Four samples, the third pushed.
CalibrationRecording recordingOf(int channels) {
  Recording recording;
  recording.name = "test";
  for (int i = 0; i < 4; ++i) {
    RecordedSample& sample = recording.samples.emplace_back();
    sample.time = 0.7 * i;
    sample.pressures = Pressures::Zero(channels);
    sample.pressures[i % channels] = 6e4;
    sample.pressures[(i + 1) % channels] = 2e4 * i;
    sample.tip_wrench = Wrench::Zero();
    if (i == 2) *sample.tip_wrench << 0.05, -0.03, 0.05, 1e-4, 2e-4, -1e-4;
  }
  return {std::move(recording), SampleChoice::kAll, LoadedSamples::kFit};
}

struct Problem {
  Scene scene;
  ChannelMap channels;
  std::vector<SceneParameter> parameters;
  CalibrationOptions options;
  CalibrationRecording data;

  Problem(const Scene& from, Stepping stepping, bool external_loads)
      : scene(from), channels(ChannelMap::even(from.chamberCount() / 2, from.chamberCount())),
        data(recordingOf(from.chamberCount() / 2)) {
    for (const std::string& name : sceneParameterNames(scene, channels))
      parameters.push_back(sceneParameter(name, scene, channels));
    for (const std::string& name : forceSensorParameterNames())
      parameters.push_back(*forceSensorParameter(name, options.force_sensor));
    options.model.stepping = stepping;
    options.model.external_loads = external_loads;
  }
};

// Twists of all samples by parameter k over +-reach steps, per unit, of solves at 1e-12.
std::vector<Vector6> differences(const Problem& problem, size_t k, double reach) {
  CalibrationOptions options = problem.options;
  options.model.accuracy = 1e-12;
  RecordingEvaluator evaluator(problem.scene, problem.channels, problem.parameters, problem.data, options);
  evaluator.orientTips(nullptr, Registration());
  const SceneParameter& p = problem.parameters[k];
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<long>(problem.parameters.size()));
  std::vector<Pose> above, below;
  x[static_cast<long>(k)] = reach * p.step / p.prior_sigma;
  const std::vector<bool> all(problem.data.used.size(), true);
  EXPECT_EQ(evaluator.predictAll(x.data(), above), all) << evaluator.failure();
  x *= -1.0;
  EXPECT_EQ(evaluator.predictAll(x.data(), below), all) << evaluator.failure();
  std::vector<Vector6> twists(above.size());
  for (size_t i = 0; i < above.size(); ++i) {
    twists[i] << above[i].p - below[i].p, logSo3(above[i].R * below[i].R.transpose());
    twists[i] /= 2.0 * reach * p.step;
  }
  return twists;
}

// Against differences over other steps, extrapolated to none. Of parameters that are not at a bound.
void expectDerivativesAgree(const Problem& problem) {
  RecordingEvaluator evaluator(problem.scene, problem.channels, problem.parameters, problem.data, problem.options);
  evaluator.orientTips(nullptr, Registration());
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<long>(problem.parameters.size()));
  const TipPredictions* predictions = evaluator.at(x.data(), true);
  ASSERT_NE(predictions, nullptr) << evaluator.failure();
  for (size_t k = 0; k < problem.parameters.size(); ++k) {
    const SceneParameter& p = problem.parameters[k];
    if (p.start - 8.0 * p.step < p.low || p.start + 8.0 * p.step > p.high) continue;  // see the test of bounds
    const std::vector<Vector6> near = differences(problem, k, 4.0), far = differences(problem, k, 8.0);
    for (size_t i = 0; i < near.size(); ++i) {
      const Vector6 expected = (4.0 * near[i] - far[i]) / 3.0, derivative = predictions->derivative[i].col(static_cast<long>(k));
      // 1e-8: of what a prior sigma moves, m and rad.
      EXPECT_LT((derivative - expected).norm(), 1e-4 * expected.norm() + 1e-8 / p.prior_sigma)
          << p.name << ", sample " << i << "\n" << derivative.transpose() << "\n" << expected.transpose();
    }
  }
}

TEST(RecordingEvaluator, DerivativesHaveConvergedForEveryLaw) {
  for (StretchLaw law : {StretchLaw::kSectionUpdate, StretchLaw::kNeoHookean, StretchLaw::kGent, StretchLaw::kYeoh}) {
    expectDerivativesAgree({fullScene(law, 1), Stepping::kContinuous, true});
    expectDerivativesAgree({fullScene(law, 1), Stepping::kFixedStep, true});
  }
}

TEST(RecordingEvaluator, DerivativesHaveConvergedForTwoSegments) {
  expectDerivativesAgree({fullScene(StretchLaw::kYeoh, 2), Stepping::kContinuous, true});
}

TEST(RecordingEvaluator, DerivativesHaveConvergedWithoutLoadsAndWithoutSteps) {
  expectDerivativesAgree({fullScene(StretchLaw::kNeoHookean, 1), Stepping::kContinuous, false});
  expectDerivativesAgree({fullScene(StretchLaw::kSectionUpdate, 1), Stepping::kLinear, true});
}

// The scene's creep share and pressure stiffening are zero, on their bounds; the pitch radius is moved to its own.
TEST(RecordingEvaluator, DerivativesAtABoundAreThoseOfTheLegalSide) {
  Problem problem(paperScene(1), Stepping::kContinuous, true);
  for (SceneParameter& p : problem.parameters)
    if (p.name == "chamber_pitch_radius_m") p.high = p.start;
  RecordingEvaluator evaluator(problem.scene, problem.channels, problem.parameters, problem.data, problem.options);
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<long>(problem.parameters.size()));
  const TipPredictions* predictions = evaluator.at(x.data(), true);
  ASSERT_NE(predictions, nullptr) << evaluator.failure();
  const std::vector<Pose> at = predictions->X_BT;
  const auto derivative = predictions->derivative;
  int tested = 0;
  for (size_t k = 0; k < problem.parameters.size(); ++k) {
    const SceneParameter& p = problem.parameters[k];
    if (p.name != "chamber_pitch_radius_m" && p.name != "creep_share") continue;
    ++tested;
    const double side = p.name == "chamber_pitch_radius_m" ? -1.0 : 1.0;
    Eigen::VectorXd moved = x;
    moved[static_cast<long>(k)] = 0.02 * side;
    std::vector<Pose> poses;
    evaluator.predictAll(moved.data(), poses);
    for (size_t i = 0; i < at.size(); ++i) {
      const Vector3 expected = (poses[i].p - at[i].p) / (0.02 * side * p.prior_sigma);
      const Vector3 found = derivative[i].col(static_cast<long>(k)).head<3>();
      EXPECT_LT((found - expected).norm(), 0.01 * expected.norm() + 1e-6) << p.name << ", sample " << i;
    }
  }
  EXPECT_EQ(tested, 2);
}

// A thousandth of a prior sigma softer, and the section has no solution under this pressure.
TEST(RecordingEvaluator, DerivativesWhereSolutionsEndAreThoseOfTheSideThatHasThem) {
  Problem problem(paperScene(1), Stepping::kContinuous, true);
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<long>(problem.parameters.size()));
  const auto predictionsAt = [&](double pressure, bool derivatives) -> std::optional<TipPredictions> {
    problem.data.channels[1].setConstant(pressure);
    RecordingEvaluator evaluator(problem.scene, problem.channels, problem.parameters, problem.data, problem.options);
    const TipPredictions* predictions = evaluator.at(x.data(), derivatives);
    return predictions ? std::optional<TipPredictions>(*predictions) : std::nullopt;
  };
  double low = 5e4, high = 5e5;  // Pa
  for (int i = 0; i < 40; ++i) {
    const double pressure = 0.5 * (low + high);
    (predictionsAt(pressure, false) ? low : high) = pressure;
  }
  const auto predictions = predictionsAt(low, true);
  ASSERT_TRUE(predictions);
  for (size_t k = 0; k < problem.parameters.size(); ++k) {
    if (problem.parameters[k].name != "youngs_modulus_pa") continue;
    const auto z = predictions->derivative[1](2, static_cast<long>(k));
    EXPECT_LT(z, 0.0) << "stiffer is shorter";
    EXPECT_TRUE(predictions->derivative[1].allFinite());
  }
}

TEST(RecordingEvaluator, NamesTheSampleThatHasNoSolution) {
  Problem problem(fullScene(StretchLaw::kSectionUpdate, 1), Stepping::kContinuous, true);
  problem.data.channels[1].setConstant(5e5);  // beyond the section's range
  RecordingEvaluator evaluator(problem.scene, problem.channels, problem.parameters, problem.data, problem.options);
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<long>(problem.parameters.size()));
  EXPECT_EQ(evaluator.at(x.data(), false), nullptr);
  EXPECT_NE(evaluator.failure().find("0.7 s"), std::string::npos) << evaluator.failure();
  // Chosen, the others are predicted.
  evaluator.chooseFitted(x.data());
  EXPECT_EQ(evaluator.fittedCount(), 3);
  EXPECT_FALSE(evaluator.fits(1));
  EXPECT_NE(evaluator.at(x.data(), true), nullptr);
  std::vector<Pose> poses;
  EXPECT_EQ(evaluator.predictAll(x.data(), poses), (std::vector<bool>{true, false, true, true}));
}

// A log twice as fast as the tracker, which then loses its sensor for 6 s: the rate is that of the poses that are new.
TEST(RecordingEvaluator, CorrelationIsThatOfPosesThatAreNew) {
  Problem problem(paperScene(1), Stepping::kContinuous, true);
  const auto correlationOf = [&](int count, double sample_time) {
    std::vector<RecordedSample>& samples = problem.data.recording.samples;
    samples.assign(static_cast<size_t>(count), samples.front());
    for (int i = 0; i < count; ++i) samples[static_cast<size_t>(i)].time = sample_time * i;
    return [&] {
      return RecordingEvaluator(problem.scene, problem.channels, problem.parameters, problem.data, problem.options).correlation();
    };
  };
  const auto correlation = correlationOf(41, 0.025);
  EXPECT_NEAR(correlation(), 40.0, 1e-9);
  std::vector<RecordedSample>& samples = problem.data.recording.samples;
  for (size_t i = 1; i < samples.size(); i += 2) samples[i].unchanged_for = 0.025;
  EXPECT_NEAR(correlation(), 20.0, 1e-9);
  samples.push_back(samples.back());
  samples.back().time += 6.0;
  samples.back().unchanged_for = 6.0;
  samples.push_back(samples.front());
  samples.back().time = samples[samples.size() - 2].time + 0.05;
  EXPECT_NEAR(correlation(), 21.0 / (20 * 0.05 + 1.0), 1e-9);
}

}  // namespace
}  // namespace live_stiffness
