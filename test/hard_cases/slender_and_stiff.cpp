// Proportions, stiffnesses and units far from the paper's: only ratios may matter.

#include <cmath>

#include "hard_cases/hard_case.h"
#include "rig/fine_robot.h"
#include "section/section_moments.h"
#include "support/errors.h"
#include "support/scaled_scene.h"

namespace live_stiffness {
namespace {

void compareWithFineRobot(HardOutcome& outcome, const Scene& scene, const Pressures& pressures, const Wrench& wrench) {
  const StiffnessModel model(scene, continuousOptions(1e-10));
  const StiffnessSolution solution = outcome.solveCold(model, pressures, wrench);
  const std::optional<Pose> expected = FineRobot(scene).solve(pressures, wrench);
  outcome.expect(expected.has_value(), "the truth was not found");
  // RK4 with 120 steps a segment.
  if (expected) outcome.error(poseError(solution.X_BT, *expected, scene.length()), 1e-8, "pose");
}

// One paper segment of another length, bent by half a radian each by pressure, tip force and weight.
void slenderness(HardOutcome& outcome) {
  for (double length_over_radius : {1.0, 2.0, 5.0, 20.0, 100.0, 300.0, 1000.0}) {
    Scene scene = paperScene(1);
    scene.tip_mass = 0.0;
    Segment& segment = segmentOf(scene, 0);
    segment.length = length_over_radius * segment.section.outer_radius;
    const double softness =
        SectionMoments(segment.section).complianceDensity(1.0).bending_torsion(0, 0) * segment.length;
    Pressures pressures = bars(1e-5, {1, 1, 0.3, 0, 0, 0});  // of 1 Pa
    pressures *= 0.5 / (softness * segment.section.chambers.actuationMoment(pressures, 1.0).norm());
    Wrench wrench = Wrench::Zero();
    linear(wrench) = Vector3(0.3, 0.8, 0.5) / (softness * segment.length);
    scene.gravity = Vector3(0.6, -0.5, -0.6) / (segment.mass() * softness * segment.length);
    compareWithFineRobot(outcome, scene, pressures, wrench);
  }
}

// Neighbours along one chain differ in stiffness by up to 1e6, either way; a segment as stiff as that is a link.
void stiffnessRatio(HardOutcome& outcome) {
  const Wrench wrench = (Wrench() << 0.03, -0.02, 0.01, 5e-4, 0.0, -5e-4).finished();
  for (int stiff : {0, 1})
    for (double ratio : {1e2, 1e4, 1e6}) {
      Scene scene = paperScene(2);
      CrossSection& section = segmentOf(scene, stiff).section;
      section.youngs_modulus *= ratio;
      section.shear_modulus *= ratio;
      Pressures pressures = Pressures::Zero(12);
      pressures.segment(6 * (1 - stiff), 6) = bars(0.6, {1, 1, 0.5, 0.2, 0, 0});
      pressures.segment(6 * stiff, 6) = ratio * bars(0.4, {0, 0, 1, 1, 0.5, 0.5});
      compareWithFineRobot(outcome, scene, pressures, wrench);

      pressures.segment(6 * stiff, 6).setZero();
      Scene with_link = scene;
      const Segment& segment = segmentOf(scene, stiff);
      with_link.chain[stiff == 0 ? 0 : 2] = Link{segment.length, segment.mass()};
      const StiffnessModel model(scene, continuousOptions(1e-10)), link_model(with_link, continuousOptions(1e-10));
      const StiffnessSolution solution = outcome.solveCold(model, pressures, wrench);
      const StiffnessSolution limit =
          outcome.solveCold(link_model, pressures.segment(6 * (1 - stiff), 6), wrench);
      outcome.error(poseError(solution.X_BT, limit.X_BT, scene.length()) / 10.0, 1.0 / ratio, "link as the limit");
    }
}

// Everything that is a force per area, and every load, times one factor: the same shape, the compliance divided by it.
void modulus(HardOutcome& outcome) {
  const Pressures pressures = bars(0.8, {1, 1, 0.5, 0.2, 0, 0}).replicate(2, 1);
  const Wrench wrench = (Wrench() << 0.03, -0.02, 0.01, 5e-4, 0.0, -5e-4).finished();
  const StiffnessModel model(paperScene(2), continuousOptions(1e-11));
  const StiffnessSolution expected = outcome.solveCold(model, pressures, wrench);
  for (double E : {1e3, 1e4, 1e6, 1e8, 1e10, 1e12}) {
    const Units units{1.0, E / segmentOf(const_cast<Scene&>(model.scene()), 0).section.youngs_modulus};
    const StiffnessModel scaled(units.scale(model.scene()), continuousOptions(1e-11));
    const StiffnessSolution solution =
        outcome.solveCold(scaled, units.pressure() * pressures, units.scale(wrench));
    outcome.error(poseError(solution.X_BT, expected.X_BT, 0.086), 1e-10, "pose");
    outcome.error(complianceError(units.toSi(solution.compliance), expected.compliance, 0.086), 1e-10, "compliance");
  }
}

void badUnits(HardOutcome& outcome) {
  const Pressures pressures = bars(0.8, {1, 1, 0.5, 0.2, 0, 0}).replicate(2, 1);
  const Wrench wrench = (Wrench() << 0.03, -0.02, 0.01, 5e-4, 0.0, -5e-4).finished();
  const Scene scene = awkwardScene();
  const StiffnessSolution expected =
      outcome.solveCold(StiffnessModel(scene, continuousOptions(1e-11)), pressures, wrench);
  constexpr Units kMillimetreNewton{1e3, 1.0}, kMicrometreMicronewton{1e6, 1e6}, kKilometreKilonewton{1e-3, 1e-3},
      kInchPoundForce{39.3700787, 0.224808943}, kLightYearDyne{1.0570e-16, 1e5}, kAngstromGiganewton{1e10, 1e-9};
  for (const Units& units : {kMillimetreNewton, kMicrometreMicronewton, kKilometreKilonewton, kInchPoundForce,
                             kLightYearDyne, kAngstromGiganewton}) {
    const StiffnessModel scaled(units.scale(scene), continuousOptions(1e-11));
    const StiffnessSolution solution =
        outcome.solveCold(scaled, units.pressure() * pressures, units.scale(wrench));
    outcome.error(poseError(units.toMetres(solution.X_BT), expected.X_BT, scene.length()), 1e-10, "pose");
    outcome.error(complianceError(units.toSi(solution.compliance), expected.compliance, scene.length()), 1e-10,
                  "tangent compliance");
    outcome.error(complianceError(units.toSi(solution.material_compliance), expected.material_compliance,
                                  scene.length()), 1e-10, "material compliance");
  }
}

}  // namespace

HardTheme slenderAndStiff() {
  return {"slender_and_stiff",
          {{"length_over_radius_1_to_1000", "RK4 of load path and rod", slenderness},
           {"stiffness_ratio_1e6", "RK4 of load path and rod; a rigid link", stiffnessRatio},
           {"modulus_1e3_to_1e12_pa", "similarity", modulus},
           {"bad_units", "the same in SI", badUnits}}};
}

}  // namespace live_stiffness
