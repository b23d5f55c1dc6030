#include "calibration/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "calibration/calibration_costs.h"
#include "calibration/calibration_report.h"
#include "calibration/scene_text.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/rod/scene_file.h"
#include "support/random_source.h"
#include "support/scenes.h"
#include "support/shared_data.h"
#include "support/simulated_recording.h"

namespace live_stiffness {
namespace {

std::vector<SceneParameter> parametersOf(const Scene& scene, const std::vector<std::string>& names) {
  std::vector<SceneParameter> parameters;
  for (const std::string& name : names) parameters.push_back(sceneParameter(name, scene, kPairs));
  return parameters;
}

// Every sample is an observation of its own: the noise here is white.
CalibrationOptions whiteNoise() {
  CalibrationOptions options;
  options.model.stepping = Stepping::kContinuous;
  options.correlation_time = 0.0;
  options.blocks = 0;
  return options;
}

CalibrationRecording use(Recording recording) {
  return {std::move(recording), SampleChoice::kAll, LoadedSamples::kIgnore};
}

// Truth: 20 % stiffer, 2 mm longer, a pitch radius 0.2 mm larger, and creep, recorded with a fine model of its own.
Scene truth() {
  Scene scene = arm();
  Segment& segment = segmentOf(scene, 0);
  segment.length += 0.002;
  segment.section.youngs_modulus *= 1.2;
  segment.section.shear_modulus *= 1.2;
  segment.section.chambers.pitch_radius += 2e-4;
  return scene;
}
const std::vector<std::string> kNames{"youngs_modulus_pa", "length_m", "chamber_pitch_radius_m", "creep_share",
                                      "creep_time_s"};

void expectRecovered(const CalibrationResult& result, double most_errors) {
  Scene known = truth();
  const Segment& segment = segmentOf(known, 0);
  const double expected[] = {segment.section.youngs_modulus, segment.length, segment.section.chambers.pitch_radius, 0.1,
                             2.0};
  for (size_t k = 0; k < result.parameters.size(); ++k) {
    const ParameterFit& fit = result.parameters[k];
    EXPECT_LT(std::abs(fit.value - expected[k]), most_errors * fit.standard_error) << fit.parameter.name;
    // A standard error that is as wide as the prior would make this an empty test.
    EXPECT_LT(fit.standard_error, 0.3 * fit.parameter.prior_sigma) << fit.parameter.name;
  }
}

SimulatedRecording creeping() {
  SimulatedRecording simulated;
  simulated.creep_share = 0.1;
  return simulated;
}

TEST(Calibration, RecoversParametersWithinTheirStandardErrors) {
  const CalibrationResult result =
      calibrate(arm(), kPairs, parametersOf(arm(), kNames), {use(creeping().record(truth()))}, {}, whiteNoise());
  EXPECT_TRUE(result.converged) << result.message;
  expectRecovered(result, 3.0);  // five parameters: beyond three standard errors once in 70 seeds; this seed is fixed
  EXPECT_NEAR(result.position_sigma, 0.3e-3, 0.05e-3);
  EXPECT_NEAR(result.rotation_sigma, 0.005, 0.001);
  const Registration expected = creeping().registration();
  EXPECT_LT((result.recordings[0].registration.X_TS.p - expected.X_TS.p).norm(), 1e-3);
  EXPECT_LT(logSo3(result.recordings[0].registration.X_AB.R.transpose() * expected.X_AB.R).norm(), radians(1.0));
  EXPECT_TRUE(result.recordings[0].determined) << result.recordings[0].verdict;
}

TEST(Calibration, OutliersDoNotMoveTheEstimates) {
  SimulatedRecording simulated = creeping();
  simulated.outlier_share = 0.05;
  const CalibrationResult result =
      calibrate(arm(), kPairs, parametersOf(arm(), kNames), {use(simulated.record(truth()))}, {}, whiteNoise());
  // One in twenty samples is 22 mm off, all to one side. Huber's loss bounds their pull, it does not remove it: within
  // five standard errors, where squares would be off by tens.
  expectRecovered(result, 5.0);
}

TEST(Calibration, NamesWhatTheDataCannotTellApart) {
  // All three azimuths together turn with the base: only their differences can be seen.
  const std::vector<std::string> names{"channel_azimuth_1_deg", "channel_azimuth_2_deg", "channel_azimuth_3_deg"};
  const CalibrationResult result =
      calibrate(arm(), kPairs, parametersOf(arm(), names), {use(SimulatedRecording().record(arm()))}, {}, whiteNoise());
  ASSERT_EQ(result.undetermined.size(), 1u);
  const Eigen::VectorXd& weights = result.undetermined[0].weights;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::abs(weights[k]), 1.0 / std::sqrt(3.0), 0.02);
  EXPECT_GT(weights[0] * weights[1], 0.0);
  EXPECT_GT(weights[1] * weights[2], 0.0);
  EXPECT_NE(reportText(result).find("less well than the priors do:\n  "), std::string::npos);
  // The differences are known far better than the angles.
  EXPECT_GT(result.parameters[0].standard_error, 0.3 * result.parameters[0].parameter.prior_sigma);
  EXPECT_GT(result.correlation(0, 1), 0.99);
}

TEST(Calibration, SaysThatARobotAtRestDoesNotDetermineTheRegistration) {
  SimulatedRecording rest;
  rest.amplitude = 0.0;
  const CalibrationResult result = calibrate(arm(), kPairs, {}, {use(rest.record(arm()))}, {}, whiteNoise());
  EXPECT_FALSE(result.recordings[0].determined);
  EXPECT_NE(result.recordings[0].verdict.find("NOT determined"), std::string::npos);
  EXPECT_LT(result.recordings[0].used.mean, 1e-3);  // it fits all the same
}

TEST(Calibration, LeftOutBlocksShowWhatAFreeFitHides) {
  CalibrationOptions options = whiteNoise();
  options.blocks = 4;
  const CalibrationResult result =
      calibrate(arm(), kPairs, parametersOf(arm(), kNames), {use(creeping().record(truth()))}, {}, options);
  const RecordingFit& fit = result.recordings[0];
  EXPECT_EQ(fit.left_out.count, fit.used.count);
  EXPECT_GT(fit.left_out.mean, fit.used.mean);           // it predicts what it has not seen
  EXPECT_LT(fit.left_out.mean, 1.5 * fit.used.mean);     // and the model is the true one
}

// Twelve hanging segments, 0.5 m: far longer than what can be shot from the base. Recorded without noise by the model.
TEST(Calibration, RecoversParametersOfALongArm) {
  constexpr int kSegments = 12;
  Scene scene = paperScene(1);
  scene.chain.assign(kSegments, scene.chain.front());
  scene.gravity = 9.81 * Vector3::UnitZ();
  Scene known = scene;
  for (int k = 0; k < kSegments; ++k) {
    Segment& segment = segmentOf(known, k);
    segment.length *= 1.01;
    segment.section.youngs_modulus *= 1.1;
    segment.section.shear_modulus *= 1.1;
  }
  const ChannelMap channels = ChannelMap::even(3 * kSegments, 6 * kSegments);
  const CalibrationOptions options = whiteNoise();
  const StiffnessModel model(known, options.model);
  StiffnessWorkspace workspace = model.makeWorkspace();
  RandomSource random(5);
  Recording recording;
  for (int i = 0; i < 40; ++i) {
    RecordedSample& sample = recording.samples.emplace_back();
    sample.time = i;
    sample.pressures = Pressures::NullaryExpr(3 * kSegments, [&] { return random.uniform(0.0, 0.6e5); });
    const StiffnessSolution solution = model.solve(channels.expand(sample.pressures), Wrench::Zero(), workspace);
    ASSERT_TRUE(solution.status.ok());
    sample.tip_position = solution.X_BT.p;
    sample.tip_orientation = Eigen::Quaterniond(solution.X_BT.R);
  }
  const std::vector<SceneParameter> parameters{sceneParameter("youngs_modulus_pa", scene, channels),
                                               sceneParameter("length_m", scene, channels)};
  CalibrationResult result = calibrate(scene, channels, parameters, {use(std::move(recording))}, {}, options);
  EXPECT_TRUE(result.converged) << result.message;
  const Segment &expected = segmentOf(known, 0), &found = segmentOf(result.scene, 0);
  // Without noise the priors still pull, by less than a thousandth of their sigmas.
  EXPECT_NEAR(found.section.youngs_modulus / expected.section.youngs_modulus, 1.0, 1e-3);
  EXPECT_NEAR(found.length / expected.length, 1.0, 1e-4);
  EXPECT_LT(result.recordings[0].used.max, 1e-4);
}

std::vector<ComplianceRow> tableOf(const Scene& scene) {
  const StiffnessModel model(scene, [] { ModelOptions o; o.stepping = Stepping::kContinuous; return o; }());
  std::vector<ComplianceRow> rows;
  for (const Pressures& pressures : {bars(0.6, {1, 1, 0, 0, 0, 0}), bars(1.2, {1, 1, 0, 0, 0, 0}),
                                     bars(0.9, {1, 1, 1, 1, 0, 0}), bars(0.9, {1, 1, 1, 1, 1, 1})}) {
    StiffnessWorkspace workspace = model.makeWorkspace();
    const StiffnessSolution solution = model.solve(pressures, Wrench::Zero(), workspace);
    rows.push_back({"row", pressures, solution.compliance.topLeftCorner<3, 3>()});
  }
  return rows;
}

TEST(Calibration, RecoversModuliFromATableOfCompliances) {
  Scene stiff = paperScene(1);
  segmentOf(stiff, 0).section.youngs_modulus *= 1.1;
  segmentOf(stiff, 0).section.shear_modulus *= 1.1;
  segmentOf(stiff, 0).section.chambers.pitch_radius *= 0.97;
  CalibrationOptions options = whiteNoise();
  options.compliance_sigma = 1e-3;  // the table is exact
  options.blocks = 1;
  const CalibrationResult result =
      calibrate(paperScene(1), ChannelMap::even(6, 6),
                parametersOf(paperScene(1), {"youngs_modulus_pa", "chamber_pitch_radius_m"}), {}, tableOf(stiff), options);
  EXPECT_NEAR(result.parameters[0].value / segmentOf(stiff, 0).section.youngs_modulus, 1.0, 1e-3);
  EXPECT_NEAR(result.parameters[1].value / segmentOf(stiff, 0).section.chambers.pitch_radius, 1.0, 1e-3);
  for (const ComplianceFit& row : result.rows) EXPECT_LT(row.left_out_matrix_error, 2e-3);
}

TEST(Calibration, RefusesWhatDoesNotFit) {
  EXPECT_THROW(sceneParameter("gent_limit", arm(), kPairs), ConfigurationError);
  EXPECT_THROW(sceneParameter("colour", arm(), kPairs), ConfigurationError);
  EXPECT_THROW(use(Recording{"short", std::nullopt, "", false, {RecordedSample()}, {}}), ConfigurationError);
  Scene without = arm();
  segmentOf(without, 0).section.youngs_modulus = 1e3;  // so soft that its own pressures burst it
  EXPECT_THROW(calibrate(without, kPairs, {}, {use(SimulatedRecording().record(arm()))}, {}, whiteNoise()),
               ConfigurationError);
}

// A scene whose modulus is far too small: the fit starts where the robot is carried, and ends at the truth.
TEST(Calibration, StartsFromModuliThatCarryTheRobot) {
  const Recording recording = SimulatedRecording().record(arm());
  Scene known = arm();
  const double modulus = segmentOf(known, 0).section.youngs_modulus;
  for (double factor : {0.3, 1e-3}) {
    const Scene soft = withModuliTimes(arm(), factor);
    const CalibrationResult result =
        calibrate(soft, kPairs, parametersOf(soft, {"youngs_modulus_pa", "length_m"}), {use(recording)}, {}, whiteNoise());
    EXPECT_NE(result.moduli.find("have no equilibrium"), std::string::npos) << result.moduli;
    EXPECT_TRUE(result.converged) << result.message;
    EXPECT_NEAR(result.parameters[0].value / modulus, 1.0, 0.03) << factor;
    EXPECT_EQ(result.recordings[0].without_equilibrium, 0);
    EXPECT_TRUE(result.recordings[0].determined) << result.recordings[0].verdict;
  }
  // Without the modulus among the parameters: the modulus is named, and nothing counts as determined.
  const Scene soft = withModuliTimes(arm(), 1e-3);
  try {
    calibrate(soft, kPairs, {}, {use(recording)}, {}, whiteNoise());
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("carry the robot (youngs_modulus_pa: "), std::string::npos) << error.what();
  }
}

