#include "section/load_stepping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/matrix_near.h"
#include "support/random_source.h"
#include "support/scenes.h"
#include "support/rest_state.h"

namespace live_stiffness {
namespace {

CrossSection paperSection() {
  Scene scene = paperScene(1);
  return segmentOf(scene, 0).section;
}

// Stretch and curvature of a state in one vector: the curvature as bending of 40 mm.
Eigen::Vector4d numbers(const RestState& state) {
  return {state.stretch, 0.04 * state.curvature.x(), 0.04 * state.curvature.y(), 0.04 * state.curvature.z()};
}

const Pressures kBent = bars(1.2, {1.0, 0.9, 0.3, 0.2, 0.0, 0.1});

TEST(StepCount, IsTheSmallestThatKeepsStepsWithinTheLimit) {
  EXPECT_EQ(stepCount(0.0, 15000.0), 1);
  EXPECT_EQ(stepCount(15000.0, 15000.0), 1);
  EXPECT_EQ(stepCount(15001.0, 15000.0), 2);
  EXPECT_EQ(stepCount(120000.0, 15000.0), 8);
}

TEST(StepCount, IsNotFooledByTheLastDigit) {
  EXPECT_EQ(stepCount(1.2 * 1e5, 15000.0), 8);
  EXPECT_EQ(stepCount(std::nextafter(120000.0, 1e9), 15000.0), 8);
}

// (12), (15), (30) written out for one straight and one bent case, with (24) by hand.
TEST(FixedStep, FollowsThePapersIncrements) {
  const CrossSection section = paperSection();
  const int steps = 5;
  double stretch = 1.0;
  Vector3 curvature = Vector3::Zero();
  for (int j = 0; j < steps; ++j) {
    const double A = section.area(stretch), E = section.youngs_modulus;
    const double I = SectionMoments(section).secondMoments(stretch)(0, 0);  // isotropic for the paper's section
    curvature += section.chambers.actuationMoment(kBent / steps, stretch) / (E * I);
    stretch += section.chambers.actuationForce(kBent / steps) * stretch / (E * A);
  }
  const RestState state = restState(section, kBent, Stepping::kFixedStep, steps);
  EXPECT_NEAR(state.stretch, stretch, 1e-14);
  // I_x and I_y of the paper's section differ by rounding and by cos of 2.5 deg, not more.
  EXPECT_TRUE(matrixNear(state.curvature, curvature, 1e-12 * curvature.norm()));
  EXPECT_TRUE(matrixNear(state.c.bending_torsion, SectionMoments(section).complianceDensity(stretch).bending_torsion,
                         1e-12 * state.c.bending_torsion.norm()));
}

TEST(FixedStep, ConvergesToContinuousInFirstOrder) {
  const CrossSection section = paperSection();
  const Eigen::Vector4d limit = numbers(restState(section, kBent, Stepping::kContinuous, 1));
  double last = 0.0;
  for (int steps : {250, 500, 1000, 2000}) {
    const double error = (numbers(restState(section, kBent, Stepping::kFixedStep, steps)) - limit).norm();
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 2.0, 0.02);  // the next order is 1 / steps relative
    }
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(FixedStep, ExtrapolatedToZeroStepIsContinuous) {
  const CrossSection section = paperSection();
  const auto at = [&](int steps) { return numbers(restState(section, kBent, Stepping::kFixedStep, steps)); };
  // Richardson with three step sizes: the error left is of order (10 / 4000)^3 = 1e-8 at most.
  const Eigen::Vector4d a = at(4000), b = at(8000), c = at(16000);
  const Eigen::Vector4d extrapolated = (8.0 * c - 6.0 * b + a) / 3.0;
  EXPECT_TRUE(matrixNear(numbers(restState(section, kBent, Stepping::kContinuous, 1)), extrapolated, 1e-9));
}

TEST(Linear, IsOneStepWhoseSectionIsNeverUpdated) {
  const CrossSection section = paperSection();
  const RestState linear = restState(section, kBent, Stepping::kLinear, 7);
  const RestState one = restState(section, kBent, Stepping::kFixedStep, 1);
  EXPECT_EQ(linear.stretch, one.stretch);
  EXPECT_TRUE(matrixNear(linear.curvature, one.curvature, 1e-14));  // 1/m, of 18
  const ComplianceDensity c = SectionMoments(section).complianceDensity(1.0);
  EXPECT_TRUE(matrixNear(linear.c.bending_torsion, c.bending_torsion, 0.0));
  EXPECT_TRUE(matrixNear(linear.c.shear_elongation, c.shear_elongation, 0.0));
}

TEST(RestState, OfZeroPressureIsTheUnstretchedSection) {
  for (Stepping stepping : kSteppings) {
    const RestState state = restState(paperSection(), Pressures::Zero(6), stepping, 3);
    EXPECT_EQ(state.stretch, 1.0) << steppingName(stepping);
    EXPECT_TRUE(matrixNear(state.curvature, Vector3::Zero(), 0.0)) << steppingName(stepping);
  }
}

// One pair pushes, the pair opposite pulls: no net force, so no stretch, and the section at which bending happens
// stays at stretch 1 in every policy.
TEST(RestState, OfOppositePressuresBendsWithoutStretching) {
  CrossSection section = paperSection();
  section.chambers.azimuths = {0.0, 0.5 * kPi, kPi, 1.5 * kPi};
  const Pressures pressures = (Pressures(4) << 0.6e5, 0.0, -0.6e5, 0.0).finished();
  const ComplianceDensity c = SectionMoments(section).complianceDensity(1.0);
  const Vector3 expected = c.bending_torsion * section.chambers.actuationMoment(pressures, 1.0);
  ASSERT_GT(expected.norm(), 10.0);  // 1/m: a real bend
  for (Stepping stepping : kSteppings) {
    const RestState state = restState(section, pressures, stepping, 4);
    ASSERT_TRUE(state.valid) << steppingName(stepping);
    EXPECT_EQ(state.stretch, 1.0) << steppingName(stepping);
    EXPECT_TRUE(matrixNear(state.curvature, expected, 1e-14 * expected.norm())) << steppingName(stepping);
  }
}

TEST(RestState, OfTinyPressuresIsLinearTheoryToAllDigits) {
  const CrossSection section = paperSection();
  const ComplianceDensity c = SectionMoments(section).complianceDensity(1.0);
  for (double pascal : {1e-12, 1e-6, 1e-3}) {
    const Pressures pressures = pascal * (Pressures(6) << 1.0, 0.8, 0.3, -0.2, 0.0, 0.5).finished();
    const Vector3 curvature = c.bending_torsion * section.chambers.actuationMoment(pressures, 1.0);
    const double elongation = c.shear_elongation(2, 2) * section.chambers.actuationForce(pressures);
    for (Stepping stepping : kSteppings) {
      const RestState state = restState(section, pressures, stepping, 4);
      // What is not linear is of relative size P / E = 1e-8 at 1e-3 Pa, and rounding below.
      const double relative = 1e-13 + 3.0 * pascal / section.youngs_modulus;
      EXPECT_TRUE(matrixNear(state.curvature, curvature, relative * curvature.norm())) << steppingName(stepping) << pascal;
      // A stretch of 1 + e holds e to 1.1e-16, in fixed_step once a step.
      EXPECT_NEAR(state.stretch - 1.0, elongation, 4.5e-16 + relative * elongation) << steppingName(stepping) << pascal;
    }
  }
}

TEST(RestState, ShortensUnderVacuum) {
  const CrossSection section = paperSection();
  for (Stepping stepping : kSteppings) {
    const RestState state = restState(section, Pressures::Constant(6, -0.9e5), stepping, 6);
    ASSERT_TRUE(state.valid) << steppingName(stepping);
    EXPECT_LT(state.stretch, 0.95);
    EXPECT_GT(state.stretch, 0.5);
    EXPECT_TRUE(matrixNear(state.curvature, Vector3::Zero(), 1e-12));  // 1/m, from 6 moments that cancel
  }
}

TEST(RestState, BeyondTheLimitOfStretchSaysSoWithTheStretchAndNoNaN) {
  const CrossSection section = paperSection();
  for (Stepping stepping : {Stepping::kFixedStep, Stepping::kContinuous})
    for (double bar : {2.5, 5.0, 100.0, 1e4, 1e12}) {
      const RestState state = restState(section, Pressures::Constant(6, bar * 1e5), stepping, 20);
      EXPECT_FALSE(state.valid) << steppingName(stepping) << bar;
      EXPECT_TRUE(std::isfinite(state.stretch)) << steppingName(stepping) << bar;
      EXPECT_FALSE(SectionMoments(section).isValidAt(state.stretch)) << steppingName(stepping) << bar;
    }
}

TEST(RestState, IsAFunctionOfPressureThatIsContinuousUpToItsLimit) {
  const CrossSection section = paperSection();
  double last = 1.0;
  int beyond = 0;
  for (double bar = 0.0; bar < 3.0; bar += 0.01) {
    const RestState state = restState(section, Pressures::Constant(6, bar * 1e5), Stepping::kContinuous, 1);
    if (!state.valid) {
      ++beyond;
      continue;
    }
    EXPECT_EQ(beyond, 0) << "valid again at " << bar << " bar";
    EXPECT_GE(state.stretch, last) << bar;
    last = state.stretch;
  }
  EXPECT_GT(beyond, 0);
}

}  // namespace
}  // namespace live_stiffness
