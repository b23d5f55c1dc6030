// Nothing external acts: everything has a closed form, and every route to compliance gives the same matrix.

#include <gtest/gtest.h>

#include "live_stiffness/compliance/stiffness_model.h"
#include "rod/statics.h"
#include "support/differences.h"
#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/random_source.h"
#include "support/scenes.h"
#include "support/series_exp.h"

namespace live_stiffness {
namespace {

struct Case {
  StiffnessModel model;
  Pressures pressures;
};

void forEachCase(double accuracy, const std::function<void(const Case&)>& check) {
  RandomSource random(51);
  for (int segments : {1, 2})
    for (Stepping stepping : kSteppings)
      for (double largest : {0.0, 1.0, 0.4e5, 1.2e5}) {
        SCOPED_TRACE(::testing::Message() << segments << " segments, " << steppingName(stepping) << ", " << largest << " Pa");
        ModelOptions options = accurateTo(accuracy);
        options.stepping = stepping;
        check({StiffnessModel(weightlessPaperScene(segments), options), random.pairs(6 * segments, 0.0, largest)});
      }
}

TEST(PressureOnly, TipIsTheProductOfExponentials) {
  forEachCase(1e-9, [](const Case& c) {
    StiffnessWorkspace workspace = c.model.makeWorkspace();
    const StiffnessSolution solution = c.model.solve(c.pressures, Wrench::Zero(), workspace);
    ASSERT_TRUE(solution.status.ok());
    Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
    walk(
        c.model.scene(),
        [&](int index, const Segment& segment) {
          const RestState& rest = workspace.backbone().rest[index];
          Eigen::Matrix4d xi = Eigen::Matrix4d::Zero();
          xi.topLeftCorner<3, 3>() = hat(rest.curvature);
          xi(2, 3) = 1.0;
          X *= seriesExp<4>(rest.stretch * segment.length * xi);
        },
        [&](const Link& link) {
          Eigen::Matrix4d along = Eigen::Matrix4d::Identity();
          along(2, 3) = link.length;
          X *= along;
        });
    EXPECT_TRUE(matrixNear(solution.X_BT.p, X.topRightCorner<3, 1>(), 1e-12 * 0.04));
    EXPECT_TRUE(matrixNear(solution.X_BT.R, X.topLeftCorner<3, 3>(), 1e-12));
  });
}

// The same shape handed to the boundary value solver, with loads of zero.
TEST(PressureOnly, TangentOfTheBoundaryValueSolverEqualsMaterial) {
  double worst = 0.0;
  forEachCase(1e-12, [&](const Case& c) {
    StiffnessWorkspace workspace = c.model.makeWorkspace();
    const StiffnessSolution solution = c.model.solve(c.pressures, Wrench::Zero(), workspace);
    ASSERT_TRUE(solution.status.ok());
    Backbone backbone(c.model.scene());
    backbone.rest = workspace.backbone().rest;
    StaticsSolver solver(c.model.scene(), 1e-12);
    ASSERT_TRUE(solver.solve(DeadLoads(), backbone).converged);
    const double length = c.model.scene().length();
    const double error = complianceError(solver.tangentCompliance(), solution.material_compliance, length);
    worst = std::max(worst, error);
    EXPECT_LT(error, 1e-9);
    EXPECT_LT(poseError(backbone.X_BT, solution.X_BT, length), 1e-12);
    // The model takes the closed form, where the two are one matrix.
    EXPECT_TRUE(matrixNear(solution.compliance, solution.material_compliance, 0.0));
  });
  std::cout << "tangent against material, worst: " << worst << "\n";
}

TEST(PressureOnly, ComplianceEqualsDifferencesOfTheResolvedTip) {
  double worst = 0.0;
  forEachCase(1e-13, [&](const Case& c) {
    const StiffnessSolution solution = solveCold(c.model, c.pressures);
    const auto tip = [&](const Wrench& wrench) { return solveCold(c.model, c.pressures, wrench).X_BT; };
    const double length = c.model.scene().length();
    const Matrix6 differences = complianceByDifferences(tip, Wrench::Zero(), solution.compliance, length);
    const double error = complianceError(solution.compliance, differences, length);
    worst = std::max(worst, error);
    EXPECT_LT(error, 1e-7);  // what five-point differences reach, see complianceByDifferences()
  });
  std::cout << "compliance against differences, worst: " << worst << "\n";
}

TEST(PressureOnly, ComplianceIsSymmetricAndPositive) {
  forEachCase(1e-9, [](const Case& c) {
    const Matrix6 C = scaledCompliance(solveCold(c.model, c.pressures).compliance, 0.04);
    EXPECT_TRUE(matrixNear(C, C.transpose(), 1e-15 * C.norm()));
    EXPECT_GT(C.ldlt().vectorD().minCoeff(), 0.0);
  });
}

// Per unit of length c = diag(c_se, c_bt), straight: the cantilever of every textbook.
TEST(PressureOnly, StraightSegmentIsTheTextbooksCantilever) {
  Scene scene = weightlessPaperScene(1);
  const ComplianceDensity c = SectionMoments(segmentOf(scene, 0).section).complianceDensity(1.0);
  const double L = 0.04;
  const Matrix6 C = solveCold(StiffnessModel(scene, {}), Pressures::Zero(6)).compliance;
  const double bend = c.bending_torsion(0, 0);
  Matrix6 expected = Matrix6::Zero();
  expected.diagonal() << L * L * L / 3.0 * bend + L * c.shear_elongation(0, 0),
      L * L * L / 3.0 * bend + L * c.shear_elongation(1, 1), L * c.shear_elongation(2, 2), L * bend, L * bend,
      L * c.bending_torsion(2, 2);
  expected(0, 4) = expected(4, 0) = L * L / 2.0 * bend;
  expected(1, 3) = expected(3, 1) = -L * L / 2.0 * bend;
  EXPECT_LT(complianceError(C, expected, L), 1e-14);
}

TEST(PressureOnly, RotatingTheChambersRotatesTheCompliance) {
  Scene turned = weightlessPaperScene(2);
  const Matrix3 R = expSo3(Vector3(0.0, 0.0, 0.7));
  for (int k : {0, 1})
    for (double& azimuth : segmentOf(turned, k).section.chambers.azimuths) azimuth += 0.7;
  RandomSource random(52);
  const Pressures pressures = random.pairs(12, 0.0, 1e5);
  const StiffnessSolution a = solveCold(StiffnessModel(weightlessPaperScene(2), {}), pressures);
  const StiffnessSolution b = solveCold(StiffnessModel(turned, {}), pressures);
  EXPECT_TRUE(matrixNear(b.X_BT.p, R * a.X_BT.p, 1e-15));
  EXPECT_LT(complianceError(complianceInBodyAxes(b.compliance, R), a.compliance, 0.08), 1e-13);
}

}  // namespace
}  // namespace live_stiffness