// Spikes of a pressure sensor that no robot would stand.
TEST(Calibration, LeavesOutSamplesWithoutEquilibrium) {
  Recording recording = SimulatedRecording().record(arm());
  const CalibrationResult expected = calibrate(arm(), kPairs, {}, {use(recording)}, {}, whiteNoise());
  for (size_t i : {7u, 120u, 301u}) recording.samples[i].pressures.setConstant(3e6);
  recording.name = "arm, \"left\".csv";
  for (const auto& names : {std::vector<std::string>{}, {"youngs_modulus_pa"}}) {
    const CalibrationResult result =
        calibrate(arm(), kPairs, parametersOf(arm(), names), {use(recording)}, {}, whiteNoise());
    const RecordingFit& fit = result.recordings[0];
    EXPECT_EQ(fit.without_equilibrium, 3);
    EXPECT_TRUE(std::isnan(fit.position_error[7]));
    EXPECT_EQ(fit.used.count, expected.recordings[0].used.count - 3);
    EXPECT_NEAR(fit.used.mean, expected.recordings[0].used.mean, 2e-5);
    EXPECT_TRUE(fit.determined) << fit.verdict;
    EXPECT_NE(reportText(result).find("3 of 400 samples have no equilibrium and are left out"), std::string::npos)
        << reportText(result);
    EXPECT_NE(residualTable(result, {use(recording)}).find("\n\"arm, \"\"left\"\".csv\",0.7,1,,,,,,,3000000,"),
              std::string::npos);
  }
}

