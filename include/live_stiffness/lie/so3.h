#pragma once
// The rotation group SO(3): exponential, logarithm and the derivative of the exponential.
//
// Where a function has a branch, its switch is the last argument, for tests to force either branch.

#include <Eigen/Geometry>

#include "live_stiffness/conventions.h"
#include "live_stiffness/lie/angle_functions.h"

namespace live_stiffness {

// Skew matrix: hat(x) y = x cross y. Shi et al. (45).
Matrix3 hat(const Vector3& x);

// Rotation matrix of the rotation vector w (rad): I + a hat(w) + b hat(w)^2.
Matrix3 expSo3(const Vector3& w, double series_below = kSeriesBelowAngle);

// Rotation vector (rad, length <= pi) of R. At exactly pi the sign of the axis is arbitrary. linear_below: sine of half
// the angle below which the arc tangent is its argument.
Vector3 logSo3(const Matrix3& R, double linear_below = 1e-8);

// Left Jacobian V(w) = I + b hat(w) + c hat(w)^2, the integral of exp(x hat(w)) over x in [0, 1].
Matrix3 leftJacobianSo3(const Vector3& w, double series_below = kSeriesBelowAngle);

// With R(s) = R0 exp(hat(w(s))) and R' = R hat(u): the rate w' = (I + hat(w)/2 + d hat(w)^2) u, the inverse right
// Jacobian applied to u. Singular at |w| = 2 pi, so keep elements well below.
Vector3 bodyRateToVectorRate(const Vector3& w, const Vector3& u,
                                    double series_below = kPoleSeriesBelowAngle);

// The rotation next to a product of many rotations: one Newton-Schulz step R (3 I - R^T R) / 2. The orthonormality error
// e = |R^T R - I| becomes 3/4 e^2 plus rounding, so one step is enough for e < 1e-8.
//
// Each product adds about 1e-16 to e: with random sign for different rotations (3e-12 after a million products), with the same
// sign if one rotation is repeated (1e-10). In an endless chain apply this after every product, or after every ten for 1e-14.
// The chain of a robot (some dozens of elements and links) does not need it, so Pose::operator* is a plain product.
Matrix3 orthonormalised(const Matrix3& R);

}  // namespace live_stiffness
