#pragma once
// A part of a Cosserat rod between two arc lengths, collocated at the Gauss-Legendre nodes. The equations are in
// src/rod/element_shape_code.h and element_section_code.h, their derivation in docs/derivation.md.

#include "live_stiffness/lie/se3.h"
#include "rod/element_kernel.h"
#include "section/load_stepping.h"

namespace live_stiffness {

// The numbers of an element, and what reads and writes them as vectors.
struct RodElement {
  RodElement() : state() {}

  ElementState state;

  // Start values: pose of the first section in B; external force and moment there, N and N m, base axes.
  void setStart(const Pose& X, const Vector3& n, const Vector3& m);
  void setSection(const RestState& rest);
  // Dead load w per stretched length, N/m, base axes.
  void setLoad(const Vector3& line_load);

  Vector3 p_start() const { return Vector3(state.p_start); }
  Pose X_start() const;
  Pose X_end() const;
  Vector3 n_end() const { return Vector3(state.n_end); }
  Vector3 m_end() const { return Vector3(state.m_end); }
  Vector3 g_end(int stages) const;   // Cayley vector between its ends
  double bending(int stages) const;  // about the angle between its ends, rad
};
// So that a vector of them is an array of states.
static_assert(sizeof(RodElement) == sizeof(ElementState), "RodElement holds nothing but its state");

// Integrates the element from its start values by fixed-point iterations, from the guess that it holds or cold. Order 2
// stages. Returns false if the iterations do not converge: the element is too long for its load or curvature.
bool integrate(const ElementKernel& kernel, bool cold, RodElement& element);

// Sensitivities of an integrated element, ElementState::transfer, by iterations until they change by less than `goal`, relative:
//   phi' = R c_bt R^T (dm - phi x m),  dp' = phi x p' + R c_se R^T (dn - phi x n),  dm' = -dp' x n - p' x dn.
// Returns what is estimated to be left, relative; infinity without convergence.
double propagate(const ElementKernel& kernel, double goal, RodElement& element);

// The 21 numbers of element_state.h as a 6x6 matrix; same point, axes and units.
inline void unpack(const PackedRow& compliance, Matrix6& C) {
  // Which of the 21 numbers is entry (row, column).
  static constexpr int kIndex[6][6] = {{0, 1, 2, 6, 7, 8},     {1, 3, 4, 9, 10, 11},   {2, 4, 5, 12, 13, 14},
                                       {6, 9, 12, 15, 16, 17}, {7, 10, 13, 16, 18, 19}, {8, 11, 14, 17, 19, 20}};
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j)
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) C(i, j) = compliance[kIndex[i][j]];
}

// One part (phi, p or m) of three columns of a transfer as a 3x3 matrix; first: kOfMoment, kOfForce or kOfRotation.
inline Eigen::Map<const Matrix3> sensitivityMatrix(const double (*part)[3], int first) {
  return Eigen::Map<const Matrix3>(part[first]);
}

}  // namespace live_stiffness