// The truth is softer, and only wider chambers farther out could make up for it: more than the tube has room for.
TEST(Calibration, StopsInsideWhatASceneMayBe) {
  const Scene scene = arm();
  SimulatedRecording simulated;
  simulated.amplitude = 10000.0;
  CalibrationOptions options = whiteNoise();
  options.use_priors = false;
  const CalibrationResult result =
      calibrate(scene, kPairs, parametersOf(scene, {"chamber_radius_m", "chamber_pitch_radius_m"}),
                {use(simulated.record(withModuliTimes(scene, 0.2)))}, {}, options);
  EXPECT_NO_THROW(parseScene(sceneText(result.scene), "found")) << sceneText(result.scene);
  Scene found = result.scene;
  EXPECT_EQ(result.parameters[1].value, segmentOf(found, 0).section.chambers.pitch_radius);
  EXPECT_TRUE(result.parameters[1].at_bound) << reportText(result);
}

TEST(Calibration, ATrackerThatMeasuresLessIsFittedByWhatItMeasures) {
  Recording recording = SimulatedRecording().record(arm());
  const Registration expected = SimulatedRecording().registration();
  RandomSource random(3);
  for (RecordedSample& sample : recording.samples)  // a coil whose turn about z is noise
    sample.tip_orientation = sample.tip_orientation * Eigen::AngleAxisd(random.uniform(-3.0, 3.0), Vector3::UnitZ());
  recording.measures = TrackerMeasures::kPositionAndAxis;
  CalibrationResult result = calibrate(arm(), kPairs, {}, {use(recording)}, {}, whiteNoise());
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.rotation_sigma, 0.005, 0.001);
  EXPECT_LT((result.recordings[0].registration.X_TS.p - expected.X_TS.p).norm(), 1e-3);
  EXPECT_LT((result.recordings[0].registration.X_TS.R.col(2) - expected.X_TS.R.col(2)).norm(), 0.02);

  for (RecordedSample& sample : recording.samples) sample.tip_orientation = Eigen::Quaterniond::Identity();
  recording.measures = TrackerMeasures::kPosition;
  result = calibrate(arm(), kPairs, {}, {use(recording)}, {}, whiteNoise());
  EXPECT_EQ(result.rotation_sigma, 0.0);
  EXPECT_LT((result.recordings[0].registration.X_TS.p - expected.X_TS.p).norm(), 2e-3);
  EXPECT_TRUE(std::isnan(result.recordings[0].rotation_error[0]));
}

