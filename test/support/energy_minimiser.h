#pragma once
// Equilibria as minima of the potential energy: a second opinion that shares nothing with the library's solver but the
// scene and the rest states. The unknowns are the rotations of many sections (chain_energy.h). Newton's method goes downhill
// from the unloaded robot at full load, and from a saddle further down, so that it ends in a minimum.

#include <optional>
#include <vector>

#include "live_stiffness/compliance/model_options.h"
#include "support/chain_energy.h"

namespace live_stiffness {

// Where the descent ended; base axes.
struct EnergyMinimum {
  // A minimum along a circle (a symmetric column beyond buckling may lean anywhere) is as stiff as this, or less.
  static constexpr double kNeutral = 1e-7;

  bool converged = false;        // no way down, and no moments left
  int iterations = 0;            // Newton steps
  double energy = 0.0;           // J
  double residual = 0.0;         // largest turn of a section of the weightless robot by what moments are left, rad
  double least_stiffness = 0.0;  // smallest eigenvalue of E'' relative to the stiffness of the material, to 2 %: 1 without
                                 // loads, 1 - load / critical load of a straight column, 0 neutral, negative at a saddle
  Pose X_BT;                     // tip point, m
  Matrix6 compliance = Matrix6::Zero();  // tangent, of T under a dead wrench at T; zero unless stable
  Vector3 base_moment = Vector3::Zero();  // of the robot on the base plate, N m
  std::vector<Pose> joints;      // far end of each body, base to tip, m
  NodeRotations nodes;           // R_BQ, base to tip: of the base and of n sections of each segment

  bool isStable() const { return converged && least_stiffness > kNeutral; }
  bool isNeutral() const { return converged && std::abs(least_stiffness) <= kNeutral; }
};

// Rest states of all segments as a model with these options has them, base to tip. pressures: gauge, Pa, all chambers.
std::vector<RestState> restStates(const Scene& scene, PressuresRef pressures, const ModelOptions& options);

// n intervals a segment. start: R_BQ of 1 + n * segments nodes; none: the robot without loads. Throws
// std::invalid_argument if the tip wrench (dead, at T, base axes) has a moment, which has no potential, and
// std::runtime_error if something is not finite.
EnergyMinimum minimiseEnergy(const Scene& scene, const std::vector<RestState>& rest, const Wrench& tip_wrench, int n,
                             const std::optional<NodeRotations>& start = {});

// Romberg's extrapolation of n, 2n and 4n intervals a segment, each from the shape of the one before: what is left is of
// order n^-6.
struct ExtrapolatedMinimum {
  EnergyMinimum finest;     // of 4n
  Pose X_BT;                // m
  Matrix6 compliance;       // as that of EnergyMinimum
  double pose_error = 0.0;        // last correction: m over the robot's length, and rad
  double compliance_error = 0.0;  // last correction, relative; moments scaled by the robot's length
};
ExtrapolatedMinimum extrapolatedMinimum(const Scene& scene, const std::vector<RestState>& rest, const Wrench& tip_wrench,
                                        int n, std::optional<NodeRotations> start = {});

}  // namespace live_stiffness
