#include "compliance/material_compliance.h"

#include <gtest/gtest.h>

#include "compliance/station_reader.h"
#include "live_stiffness/compliance/stiffness_model.h"
#include "rod/statics.h"
#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

struct Solved {
  StiffnessModel model;
  StiffnessWorkspace workspace;
  StiffnessSolution solution;

  Solved(const Scene& scene, double accuracy, const Pressures& pressures)
      : model(scene, accurateTo(accuracy)), workspace(model.makeWorkspace()),
        solution(model.solve(pressures, Wrench::Zero(), workspace)) {
    EXPECT_TRUE(solution.status.ok());
  }
  Station at(int segment, double fraction) const { return model.station(workspace, segment, fraction); }
};

const Pressures kTwelve = bars(0.8, {1, 1, 0.2, 0.2, 0, 0, 0.3, 0.3, 1, 1, 0, 0});

// (10) by Simpson's rule over 400 sections a segment, from nothing but their poses.
Matrix6 complianceBySimpson(const Solved& solved, int segment, double fraction) {
  const Vector3 p = solved.at(segment, fraction).X_BQ.p;
  Matrix6 C = Matrix6::Zero();
  for (int k = 0; k <= segment; ++k) {
    const RestState& rest = solved.workspace.backbone().rest[k];
    const double to = k == segment ? fraction : 1.0;
    const double length = to * solved.workspace.backbone().length(k);
    constexpr int kPanels = 400;
    for (int i = 0; i <= kPanels; ++i) {
      const double weight = length * (i == 0 || i == kPanels ? 1.0 : i % 2 ? 4.0 : 2.0) / (3.0 * kPanels);
      const Pose X = solved.at(k, to * i / kPanels).X_BQ;
      Matrix6 c = Matrix6::Zero();
      c.topLeftCorner<3, 3>() = rest.c.shear_elongation;
      c.bottomRightCorner<3, 3>() = rest.c.bending_torsion;
      C += weight * shiftCompliance(complianceInBodyAxes(c, X.R.transpose()), p - X.p);
    }
  }
  return C;
}

TEST(Station, ComplianceIsTheIntegralOfTheDensityUpToIt) {
  for (const Scene& scene : {paperScene(2), weightlessPaperScene(2)}) {
    const Solved solved(scene, 1e-9, kTwelve);
    for (int segment : {0, 1})
      for (double fraction : {0.1, 0.37, 0.5, 1.0}) {
        // Simpson with 400 panels: 1e-11; the model's accuracy of 1e-9 is what counts.
        const Matrix6 expected = complianceBySimpson(solved, segment, fraction);
        EXPECT_LT(complianceError(solved.at(segment, fraction).compliance, expected, 0.08), 1e-8)
            << segment << " " << fraction;
      }
  }
}

TEST(Station, AtAnyFractionEqualsAFinerSolution) {
  for (const Scene& scene : {paperScene(2), weightlessPaperScene(2), awkwardScene()}) {
    const Solved coarse(scene, 1e-8, kTwelve), fine(scene, 1e-13, kTwelve);
    for (int segment : {0, 1})
      for (double fraction : {0.001, 0.1, 1.0 / 3.0, 0.5, 0.77, 0.999, 1.0}) {
        const Station a = coarse.at(segment, fraction), b = fine.at(segment, fraction);
        EXPECT_LT(complianceError(a.compliance, b.compliance, 0.08), 1e-7) << segment << " " << fraction;
        EXPECT_LT(poseError(a.X_BQ, b.X_BQ, 0.08), 1e-7) << segment << " " << fraction;
      }
  }
}

TEST(Station, AtTheEndOfTheLastSegmentIsTheTip) {
  for (const Scene& scene : {paperScene(2), weightlessPaperScene(2)}) {
    const Solved solved(scene, 1e-9, kTwelve);
    const Station end = solved.at(1, 1.0);
    EXPECT_LT(complianceError(end.compliance, solved.solution.material_compliance, 0.08), 1e-14);
    EXPECT_TRUE(matrixNear(end.X_BQ.p, solved.solution.X_BT.p, 1e-16));
    EXPECT_EQ(end.stretch, solved.workspace.backbone().rest[1].stretch);
  }
}

TEST(Station, AtTheBaseIsRigid) {
  const Station base = Solved(paperScene(2), 1e-9, kTwelve).at(0, 0.0);
  EXPECT_TRUE(matrixNear(base.compliance, Matrix6::Zero(), 0.0));
  EXPECT_TRUE(matrixNear(base.X_BQ.p, Vector3::Zero(), 0.0));
  EXPECT_TRUE(matrixNear(base.X_BQ.R, Matrix3::Identity(), 0.0));
}