TEST(Calibration, PosesThatOnlyRepeatAreNotFitted) {
  const Recording recording = SimulatedRecording().record(arm());
  const CalibrationResult expected = calibrate(arm(), kPairs, {}, {use(recording)}, {}, whiteNoise());
  Recording held = recording;
  for (size_t i = 100; i < 160; ++i) {  // 6 s without the sensor
    held.samples[i].tip_position = recording.samples[99].tip_position;
    held.samples[i].tip_orientation = recording.samples[99].tip_orientation;
    held.samples[i].unchanged_for = recording.samples[i].time - recording.samples[99].time;
  }
  const CalibrationResult result = calibrate(arm(), kPairs, {}, {use(held)}, {}, whiteNoise());
  EXPECT_EQ(result.recordings[0].used.count, expected.recordings[0].used.count - 60);
  EXPECT_NEAR(result.recordings[0].used.mean, expected.recordings[0].used.mean, 3e-5);
  EXPECT_EQ(result.recordings[0].position_error.size(), recording.samples.size());  // but predicted
  EXPECT_NE(reportText(result).find("60 of 400 samples repeat the pose before"), std::string::npos) << reportText(result);
}

// Two recordings of one set-up, of which one alone says little of the registration.
TEST(Calibration, RecordingsOfOneSetUpShareARegistration) {
  SimulatedRecording rest;
  rest.amplitude = 0.0;
  CalibrationOptions options = whiteNoise();
  options.shared_registration = true;
  const std::vector<CalibrationRecording> recordings{use(rest.record(arm())), use(SimulatedRecording().record(arm()))};
  const CalibrationResult result = calibrate(arm(), kPairs, {}, recordings, {}, options);
  for (const RecordingFit& fit : result.recordings) {
    EXPECT_TRUE(fit.determined) << fit.verdict;
    EXPECT_EQ(fit.registration.X_TS.p, result.recordings[1].registration.X_TS.p);
    EXPECT_LT((fit.registration.X_TS.p - rest.registration().X_TS.p).norm(), 1e-3);
  }
}

