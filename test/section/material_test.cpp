#include "live_stiffness/section/material.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig/fine_robot.h"
#include "support/rest_state.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

constexpr StretchLaw kLaws[] = {StretchLaw::kSectionUpdate, StretchLaw::kNeoHookean, StretchLaw::kGent,
                                StretchLaw::kYeoh};

Material materialOf(StretchLaw law) {
  Material material;
  material.law = law;
  material.gent_limit = 5.0;
  material.yeoh_c2 = -0.05;
  material.yeoh_c3 = 0.02;
  return material;
}

// N / E of the hyperelastic laws, written out independently of tangentRatio().
double nominalStress(const Material& material, double lam) {
  const double J = lam * lam + 2.0 / lam - 3.0;
  const double neo_hookean = (lam - 1.0 / (lam * lam)) / 3.0;
  if (material.law == StretchLaw::kGent) return neo_hookean * material.gent_limit / (material.gent_limit - J);
  if (material.law == StretchLaw::kYeoh)
    return neo_hookean * (1.0 + 2.0 * material.yeoh_c2 * J + 3.0 * material.yeoh_c3 * J * J);
  return neo_hookean;
}

TEST(StretchLaw, TangentIsThatOfTheNominalStress) {
  for (StretchLaw law : {StretchLaw::kNeoHookean, StretchLaw::kGent, StretchLaw::kYeoh}) {
    const Material material = materialOf(law);
    for (double lam : {0.8, 1.0, 1.2, 1.7, 2.1}) {
      const double h = 1e-5;  // truncation 1e-10, rounding 1e-11
      const double slope = (nominalStress(material, lam + h) - nominalStress(material, lam - h)) / (2.0 * h);
      EXPECT_NEAR(tangentRatio(material, lam), lam * lam * slope, 1e-8) << static_cast<int>(law) << " at " << lam;
    }
  }
}

TEST(StretchLaw, EveryLawHasYoungsModulusAtRest) {
  for (StretchLaw law : kLaws) EXPECT_DOUBLE_EQ(tangentRatio(materialOf(law), 1.0), 1.0);
}

TEST(StretchLaw, GentHasNoStiffnessBeyondItsLimit) {
  EXPECT_EQ(tangentRatio(materialOf(StretchLaw::kGent), 3.0), 0.0);  // J = 6.7 > 5
}

CrossSection section(StretchLaw law, double stiffening, double growth) {
  Scene scene = paperScene(1);
  CrossSection& section = segmentOf(scene, 0).section;
  section.material = materialOf(law);
  section.material.pressure_stiffening = stiffening;
  section.chambers.area_growth = growth;
  return section;
}

const Pressures kBent = bars(1.0, {1.0, 0.9, 0.3, 0.2, 0.0, 0.1});

double distance(const RestState& a, const RestState& b) {
  return std::abs(a.stretch - b.stretch) + 0.04 * (a.curvature - b.curvature).norm() +
         (a.c.bending_torsion - b.c.bending_torsion).norm() / b.c.bending_torsion.norm() +
         (a.c.shear_elongation - b.c.shear_elongation).norm() / b.c.shear_elongation.norm();
}

// Small volume of chambers: the tube alone, whose force is A0 N(lam).
TEST(LoadStepping, StretchIsThatOfTheHyperelasticTube) {
  for (StretchLaw law : {StretchLaw::kNeoHookean, StretchLaw::kGent, StretchLaw::kYeoh}) {
    CrossSection tube = section(law, 0.0, 0.0);
    tube.chambers.radius = 1e-5;
    const Pressures pressures = Pressures::Constant(6, 1.5e10);  // 28 N through chambers that take no area
    const RestState state = restState(tube, pressures, Stepping::kContinuous, 1);
    ASSERT_TRUE(state.valid);
    EXPECT_GT(state.stretch, 1.3);
    const double force = tube.youngs_modulus * tube.area(1.0) * nominalStress(tube.material, state.stretch);
    EXPECT_NEAR(force / tube.chambers.actuationForce(pressures), 1.0, 1e-5);  // 1e-5: the chambers' share of the area
  }
}

// Two different codes, one of them in closed form.
TEST(LoadStepping, CollocationMeetsTheClosedFormOfThePapersMaterial) {
  const RestState closed = restState(section(StretchLaw::kSectionUpdate, 0.0, 0.0), kBent, Stepping::kContinuous, 1);
  const RestState collocated =
      restState(section(StretchLaw::kSectionUpdate, 1e-13, 0.0), kBent, Stepping::kContinuous, 1);
  EXPECT_LT(distance(closed, collocated), 1e-11);
}

