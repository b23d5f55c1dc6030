#include "live_stiffness/analysis/directional_stiffness.h"

#include <gtest/gtest.h>

#include "live_stiffness/analysis/stiffness_criterion.h"
#include "live_stiffness/analysis/stiffness_matrix.h"
#include "support/frames.h"
#include "support/random_matrices.h"

namespace live_stiffness {
namespace {

struct Draw {
  Matrix6 C, K;
  Line line;
};

std::vector<Draw> draws() {
  RandomSource random(1);
  std::vector<Draw> result;
  for (int i = 0; i < 50; ++i) {
    const Matrix6 C = randomStiffness(random, 1.0, 10.0);
    result.push_back({C, stiffnessOf(C).K, {random.vector(1.0), random.direction(2.0)}});
  }
  return result;
}

TEST(DirectionalStiffness, IsWhatAFrameOnTheLineSays) {
  for (const Draw& draw : draws()) {
    // A frame with x along the line: diagonal entries there.
    const Vector3 x = draw.line.direction.normalized();
    Pose X;
    X.p = draw.line.point;
    X.R.col(0) = x;
    X.R.col(1) = x.unitOrthogonal();
    X.R.col(2) = x.cross(X.R.col(1));
    const Matrix6 C = complianceInFrame(draw.C, X), K = stiffnessInFrame(draw.K, X);
    EXPECT_NEAR(freeStiffnessAlong(draw.C, draw.line) * C(0, 0), 1.0, 1e-9);
    EXPECT_NEAR(constrainedStiffnessAlong(draw.K, draw.line) / K(0, 0), 1.0, 1e-9);
    EXPECT_NEAR(freeStiffnessAbout(draw.C, draw.line) * C(3, 3), 1.0, 1e-9);
    EXPECT_NEAR(constrainedStiffnessAbout(draw.K, draw.line) / K(3, 3), 1.0, 1e-9);
  }
}

TEST(DirectionalStiffness, ConstrainedIsNeverLessThanFree) {
  for (const Draw& draw : draws()) {
    EXPECT_GE(constrainedStiffnessAlong(draw.K, draw.line), freeStiffnessAlong(draw.C, draw.line));
    EXPECT_GE(constrainedStiffnessAbout(draw.K, draw.line), freeStiffnessAbout(draw.C, draw.line));
  }
}

TEST(StiffnessCriterion, NamesAreReadAndBadOnesRefused) {
  FaultList faults("test");
  for (const char* name : {"largest_eigenstiffness", "smallest_eigenstiffness", "trace", "largest_stiffness",
                           "smallest_stiffness", "directional:0,0.6,0.8", "constrained:0,0,-1"}) {
    EXPECT_EQ(criterionNamed(name, faults).name(), name);
  }
  EXPECT_EQ(criterionNamed("directional:-y", faults).direction, -Vector3::UnitY());
  EXPECT_TRUE(faults.empty());
  for (const char* name : {"", "stiff", "directional", "directional:", "directional:w", "directional:0,0,0",
                           "directional:1,2", "directional:1,2,3,4", "directional:nan,0,0", "trace:x"}) {
    FaultList fault("test");
    criterionNamed(name, fault);
    EXPECT_EQ(fault.faults().size(), 1u) << name;
  }
}

TEST(StiffnessCriterion, OfADiagonalComplianceAreTheObviousNumbers) {
  Matrix6 C = Matrix6::Zero();
  C.diagonal() << 1.0, 0.5, 0.25, 4.0, 8.0, 16.0;
  FaultList faults("test");
  const auto tau = [&](const char* name) { return criterionNamed(name, faults)(C); };
  EXPECT_NEAR(tau("trace"), 7.0, 1e-12);
  EXPECT_NEAR(tau("largest_stiffness"), 4.0, 1e-12);
  EXPECT_NEAR(tau("smallest_stiffness"), 1.0, 1e-12);
  EXPECT_NEAR(tau("directional:y"), 2.0, 1e-12);
  EXPECT_NEAR(tau("constrained:z"), 4.0, 1e-12);
  EXPECT_NEAR(tau("largest_eigenstiffness"), 0.5, 1e-12);  // all three pairs 1 / sqrt(C_ii C_jj)
  EXPECT_NEAR(tau("smallest_eigenstiffness"), 0.5, 1e-12);
  C(0, 0) = -1.0;
  for (const char* name : {"trace", "directional:y", "largest_eigenstiffness"}) EXPECT_TRUE(std::isnan(tau(name)));
}

}  // namespace
}  // namespace live_stiffness