TEST(Calibration, AGivenRegistrationIsHeld) {
  CalibrationOptions options = whiteNoise();
  options.given = SimulatedRecording().registration();
  options.blocks = 2;
  const std::vector<CalibrationRecording> recordings{use(SimulatedRecording().record(truth()))};
  const std::vector<std::string> names{"youngs_modulus_pa", "length_m", "chamber_pitch_radius_m"};
  const CalibrationResult result = calibrate(arm(), kPairs, parametersOf(arm(), names), recordings, {}, options);
  EXPECT_EQ(result.recordings[0].registration.X_AB.p, options.given->X_AB.p);
  EXPECT_EQ(result.recordings[0].verdict, "given");
  Scene known = truth();
  EXPECT_NEAR(result.parameters[1].value, segmentOf(known, 0).length, 4.0 * result.parameters[1].standard_error);
  const CalibrationResult alone = calibrate(arm(), kPairs, {}, recordings, {}, options);  // nothing is left to fit
  EXPECT_TRUE(alone.converged) << alone.message;
}

// The robot is carried about: the tracker sees base and tip move together.
TEST(Calibration, ABaseSensorMakesUpForABaseThatMoves) {
  const Recording fixed = SimulatedRecording().record(arm());
  Recording moved = fixed;
  for (RecordedSample& sample : moved.samples) {
    const Pose X_AD{expSo3(Vector3(0.3 * std::sin(sample.time), 0.2, 0.1 * sample.time)), Vector3(0.01 * sample.time, 1.0, 0.0)};
    const Pose tip = X_AD * sample.tipPose();
    sample.base_position = X_AD.p;
    sample.base_orientation = Eigen::Quaterniond(X_AD.R);
    sample.tip_position = tip.p;
    sample.tip_orientation = Eigen::Quaterniond(tip.R);
  }
  const CalibrationResult expected = calibrate(arm(), kPairs, {}, {use(fixed)}, {}, whiteNoise());
  const CalibrationResult result = calibrate(arm(), kPairs, {}, {use(moved)}, {}, whiteNoise());
  EXPECT_NEAR(result.recordings[0].used.mean, expected.recordings[0].used.mean, 1e-7);
  EXPECT_LT((result.recordings[0].registration.X_AB.p - expected.recordings[0].registration.X_AB.p).norm(), 1e-6);
  EXPECT_TRUE(result.recordings[0].relative_to_base);
  EXPECT_NE(reportText(result).find("relative to its base sensor"), std::string::npos);
  moved.samples[5].base_orientation.reset();  // not of each sample: the tracker's frame, as it is
  EXPECT_FALSE(use(moved).relative_to_base);
}