TEST(Station, FractionsBeyondTheEndsAreTheEnds) {
  const Solved solved(paperScene(2), 1e-9, kTwelve);
  EXPECT_TRUE(matrixNear(solved.at(0, -0.5).X_BQ.p, solved.at(0, 0.0).X_BQ.p, 0.0));
  EXPECT_TRUE(matrixNear(solved.at(0, 1.5).X_BQ.p, solved.at(0, 1.0).X_BQ.p, 0.0));
}

TEST(MaterialCompliance, IsMovedByARigidOffsetAndByNothingElse) {
  Scene offset = weightlessPaperScene(1);
  const Pressures pressures = bars(0.9, {1, 1, 0.3, 0.3, 0, 0});
  const Solved without(offset, 1e-9, pressures);
  offset.tip_offset = Vector3(0.01, -0.02, 0.03);
  offset.chain.emplace_back(Link{0.005, 0.0});
  const Solved with(offset, 1e-9, pressures);
  const Vector3 lever = without.solution.X_BT.R * Vector3(0.01, -0.02, 0.035);
  const Matrix6 expected = shiftCompliance(without.solution.material_compliance, lever);
  EXPECT_LT(complianceError(with.solution.material_compliance, expected, 0.04), 1e-14);
}

// The section's law decides between closed form and quadrature; a hair of anisotropy forces the second at the same
// shape.
TEST(PlaceUnloaded, ArcsEqualQuadratureOfTheSameElements) {
  Scene scene = weightlessPaperScene(2);
  scene.tip_offset = Vector3(0.01, -0.02, 0.03);
  const StaticsSolver solver(scene, 1e-13);
  for (double bending : {0.0, 1e-160, 1e-12, 1e-4, 0.3, 1.5}) {
    Backbone arcs(scene), quadrature(scene);
    for (Backbone* backbone : {&arcs, &quadrature}) {
      for (int k = 0; k < 2; ++k) {
        RestState& rest = backbone->rest[k];
        rest.c = SectionMoments(segmentOf(scene, k).section).complianceDensity(1.2);
        rest.stretch = 1.2;
        rest.curvature = bending / (1.2 * segmentOf(scene, k).length) * Vector3(0.6, k == 0 ? 0.8 : -0.8, 0.0);
        if (backbone == &quadrature) rest.c.bending_torsion(1, 1) *= 1.0 + 4e-16;
      }
      StaticsSolver(scene, 1e-13).prepareUnloaded(*backbone);
    }
    Matrix6 by_arcs, by_quadrature;
    solveUnloaded(solver.chain(), 1e-13, arcs, by_arcs);
    solveUnloaded(solver.chain(), 1e-13, quadrature, by_quadrature);
    // Twelve nodes on 1.5 rad err by 2e-13 of their largest integrand (interpolationError in material_choice_code.h).
    EXPECT_LT(complianceError(by_arcs, by_quadrature, 0.08), 1e-12) << bending;
    EXPECT_LT(poseError(arcs.X_BT, quadrature.X_BT, 0.08), 1e-14) << bending;
    for (int segment : {0, 1})
      for (double fraction : {0.0, 0.2, 0.77, 1.0}) {
        const Station a = stationAt(arcs, segment, fraction, {1e-13, false}),
                      b = stationAt(quadrature, segment, fraction, {1e-13, false});
        EXPECT_TRUE(matrixNear(a.compliance, b.compliance, 1e-12 * by_arcs.norm())) << bending << " " << fraction;
        EXPECT_LT(poseError(a.X_BQ, b.X_BQ, 0.08), 1e-13) << bending << " " << fraction;
      }
  }
}

// An arc before an element of another kind: nothing of the loads may be left in it.
TEST(PlaceUnloaded, DoesNotRememberTheLoadsOfTheSolveBefore) {
  Scene scene = weightlessPaperScene(2);
  segmentOf(scene, 1).section.chambers.azimuths = {0.0, 0.3, 1.5, 1.9, 2.6, 3.0};
  const StiffnessModel model(scene, accurateTo(1e-9));
  StiffnessWorkspace workspace = model.makeWorkspace();
  const Pressures pressures = bars(0.5, {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0});
  const StiffnessSolution before = model.solve(pressures, Wrench::Zero(), workspace);
  ASSERT_TRUE(model.solve(pressures, 0.2 * Wrench::Unit(0), workspace).status.ok());
  const StiffnessSolution after = model.solve(pressures, Wrench::Zero(), workspace);
  ASSERT_TRUE(before.status.ok() && after.status.ok());
  EXPECT_TRUE(matrixNear(after.compliance, before.compliance, 0.0));
}

}  // namespace
}  // namespace live_stiffness
