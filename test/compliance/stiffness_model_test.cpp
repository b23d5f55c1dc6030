#include "live_stiffness/compliance/stiffness_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "live_stiffness/checks.h"
#include "support/matrix_near.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

const Pressures kPressures = bars(0.9, {1, 1, 0.5, 0.5, 0, 0});
const Wrench kWrench = (Wrench() << 0.05, -0.02, 0.03, 1e-3, 2e-3, -1e-3).finished();

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The paper's four models: external_loads on or off, fixed steps or one linear step.
std::vector<ModelOptions> fourModels() {
  std::vector<ModelOptions> models;
  for (bool external_loads : {false, true})
    for (Stepping stepping : {Stepping::kLinear, Stepping::kFixedStep}) {
      ModelOptions options;
      options.external_loads = external_loads;
      options.stepping = stepping;
      models.push_back(options);
    }
  return models;
}

TEST(StiffnessModel, WithoutExternalLoadNeverTouchesTheBoundaryValueSolver) {
  Scene massless = paperScene(1);  // gravity on no mass is no load either
  massless.tip_mass = 0.0;
  segmentOf(massless, 0).section.density = 0.0;
  Scene no_gravity = paperScene(1);
  no_gravity.gravity = Vector3::Zero();
  for (const Scene& scene : {weightlessPaperScene(1), massless, no_gravity})
    for (const ModelOptions& options : fourModels()) {
      const StiffnessModel model(scene, options);
      StiffnessWorkspace workspace = model.makeWorkspace();
      const StiffnessSolution solution = model.solve(kPressures, Wrench::Zero(), workspace);
      ASSERT_TRUE(solution.status.ok());
      EXPECT_EQ(solution.iterations, 0);
      EXPECT_FALSE(workspace.loaded());
    }
}

TEST(StiffnessModel, PccModelsIgnoreWeightAndWrench) {
  for (ModelOptions options : fourModels()) {
    if (options.external_loads) continue;
    const StiffnessModel heavy(paperScene(1), options), weightless(weightlessPaperScene(1), options);
    StiffnessWorkspace workspace = heavy.makeWorkspace();
    const StiffnessSolution a = heavy.solve(kPressures, kWrench, workspace);
    const StiffnessSolution b = solveCold(weightless, kPressures);
    EXPECT_FALSE(workspace.loaded());
    EXPECT_TRUE(matrixNear(a.X_BT.p, b.X_BT.p, 0.0));
    EXPECT_TRUE(matrixNear(a.compliance, b.compliance, 0.0));
  }
}

TEST(StiffnessModel, CosseratModelsSolveTheBoundaryValueProblemOfWeightOrWrench) {
  for (const ModelOptions& options : fourModels()) {
    if (!options.external_loads) continue;
    const StiffnessModel heavy(paperScene(1), options), weightless(weightlessPaperScene(1), options);
    StiffnessWorkspace of_heavy = heavy.makeWorkspace(), of_weightless = weightless.makeWorkspace();
    EXPECT_GT(heavy.solve(kPressures, Wrench::Zero(), of_heavy).iterations, 0);
    EXPECT_GT(weightless.solve(kPressures, kWrench, of_weightless).iterations, 0);
    EXPECT_TRUE(of_heavy.loaded());
    EXPECT_TRUE(of_weightless.loaded());
  }
}

TEST(StiffnessModel, WithAVanishingWrenchIsTheClosedForm) {
  const StiffnessModel model(weightlessPaperScene(2), {});
  const Pressures pressures = Pressures::LinSpaced(12, 0.0, 1.0e5);
  const StiffnessSolution closed = solveCold(model, pressures);
  const StiffnessSolution loaded = solveCold(model, pressures, 1e-9 * kWrench);
  EXPECT_TRUE(matrixNear(loaded.X_BT.p, closed.X_BT.p, 1e-9));
  EXPECT_TRUE(matrixNear(loaded.compliance, closed.compliance, 1e-6 * closed.compliance.norm()));
}

TEST(StiffnessModel, RefusesBadPressuresWithTheValueAndTheLegalRange) {
  const StiffnessModel model(paperScene(1), {});
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (double bad : {-2e5, std::nan(""), kInfinity, -kInfinity}) {
    Pressures pressures = kPressures;
    pressures[3] = bad;
    const SolveStatus status = solveCold(model, pressures).status;
    EXPECT_EQ(status.code, SolveCode::kInvalidInput) << bad;
    EXPECT_EQ(status.index, 3);
    const std::string text = model.describe(status);
    EXPECT_TRUE(contains(text, "chamber 4") && contains(text, numberText(bad)) && contains(text, "-101325")) << text;
  }
}