// Of each kind of tracker, against differences of residuals by every unknown; axes 0.5 to 175 deg apart.
TEST(SampleCost, JacobianIsThatOfItsResiduals) {
  Recording recording;
  for (int i = 0; i < 5; ++i) {
    RecordedSample& sample = recording.samples.emplace_back();
    sample.time = i;
    sample.pressures = 2e4 * Pressures::LinSpaced(3, 0.0, i);
    sample.tip_position = Vector3(0.01, 0.02, 0.05);
    const double angles[] = {0.0, 0.01, 0.7, 2.0, 2.9};
    sample.tip_orientation = Eigen::AngleAxisd(angles[i], Vector3(1.0, 2.0, 0.5).normalized());
  }
  const Scene scene = arm();
  const std::vector<SceneParameter> parameters = parametersOf(scene, {"youngs_modulus_pa", "length_m"});
  for (TrackerMeasures measures : {TrackerMeasures::kPose, TrackerMeasures::kPosition, TrackerMeasures::kPositionAndAxis}) {
    recording.measures = measures;
    const CalibrationRecording data = use(recording);
    const CalibrationOptions options = whiteNoise();
    RecordingEvaluator evaluator(scene, kPairs, parameters, data, options);
    for (size_t i = 0; i < recording.samples.size(); ++i) {
      const SampleCost cost(evaluator, i, parameters, {1e-3, 0.01});
      const int rows = cost.num_residuals(), columns = 2 + kRegistrationSize;
      EXPECT_EQ(rows, measures == TrackerMeasures::kPose ? 6 : measures == TrackerMeasures::kPosition ? 3 : 5);
      Eigen::VectorXd unknowns = Eigen::VectorXd::LinSpaced(columns, -0.02, 0.03);
      const double* blocks[] = {unknowns.data(), unknowns.data() + 2};
      const auto residuals = [&] {
        Eigen::VectorXd result(rows);
        EXPECT_TRUE(cost.Evaluate(blocks, result.data(), nullptr));
        return result;
      };
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> x(rows, 2), r(rows, kRegistrationSize);
      double* jacobians[] = {x.data(), r.data()};
      Eigen::VectorXd at(rows);
      ASSERT_TRUE(cost.Evaluate(blocks, at.data(), jacobians));
      Eigen::MatrixXd J(rows, columns), expected(rows, columns);
      J << x, r;
      for (int k = 0; k < columns; ++k) {
        const double kept = unknowns[k], step = 1e-4;
        unknowns[k] = kept + step;
        const Eigen::VectorXd above = residuals();
        unknowns[k] = kept - step;
        expected.col(k) = (above - residuals()) / (2.0 * step);
        unknowns[k] = kept;
      }
      EXPECT_LT((J - expected).norm(), 1e-4 * expected.norm()) << trackerMeasuresName(measures) << ", sample " << i;
    }
  }
}

// The target of the real robot. The fit is on the same samples, so this only says that nothing is broken.
TEST(Calibration, NoLoadRecordingIsFittedToSixTenthsOfAMillimetre) {
  const auto path = sharedDataFile("stiff_flop_recordings/no_load.csv");
  if (!path) GTEST_SKIP() << "no shared data";
  CalibrationOptions options;
  options.model.stepping = Stepping::kContinuous;
  options.blocks = 0;
  const std::vector<std::string> names{"youngs_modulus_pa", "length_m", "chamber_pitch_radius_m", "channel_azimuth_2_deg",
                                       "channel_azimuth_3_deg", "creep_share", "creep_time_s"};
  const CalibrationResult result =
      calibrate(arm(), kPairs, parametersOf(arm(), names), {use(loadRecording(*path))}, {}, options);
  std::printf("%s", reportText(result).c_str());
  EXPECT_LT(result.recordings[0].used.mean, 0.6e-3);
  EXPECT_TRUE(result.recordings[0].determined);
}

}  // namespace
}  // namespace live_stiffness
