#pragma once
// Conventions of the whole package, said once.
//
// Units      SI (m, rad, N, N m, Pa, kg, s). A quantity in another unit carries the unit in its name.
// Order      6-vectors are linear part first: twist [v; w], wrench [f; m]; Shi et al. (44), and geometry_msgs.
// Frames     B base plate (z along the straight backbone towards the tip), Q section at arc length s, T tip point, A tracker,
//            S the tracker's sensor, F a force sensor on the tip; of a parallel robot: P platform, D and E the two ends of a
//            rod, at the base and at the platform. X_AB is the pose of B in A; adjacent letters cancel: X_AC = X_AB * X_BC.
//            p_AB is given in axes of A. R is a rotation, never a frame. All symbols and terms: docs/derivation.md.
// Wrenches   n(s), m(s): what the part beyond s exerts on the part before it, in base axes.
// Compliance C maps a wrench acting at a point, in base axes, to the small twist of that point in base axes.
//
// Source of the method: J. Shi et al., "Stiffness modelling and analysis of soft fluidic-driven robots using Lie
// theory", International Journal of Robotics Research, 2024. Numbers in brackets, such as (24), are its equations.

#include <Eigen/Core>
#include <limits>

namespace live_stiffness {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix3X6 = Eigen::Matrix<double, 3, 6>;
using Pressures = Eigen::VectorXd;  // gauge, Pa, one per chamber, base to tip in the order of the scene
using PressuresRef = const Eigen::Ref<const Eigen::VectorXd>&;  // of arguments; any vector or part of one, not copied

using Twist = Vector6;   // [v; w]
using Wrench = Vector6;  // [f; m]

// The linear (v or f) and angular (w or m) part of a 6-vector.
template <class Derived>
auto linear(Eigen::MatrixBase<Derived>& x) {
  return x.template head<3>();
}
template <class Derived>
auto linear(const Eigen::MatrixBase<Derived>& x) {
  return x.template head<3>();
}
template <class Derived>
auto angular(Eigen::MatrixBase<Derived>& x) {
  return x.template tail<3>();
}
template <class Derived>
auto angular(const Eigen::MatrixBase<Derived>& x) {
  return x.template tail<3>();
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;  // rad
constexpr double kAtmospherePa = 101325.0;  // standard atmosphere: gauge = absolute - kAtmospherePa
constexpr double kStandardGravity = 9.80665;

inline double radians(double angle_deg) { return angle_deg * kDegree; }
inline double degrees(double angle) { return angle * (180.0 / kPi); }

}  // namespace live_stiffness
