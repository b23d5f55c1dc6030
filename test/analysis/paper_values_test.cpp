// What the paper prints of its own analysis (Fig. 8 and 10, section 4), against its one-segment scene. The modulus of
// that scene is inferred from Table 5, so a few per cent is what can be asked for.

#include <gtest/gtest.h>

#include <iostream>

#include "live_stiffness/analysis/eigenscrews.h"
#include "live_stiffness/analysis/ellipsoid.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

constexpr double kCmPerM = 100.0;

Vector3 tipEigenvalues(const Pressures& pressures) {  // of material compliance, as the paper's (10), cm/N
  const StiffnessSolution solution = solveCold(StiffnessModel(paperScene(1), {}), pressures);
  EXPECT_TRUE(solution.status.ok());
  return kCmPerM * ellipsoidsOf(solution.material_compliance).translation.half_axes;
}

TEST(PaperValues, TipComplianceAtRest) {  // section 4.2: 1.84 and 0.13 cm/N
  const Vector3 found = tipEigenvalues(Pressures::Zero(6));
  EXPECT_NEAR(found[2], 1.84, 0.01);
  EXPECT_NEAR(found[0], 0.13, 0.005);
}

// 3.60 and 0.36 cm/N are the two eigenvalues in the plane of bending; the third, across it, is larger.
TEST(PaperValues, TipComplianceBentByOnePair) {
  const Vector3 found = tipEigenvalues(bars(1.5, {1, 1, 0, 0, 0, 0}));
  EXPECT_NEAR(found[0], 0.36, 0.01);
  EXPECT_NEAR(found[1], 3.60, 0.04);
  EXPECT_NEAR(found[2], 4.38, 0.02);
}

// Fig. 10: 4.37 at the centre, that is at rest, to 1.49 N with all chambers at 1 bar. NCM. Of a straight robot it is
// that of stretch and torsion, which weight does not change: tangent and material agree.
TEST(PaperValues, LargestEigenstiffness) {
  const StiffnessModel model(paperScene(1), {});
  const auto largest = [&](double bar) {
    const StiffnessSolution solution = solveCold(model, bars(bar, {1, 1, 1, 1, 1, 1}));
    EXPECT_TRUE(solution.status.ok());
    const double material = eigenstiffnessesOfCompliance(solution.material_compliance).values[0];
    EXPECT_NEAR(eigenstiffnessesOfCompliance(solution.compliance).values[0] / material, 1.0, 1e-4);
    return material;
  };
  const double rest = largest(0.0), full = largest(1.0);
  std::cout << rest << " N to " << full << " N\n";
  EXPECT_NEAR(rest / 4.37, 1.0, 0.05);
  EXPECT_NEAR(full / 1.49, 1.0, 0.05);
}

}  // namespace
}  // namespace live_stiffness