TEST(LoadStepping, FixedStepsConvergeToContinuousForEveryMaterial) {
  for (StretchLaw law : kLaws) {
    const CrossSection with = section(law, 0.5, 1e-6);
    const RestState limit = restState(with, kBent, Stepping::kContinuous, 1);
    const double coarse = distance(restState(with, kBent, Stepping::kFixedStep, 200), limit);
    const double fine = distance(restState(with, kBent, Stepping::kFixedStep, 400), limit);
    EXPECT_LT(fine, 5e-3);
    EXPECT_NEAR(coarse / fine, 2.0, 0.05) << static_cast<int>(law);  // first order
  }
}

// The product's policy starts every path at zero pressure: what was there before cannot matter, whatever the material.
TEST(LoadStepping, DependsOnThePressuresAloneForEveryMaterial) {
  for (StretchLaw law : kLaws) {
    const LoadStepper stepper(section(law, 0.5, 1e-6));
    for (Stepping stepping : {Stepping::kFixedStep, Stepping::kContinuous, Stepping::kLinear}) {
      const RestState first = stepper.restState(kBent, stepping, 8);
      stepper.restState(bars(1.4, {0, 0, 1, 1, 1, 1}), stepping, 12);
      const RestState rest = stepper.restState(Pressures::Zero(6), stepping, 1);
      EXPECT_EQ(rest.stretch, 1.0);
      EXPECT_TRUE(rest.curvature.isZero(0.0));
      EXPECT_EQ(distance(stepper.restState(kBent, stepping, 8), first), 0.0);
    }
  }
}

// The simulated rig integrates the same rates with its own Runge-Kutta over the load.
TEST(LoadStepping, AgreesWithTheFineRobotForEveryMaterial) {
  for (StretchLaw law : kLaws) {
    Scene scene = weightlessPaperScene(1);
    segmentOf(scene, 0).section = section(law, 0.5, 1e-6);
    const RestState state = restState(segmentOf(scene, 0).section, kBent, Stepping::kContinuous, 1);
    const auto solution = FineRobot(scene).solve(kBent, Wrench::Zero());
    ASSERT_TRUE(solution);
    const Pose expected = expSe3(Vector3::UnitZ(), state.curvature, state.stretch * segmentOf(scene, 0).length);
    EXPECT_LT((solution->p - expected.p).norm(), 1e-9);  // of 0.06 m: the rig's own steps
  }
}

TEST(LoadStepping, PressureStiffensOnTheSideOfTheChambers) {
  const Pressures one = bars(0.8, {1, 1, 0, 0, 0, 0});  // the pair at 0 deg, along x
  const RestState plain = restState(section(StretchLaw::kSectionUpdate, 0.0, 0.0), one, Stepping::kContinuous, 1);
  const RestState stiffened = restState(section(StretchLaw::kSectionUpdate, 1.0, 0.0), one, Stepping::kContinuous, 1);
  EXPECT_LT(stiffened.stretch, plain.stretch);
  EXPECT_LT(stiffened.curvature.norm(), plain.curvature.norm());
  // A chamber on the x axis resists bending about y, hardly about x.
  const double about_x = stiffened.c.bending_torsion(0, 0) / plain.c.bending_torsion(0, 0);
  const double about_y = stiffened.c.bending_torsion(1, 1) / plain.c.bending_torsion(1, 1);
  EXPECT_LT(about_y, about_x);
}

TEST(LoadStepping, SwellingChambersPushLikeAHigherPressure) {
  const RestState swollen = restState(section(StretchLaw::kNeoHookean, 0.0, 1e-6), kBent, Stepping::kContinuous, 1);
  const Pressures higher = kBent.array() * (1.0 + 1e-6 * kBent.array());
  const RestState plain = restState(section(StretchLaw::kNeoHookean, 0.0, 0.0), higher, Stepping::kContinuous, 1);
  EXPECT_LT(distance(swollen, plain), 1e-13);
}

TEST(LoadStepping, BeyondTheLawIsOutOfRangeNotNan) {
  CrossSection soft = section(StretchLaw::kYeoh, 0.0, 0.0);
  soft.material.yeoh_c2 = -1.0;  // softens until it has no stiffness
  const RestState state = restState(soft, bars(1.5, {1, 1, 1, 1, 1, 1}), Stepping::kContinuous, 1);
  EXPECT_FALSE(state.valid);
  EXPECT_TRUE(std::isfinite(state.stretch));
}

}  // namespace
}  // namespace live_stiffness
