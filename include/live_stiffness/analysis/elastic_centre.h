#pragma once
// Centres of stiffness and of compliance: the points about which forces and moments are coupled least.
//
// J. Loncaric, "Normal forms of stiffness and compliance matrices", IEEE Journal of Robotics and Automation 3(6), 1987:
// for almost every matrix there is exactly one point about which the coupling block is symmetric, and axes there that
// make it diagonal, its normal form. That point is the centre of stiffness for K and the centre of compliance for C;
// in general the two differ. (The centre of elasticity of Patterson and Lipkin is a third point, not computed here.)
// Where the diagonal vanishes, too, it is a remote centre of compliance: a force through it moves it without turning.

#include "live_stiffness/conventions.h"

namespace live_stiffness {

struct ElasticCentre {
  bool exists = false;                // false: block singular, indefinite or not finite; nothing else holds
  Vector3 offset = Vector3::Zero();   // from the point that the matrix is about, its axes, m
  Matrix6 matrix = Matrix6::Zero();   // about the centre, same axes
  Matrix3 axes = Matrix3::Identity(); // columns: those of Loncaric's normal form, right-handed
  Vector3 coupling = Vector3::Zero(); // diagonal of the coupling block in them, ascending; N for K, 1/N for C
};

// Exists for every stable robot: only the translational block of K, or the rotational block of C, must be positive
// definite. Of an unsymmetric matrix (dead tip moment) the symmetric part is used.
ElasticCentre centreOfStiffness(const Matrix6& K);
ElasticCentre centreOfCompliance(const Matrix6& C);

}  // namespace live_stiffness
