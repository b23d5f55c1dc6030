// Pressures up to the end of the section's range and past it, in one chamber, in all and in opposite ones, and vacuum.

#include <cmath>

#include "hard_cases/hard_case.h"
#include "rig/fine_robot.h"
#include "support/errors.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

// The paper's section, by hand.
constexpr double kOuter = 0.0125, kLumen = 0.0044, kChamber = 0.00225, kPitch = 0.00831, kModulus = 90060.0;
constexpr double kTube = kOuter * kOuter - kLumen * kLumen;  // times pi

// Equal pressure in six chambers that holds a stretch: F(lam) of the limit of small steps over 6 A_P.
double pressureAt(double stretch) {
  return kModulus * (kTube * (1.0 - 1.0 / stretch) - 6.0 * kChamber * kChamber * std::log(stretch)) /
         (6.0 * kChamber * kChamber);
}

// A(lam) or I(lam) (24) over pi, whichever is zero first: 4.5 or below.
double largestStretch() {
  const auto valid = [](double lam) {
    const double area = kTube / lam - 6.0 * kChamber * kChamber;
    const double moment = (std::pow(kOuter, 4) - std::pow(kLumen, 4)) / (4.0 * lam * lam) -
                          6.0 * std::pow(kChamber, 4) / 4.0 - 3.0 * kChamber * kChamber * kPitch * kPitch / lam;
    return area > 0.0 && moment > 0.0;
  };
  double low = 1.0, high = 10.0;
  for (int i = 0; i < 60; ++i) (valid(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

void allChambersToTheLimit(HardOutcome& outcome) {
  const double limit = largestStretch();
  const StiffnessModel model(weightlessPaperScene(1), continuousOptions());
  for (double stretch : {1.0 + 1e-12, 1.0 + 1e-6, 1.1, 1.5, 2.0, 0.9 * limit, 0.99 * limit, limit - 1e-4}) {
    StiffnessWorkspace workspace = model.makeWorkspace();
    const StiffnessSolution solution =
        outcome.solve(model, Pressures::Constant(6, pressureAt(stretch)), Wrench::Zero(), workspace);
    const double area = kPi * (kTube / stretch - 6.0 * kChamber * kChamber);
    // dlam / lam = dF / (E A): what rounding of the pressure comes to.
    const double buckling_factor = 1.0 + 6.0 * kPi * kChamber * kChamber * pressureAt(stretch) / (kModulus * area);
    outcome.error(std::abs(solution.X_BT.p.z() / (0.04 * stretch) - 1.0), 4e-15 * buckling_factor, "stretch");
    outcome.error(solution.X_BT.p.head<2>().norm() / 0.04, 1e-14 * buckling_factor, "straightness");
    outcome.error(std::abs(solution.compliance(2, 2) * kModulus * area / (0.04 * stretch) - 1.0),
                  1e-13 * buckling_factor * buckling_factor, "elongation compliance");
  }
}

void pastTheLimit(HardOutcome& outcome) {
  for (bool weight : {false, true})
    for (Stepping stepping : {Stepping::kContinuous, Stepping::kFixedStep}) {
      ModelOptions options = continuousOptions();
      options.stepping = stepping;
      const StiffnessModel model(weight ? paperScene(1) : weightlessPaperScene(1), options);
      const double highest = pressureAt(largestStretch()), explicit_lag = stepping == Stepping::kFixedStep ? 2.0 : 1.0;
      for (double share : {1.0001, 1.1, 2.0, 1e2, 1e6, 1e300}) {
        const StiffnessSolution solution =
            outcome.solveCold(model, Pressures::Constant(6, std::min(1e308, share * explicit_lag * highest)),
                              Wrench::Zero(), SolveCode::kOutOfRange);
        outcome.expect(std::isfinite(solution.status.value), "status without its value");
      }
    }
}

// Against the rig's robot: Runge-Kutta over the load and along the rod.
void compareWithFineRobot(HardOutcome& outcome, const Scene& scene, const std::vector<Pressures>& all,
                          double tolerance) {
  const StiffnessModel model(scene, continuousOptions());
  for (const Pressures& pressures : all) {
    const StiffnessSolution solution = outcome.solveCold(model, pressures, Wrench::Zero());
    const std::optional<Pose> expected = FineRobot(scene).solve(pressures);
    outcome.expect(expected.has_value(), "the truth was not found");
    if (expected) outcome.error(poseError(solution.X_BT, *expected, scene.length()), tolerance, "pose");
  }
}

void oneChamber(HardOutcome& outcome) {
  std::vector<Pressures> all;
  for (int k : {0, 3, 5})
    for (double bar : {1e-6, 0.5, 2.0, 4.0}) all.push_back(1e5 * bar * Pressures::Unit(6, k));
  compareWithFineRobot(outcome, paperScene(1), all, 1e-8);
}

// Six chambers evenly around: what two opposite ones do to each other's bending cancels.
void oppositeChambers(HardOutcome& outcome) {
  Scene scene = weightlessPaperScene(1);
  CrossSection& section = segmentOf(scene, 0).section;
  for (int k = 0; k < 6; ++k) section.chambers.azimuths[k] = k * kPi / 3.0;
  const StiffnessModel model(scene, continuousOptions());
  for (int k = 0; k < 3; ++k)
    for (double bar : {0.1, 1.0, 2.0}) {
      Pressures pressures = Pressures::Zero(6);
      pressures[k] = pressures[k + 3] = 1e5 * bar;
      const StiffnessSolution solution = outcome.solveCold(model, pressures, Wrench::Zero());
      outcome.error(solution.X_BT.p.head<2>().norm() / 0.04, 1e-14, "straightness");
      // One of the pair in vacuum: bending twice, no force and so no stretch.
      pressures[k + 3] = -0.9e5;
      pressures[k] = 0.9e5;
      StiffnessWorkspace workspace = model.makeWorkspace();
      outcome.solve(model, pressures, Wrench::Zero(), workspace);
      outcome.error(std::abs(model.station(workspace, 0, 1.0).stretch - 1.0), 1e-14, "stretch");
    }
  std::vector<Pressures> all;
  for (double bar : {0.5, 1.5}) all.push_back(bars(bar, {1, 0.2, 0, 1, 0.2, 0}));
  scene.gravity = Vector3(3.0, -4.0, -8.0);
  compareWithFineRobot(outcome, scene, all, 1e-8);
}

void vacuum(HardOutcome& outcome) {
  std::vector<Pressures> all = {Pressures::Constant(6, -1.0e5), bars(1.0, {-1, -1, 0, 0, 0, 0}),
                                bars(0.9, {-1, 1, 0.5, -0.5, 0, 0}), Pressures::Constant(6, -kAtmospherePa)};
  compareWithFineRobot(outcome, paperScene(1), all, 1e-8);
  const StiffnessModel model(paperScene(1), continuousOptions());
  outcome.solveCold(model, Pressures::Constant(6, -1.02e5), Wrench::Zero(), SolveCode::kInvalidInput);
}

}  // namespace

HardTheme sectionLimits() {
  return {"section_limits",
          {{"all_chambers_to_the_limit", "closed form of F(lam) by hand", allChambersToTheLimit},
           {"past_the_limit", "status out_of_range", pastTheLimit},
           {"one_chamber", "RK4 of load path and rod", oneChamber},
           {"opposite_chambers", "symmetry; RK4 of load path and rod", oppositeChambers},
           {"vacuum", "RK4 of load path and rod", vacuum}}};
}

}  // namespace live_stiffness
