#include "rod/rod_element.h"

#include <cmath>

#include "live_stiffness/lie/so3.h"

namespace live_stiffness {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Map<RowMajor3> matrixOf(double (&R)[9]) { return Eigen::Map<RowMajor3>(R); }
Eigen::Map<const RowMajor3> matrixOf(const double (&R)[9]) { return Eigen::Map<const RowMajor3>(R); }
Eigen::Map<Vector3> vectorOf(double (&a)[3]) { return Eigen::Map<Vector3>(a); }

}  // namespace

void RodElement::setStart(const Pose& X, const Vector3& n, const Vector3& m) {
  vectorOf(state.p_start) = X.p;
  matrixOf(state.R_start) = X.R;
  vectorOf(state.n_start) = n;
  vectorOf(state.m_start) = m;
}

void RodElement::setSection(const RestState& rest) {
  state.shear = rest.c.shear_elongation(0, 0);
  state.elongation = rest.c.shear_elongation(2, 2);
  state.bend_xx = rest.c.bending_torsion(0, 0);
  state.bend_xy = rest.c.bending_torsion(0, 1);
  state.bend_yy = rest.c.bending_torsion(1, 1);
  state.torsion = rest.c.bending_torsion(2, 2);
  vectorOf(state.rest_curvature) = rest.curvature;
}

void RodElement::setLoad(const Vector3& line_load) { vectorOf(state.line_load) = line_load; }

Pose RodElement::X_start() const { return {matrixOf(state.R_start), p_start()}; }

Pose RodElement::X_end() const { return {matrixOf(state.R_end), p_start() + Vector3(state.offset_end)}; }

Vector3 RodElement::g_end(int stages) const { return {state.g[0][stages], state.g[1][stages], state.g[2][stages]}; }

double RodElement::bending(int stages) const {
  if (state.is_arc) return state.length * Vector3(state.rest_curvature).norm();
  return 2.0 * std::atan(0.5 * g_end(stages).norm());
}

bool integrate(const ElementKernel& kernel, bool cold, RodElement& element) {
  if (cold) kernel.reset_guess(element.state);
  return kernel.integrate(element.state);
}

double propagate(const ElementKernel& kernel, double goal, RodElement& element) {
  const double left = kernel.propagate(element.state, true, true, true, goal, false);
  // The moment does not turn with the section.
  ElementTransfer& t = element.state.transfer;
  const Matrix3 turned = -hat(Vector3(element.state.m_start));
  for (auto part : {t.phi, t.p, t.m}) Eigen::Map<Matrix3>(part[kOfRotation]) -= sensitivityMatrix(part, kOfMoment) * turned;
  return left;
}

}  // namespace live_stiffness
