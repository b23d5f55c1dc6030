#pragma once
// Eigenscrew decomposition (21) of a stiffness matrix, K Delta.
//
// Shi et al. 2.4.2; S. Huang and J. M. Schimmels, "The eigenscrew decomposition of spatial stiffness matrices", IEEE
// Transactions on Robotics and Automation 16(2), 2000. Any positive definite K is six screw springs:
//   K = sum_i k_i w_i w_i^T,  w_i = [n_i; r_i x n_i + h_i n_i],  eta_i = 2 h_i k_i,
// each a linear spring of stiffness k_i along a line that also turns, with pitch h_i. K Delta w_i = eta_i w_i. Those of
// C = K^-1 are the same six screws, with eigenvalues 1 / eta_i.
//
// Lines and pitches are properties of the spring and not of the frame, so eigenvalues and pitches do not depend on it.
// The eigenvalue problem is unsymmetric and may be badly scaled, and is therefore not solved as it stands: with
// the Cholesky factor K = L L^T, K Delta has the eigenvalues of the symmetric L^T Delta L, all of whose entries have
// the unit of force, so that no characteristic length is needed; and the factor itself is as accurate whatever the
// units, since scaling rows and columns of K scales those of L. Eigenvalues are real without being made so, three
// positive and three negative by Sylvester's law; rounding is relative to the largest one. Before that K is moved to
// its centre (elastic_centre.h), so that a far point of reference costs only the digits that it had lost already.

#include <array>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

struct Eigenscrew {
  double eigenvalue = 0.0;              // eta, eigenstiffness, N
  double pitch = 0.0;                   // h, m/rad; its sign is that of the eigenvalue
  Vector3 point = Vector3::Zero();  // of the axis, the one nearest to the point that the matrix is about; from there, m
  Vector3 direction = Vector3::Zero();  // n, unit vector; the sign means nothing: its largest component is positive
  double coefficient = 0.0;             // k, N/m
};

struct EigenscrewDecomposition {
  // The symmetric part is positive definite. False: an unstable equilibrium, or singular, or not finite; K Delta may
  // then have complex eigenvalues or too few vectors, and nothing below holds.
  bool definite = false;
  double asymmetry = 0.0;  // see asymmetryOf(); the screws are those of the symmetric part
  // The positive ones, largest first, then the negative ones, largest size first. Eigenscrews of an eigenvalue that
  // occurs more than once (a straight symmetric robot) are not unique; any set that adds up to the matrix is given.
  std::array<Eigenscrew, 6> screws;
};

// K about any point, any axes.
EigenscrewDecomposition eigenscrewsOfStiffness(const Matrix6& K);

// Eigenstiffnesses alone, from a compliance, in the order of the screws of K, N. Quicker. All zero unless definite.
struct Eigenstiffnesses {
  bool definite = false;
  Vector6 values = Vector6::Zero();
};
Eigenstiffnesses eigenstiffnessesOfCompliance(const Matrix6& C);

}  // namespace live_stiffness
