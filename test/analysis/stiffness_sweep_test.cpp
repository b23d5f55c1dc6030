#include "analysis/stiffness_sweep.h"

#include <gtest/gtest.h>

#include "live_stiffness/analysis/eigenscrews.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

std::vector<SweepRow> rowsOf(const StiffnessModel& model, const PressurePlan& plan, const StiffnessCriterion& criterion,
                             ComplianceKind kind, int threads, long block) {
  std::vector<SweepRow> all;
  sweepStiffness(
      model, plan, criterion, kind,
      [&](long first, const std::vector<SweepRow>& rows) {
        EXPECT_EQ(first, static_cast<long>(all.size()));
        all.insert(all.end(), rows.begin(), rows.end());
      },
      threads, block);
  return all;
}

TEST(StiffnessSweep, IsTheSameBitForBitWhateverTheThreads) {
  const StiffnessModel model(paperScene(1), accurateTo(1e-6));
  const PressurePlan plan = PressurePlan::sample({{0.0, 4e5, 1}}, ChannelMap::even(3, 6), 200, 1);
  const std::vector<SweepRow> one = rowsOf(model, plan, {}, ComplianceKind::kTangent, 1, 10000),
                              many = rowsOf(model, plan, {}, ComplianceKind::kTangent, 4, 70);
  ASSERT_EQ(one.size(), 200u);
  ASSERT_EQ(many.size(), 200u);
  int failed = 0;
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].code, many[i].code);
    EXPECT_EQ(one[i].X_BT.p, many[i].X_BT.p);
    EXPECT_EQ(one[i].tau, many[i].tau);
    failed += one[i].code != SolveCode::kOk;
  }
  EXPECT_GT(failed, 0);  // all chambers at 4 bar are beyond the section's range, or topple
  EXPECT_LT(failed, 200);
}

TEST(StiffnessSweep, RowsAreThoseOfTheModel) {
  const StiffnessModel model(paperScene(1), accurateTo(1e-9));
  const PressurePlan plan = PressurePlan::grid({{0.0, 1e5, 3}}, ChannelMap::even(3, 6));
  StiffnessCriterion criterion;
  criterion.kind = CriterionKind::kDirectional;
  for (ComplianceKind kind : {ComplianceKind::kTangent, ComplianceKind::kMaterial}) {
    const std::vector<SweepRow> rows = rowsOf(model, plan, criterion, kind, 0, 16384);
    ASSERT_EQ(rows.size(), 27u);
    for (long row = 0; row < 27; ++row) {
      Pressures chambers(6);
      plan.chamberPressures(row, chambers);
      const StiffnessSolution s = solveCold(model, chambers);
      const Matrix6& C = kind == ComplianceKind::kTangent ? s.compliance : s.material_compliance;
      EXPECT_EQ(rows[row].X_BT.p, s.X_BT.p);
      EXPECT_NEAR(rows[row].tau * C(0, 0), 1.0, 1e-12);
      EXPECT_EQ(rows[row].eigenstiffnesses, eigenstiffnessesOfCompliance(C).values);
    }
  }
}

TEST(StiffnessSweep, RefusesChannelsThatDoNotFitTheScene) {
  const StiffnessModel model(paperScene(2), {});
  const PressurePlan plan = PressurePlan::grid({{0.0, 1e5, 3}}, ChannelMap::even(3, 6));
  EXPECT_THROW(rowsOf(model, plan, {}, ComplianceKind::kTangent, 0, 16384), ConfigurationError);
}

}  // namespace
}  // namespace live_stiffness
