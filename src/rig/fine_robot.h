#pragma once
// Ground truth of the simulated rig: the same physics as the estimator's model, computed another way and finer.
//
// Shares only the scene, the section's moments and the Lie group with the product. The load path is the limit of
// infinitely many steps, by Runge-Kutta over the load; the rod is integrated by classical Runge-Kutta on quaternion,
// position and moment with kRodSteps steps a segment; the base moment is found by Newton with finite differences.
// Slow (about a millisecond a solve) and simple, so that an error would have to be made twice to go unseen.

#include <optional>
#include <vector>

#include "live_stiffness/lie/se3.h"
#include "live_stiffness/rod/scene.h"
#include "section/section_moments.h"

namespace live_stiffness {

class FineRobot {
 public:
  static constexpr int kRodSteps = 120;   // a segment
  static constexpr int kLoadSteps = 400;  // from zero to full pressure

  // Throws ConfigurationError on a scene without segments.
  explicit FineRobot(Scene scene);

  // Tip pose X_BT (m) for gauge pressures (Pa, one per chamber, base to tip) and a dead wrench at T (base axes).
  // Empty if the pressures are not finite, of the wrong number, or beyond the section's range, or if no equilibrium
  // is found. Starts from the last equilibrium.
  std::optional<Pose> solve(PressuresRef pressures, const Wrench& tip_wrench = Wrench::Zero());

  // True if every section keeps a positive area under these pressures.
  bool inRange(PressuresRef pressures) const;

 private:
  // One segment after the load path: its stretched length and what it is made of per stretched length.
  struct LoadedSegment {
    double length = 0.0;                         // lam l0, m
    Vector3 rest_curvature = Vector3::Zero();    // 1/m, section axes
    ComplianceDensity c;
    double mass = 0.0;                           // kg
  };
  using RodState = Eigen::Matrix<double, 10, 1>;  // quaternion (x, y, z, w), p (m) and m (N m) of a section

  bool loadSegments(PressuresRef pressures, std::vector<LoadedSegment>& segments) const;
  RodState integrateChain(const std::vector<LoadedSegment>& segments, const Vector3& gravity, const Wrench& tip_wrench,
                          const Vector3& base_moment) const;
  // Moment left over at T: what the rod carries there less what acts there.
  Vector3 residual(const std::vector<LoadedSegment>& segments, const Vector3& gravity, const Wrench& tip_wrench,
                   const Vector3& base_moment, RodState& end) const;
  bool newton(const std::vector<LoadedSegment>& segments, const Vector3& gravity, const Wrench& tip_wrench,
              Vector3& base_moment, RodState& end) const;

  Scene scene_;
  Vector3 base_moment_ = Vector3::Zero();  // of the last equilibrium, N m, base axes
};

}  // namespace live_stiffness