TEST(StiffnessModel, RefusesAWrongNumberOfPressures) {
  const StiffnessModel model(paperScene(1), {});
  for (int count : {0, 3, 12}) {
    const SolveStatus status = solveCold(model, Pressures::Zero(count)).status;
    EXPECT_EQ(status.code, SolveCode::kInvalidInput) << count;
    const std::string text = model.describe(status);
    EXPECT_TRUE(contains(text, std::to_string(count) + " pressures") && contains(text, "6 chambers")) << text;
  }
}

TEST(StiffnessModel, RefusesAWrenchThatIsNotFinite) {
  const StiffnessModel model(paperScene(1), {});
  const SolveStatus status = solveCold(model, kPressures, Wrench::Constant(std::nan(""))).status;
  EXPECT_EQ(status.code, SolveCode::kInvalidInput);
  EXPECT_TRUE(contains(model.describe(status), "tip wrench must be finite"));
}

TEST(StiffnessModel, SolvesUnderVacuum) {
  for (int segments : {1, 2})
    for (Stepping stepping : kSteppings) {
      ModelOptions options;
      options.stepping = stepping;
      const StiffnessModel model(paperScene(segments), options);
      const StiffnessSolution solution = solveCold(model, Pressures::Constant(6 * segments, -0.9e5));
      ASSERT_TRUE(solution.status.ok()) << model.describe(solution.status);
      EXPECT_LT(solution.X_BT.p.z(), 0.95 * model.scene().length());
    }
}

TEST(StiffnessModel, BeyondTheRangeOfStretchSaysSoWithTheValueAndNeverNaN) {
  for (bool weight : {false, true})
    for (Stepping stepping : {Stepping::kFixedStep, Stepping::kContinuous})
      for (double bar : {2.5, 10.0, 1e3, 1e9, 1e300}) {
        ModelOptions options;
        options.stepping = stepping;
        const StiffnessModel model(weight ? paperScene(2) : weightlessPaperScene(2), options);
        Pressures pressures = Pressures::Zero(12);
        pressures.tail(6).setConstant(bar * 1e5);
        const StiffnessSolution solution = solveCold(model, pressures);
        EXPECT_EQ(solution.status.code, SolveCode::kOutOfRange) << bar;
        EXPECT_TRUE(std::isfinite(solution.status.value)) << bar;
        const std::string text = model.describe(solution.status);
        EXPECT_TRUE(contains(text, numberText(solution.status.value))) << text;
        if (bar < 100.0) {
          EXPECT_EQ(solution.status.index, 1);
          EXPECT_TRUE(contains(text, "segment 2")) << text;
        }
        EXPECT_TRUE(solution.compliance.allFinite() && solution.X_BT.p.allFinite());
      }
}

TEST(StiffnessModel, EverySuccessIsFiniteAllTheWayToTheLimitOfStretch) {
  for (Stepping stepping : {Stepping::kFixedStep, Stepping::kContinuous}) {
    ModelOptions options;
    options.stepping = stepping;
    const StiffnessModel model(weightlessPaperScene(1), options);
    int solved = 0, refused = 0;
    for (double bar = 0.0; bar < 3.0; bar += 0.003) {
      const StiffnessSolution solution = solveCold(model, Pressures::Constant(6, bar * 1e5));
      ++(solution.status.ok() ? solved : refused);
      if (solution.status.ok()) {
        EXPECT_TRUE(solution.compliance.allFinite()) << bar;
      }
    }
    EXPECT_GT(solved, 500);
    EXPECT_GT(refused, 200);
  }
}

TEST(StiffnessModel, RefusesBadOptionsAllAtOnce) {
  ModelOptions options;
  options.pressure_step = 0.0;
  options.accuracy = std::nan("");
  try {
    StiffnessModel model(Scene(), options);
    FAIL() << "constructed";
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.faults().size(), 3u);
    EXPECT_TRUE(contains(error.what(), "pressure_step_pa = 0: must be >= 100 and <= 1e+07")) << error.what();
    EXPECT_TRUE(contains(error.what(), "accuracy = nan")) << error.what();
    EXPECT_TRUE(contains(error.what(), "at least one segment")) << error.what();
  }
}

TEST(SolveCode, HasAName) {
  EXPECT_STREQ(codeName(SolveCode::kOk), "ok");
  EXPECT_STREQ(codeName(SolveCode::kInvalidInput), "invalid_input");
  EXPECT_STREQ(codeName(SolveCode::kOutOfRange), "out_of_range");
  EXPECT_STREQ(codeName(SolveCode::kNotConverged), "not_converged");
}

}  // namespace
}  // namespace live_stiffness
