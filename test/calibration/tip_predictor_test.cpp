#include "calibration/tip_predictor.h"

#include <gtest/gtest.h>

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

std::vector<ActuationSample> samples(int channels) {
  Wrench wrench;
  wrench << 0.05, -0.03, 0.02, 1e-4, 2e-4, -1e-4;
  std::vector<ActuationSample> result;
  for (int i = 0; i < 4; ++i) {
    ActuationSample sample;
    sample.time = 0.7 * i;
    sample.channels = Pressures::Zero(channels);
    sample.channels[i % channels] = 6e4;
    sample.channels[(i + 1) % channels] = 2e4 * i;
    if (i == 2) sample.tip_wrench = wrench;
    result.push_back(sample);
  }
  return result;
}

// Against central differences of the solver itself, at 1e-12, by a thousandth of what is known beforehand.
void expectDerivativesAgree(const Scene& scene, Stepping stepping, bool external_loads) {
  ModelOptions options;
  options.accuracy = 1e-12;
  options.stepping = stepping;
  options.external_loads = external_loads;
  const ChannelMap channels = ChannelMap::even(scene.chamberCount() / 2, scene.chamberCount());
  std::vector<SceneParameter> parameters;
  for (const std::string& name : sceneParameterNames(scene, channels))
    parameters.push_back(sceneParameter(name, scene, channels));
  Eigen::VectorXd values(static_cast<long>(parameters.size()));
  for (size_t k = 0; k < parameters.size(); ++k) values[static_cast<long>(k)] = parameters[k].start;
  TipPredictor predictor(scene, options, channels, parameters);
  const std::vector<ActuationSample> at = samples(channels.channelCount());
  std::vector<TipPrediction> predictions, above, below;
  ASSERT_TRUE(predictor.predict(values, at, true, predictions)) << predictor.failure();
  for (size_t k = 0; k < parameters.size(); ++k) {
    const double step = 1e-3 * parameters[k].prior_sigma;
    Eigen::VectorXd moved = values;
    moved[static_cast<long>(k)] += step;
    ASSERT_TRUE(predictor.predict(moved, at, false, above)) << predictor.failure();
    moved[static_cast<long>(k)] -= 2.0 * step;
    ASSERT_TRUE(predictor.predict(moved, at, false, below)) << predictor.failure();
    for (size_t i = 0; i < at.size(); ++i) {
      Vector6 difference;
      difference << above[i].X_BT.p - below[i].X_BT.p, logSo3(above[i].X_BT.R * below[i].X_BT.R.transpose());
      const Vector6 derivative = predictions[i].derivative.col(static_cast<long>(k)) * (2.0 * step);
      // 1e-3: the linearised rod's own error (five Runge-Kutta steps a segment), enough for a least-squares step; 1e-9:
      // rounding of the difference, m and rad.
      EXPECT_LT((derivative - difference).norm(), 1e-3 * difference.norm() + 1e-9)
          << parameters[k].name << ", sample " << i << "\n" << derivative.transpose() << "\n" << difference.transpose();
    }
  }
}

TEST(TipPredictor, DerivativesEqualDifferencesOfTheSolverForEveryLaw) {
  for (StretchLaw law : {StretchLaw::kSectionUpdate, StretchLaw::kNeoHookean, StretchLaw::kGent, StretchLaw::kYeoh}) {
    expectDerivativesAgree(fullScene(law, 1), Stepping::kContinuous, true);
    expectDerivativesAgree(fullScene(law, 1), Stepping::kFixedStep, true);
  }
}

TEST(TipPredictor, DerivativesEqualDifferencesOfTwoSegments) {
  expectDerivativesAgree(fullScene(StretchLaw::kYeoh, 2), Stepping::kContinuous, true);
}

TEST(TipPredictor, DerivativesEqualDifferencesWithoutLoadsAndWithoutSteps) {
  expectDerivativesAgree(fullScene(StretchLaw::kNeoHookean, 1), Stepping::kContinuous, false);
  expectDerivativesAgree(fullScene(StretchLaw::kSectionUpdate, 1), Stepping::kLinear, true);
}

TEST(TipPredictor, NamesTheSampleThatHasNoSolution) {
  const Scene scene = fullScene(StretchLaw::kSectionUpdate, 1);
  const ChannelMap channels = ChannelMap::even(3, 6);
  TipPredictor predictor(scene, {}, channels, {});
  std::vector<ActuationSample> at = samples(3);
  at[1].channels.setConstant(5e5);  // beyond the section's range
  std::vector<TipPrediction> predictions;
  EXPECT_FALSE(predictor.predict({}, at, false, predictions));
  EXPECT_NE(predictor.failure().find("0.7 s"), std::string::npos) << predictor.failure();
}

}  // namespace
}  // namespace live_stiffness
