#include "live_stiffness/rod/rod_element.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace live_stiffness {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Map<RowMajor3> matrixOf(double (&R)[9]) { return Eigen::Map<RowMajor3>(R); }
Eigen::Map<const RowMajor3> matrixOf(const double (&R)[9]) { return Eigen::Map<const RowMajor3>(R); }
Eigen::Map<Vector3> vectorOf(double (&a)[3]) { return Eigen::Map<Vector3>(a); }

}  // namespace

void RodElement::setStart(const Pose& X, const Vector3& n, const Vector3& m) {
  p_start = X.p;
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

void RodElement::setLoads(const Vector3& line_load, const Vector3& follower_load) {
  vectorOf(state.line_load) = line_load;
  vectorOf(state.follower_load) = follower_load;
  state.follows = !follower_load.isZero(0.0);
}

Pose RodElement::X_start() const { return {matrixOf(state.R_start), p_start}; }

Pose RodElement::X_end() const { return {matrixOf(state.R_end), p_start + Vector3(state.offset_end)}; }

Pose RodElement::X(int node) const {
  Pose X;
  for (int i = 0; i < 9; ++i) X.R(i / 3, i % 3) = state.R[i][node];
  for (int i = 0; i < 3; ++i) X.p[i] = p_start[i] + state.offset[i][node];
  return X;
}

double RodElement::bending(int stages) const { return 2.0 * std::atan(0.5 * Vector3(state.g[0][stages], state.g[1][stages], state.g[2][stages]).norm()); }

void resetGuess(RodElement& e) {
  const Eigen::Map<const Vector3> m(e.state.m_start), rest(e.state.rest_curvature);
  const Vector3 m_body = matrixOf(e.state.R_start).transpose() * m;
  const Vector3 u(rest.x() + e.state.bend_xx * m_body.x() + e.state.bend_xy * m_body.y(),
                  rest.y() + e.state.bend_xy * m_body.x() + e.state.bend_yy * m_body.y(),
                  rest.z() + e.state.torsion * m_body.z());
  const GaussLegendre& table = gaussLegendre(kMaxStages);  // a guess: the nodes of fewer stages are near enough
  const double quarter = 0.25 * (e.state.length * u).squaredNorm();
  for (int i = 0; i <= kMaxStages; ++i) {
    const double s = e.state.length * table.c[i];
    const double grown = 1.0 + table.c[i] * table.c[i] * std::min(quarter, 1.0) / 3.0;  // 2 tan(x / 2) from x
    for (int k = 0; k < 3; ++k) e.state.g[k][i] = s * grown * u[k];
  }
}

double largestSize(int stages) { return 2.0 * std::sqrt(stages + 1.0); }

bool integrate(const ElementPasses& passes, RodElement& e) {
  constexpr int kMaxPasses = 80;
  constexpr double kConverged = 2e-15;  // rad, relative to 1 + |g|
  double last_change = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    passes.finish(e.state);
    const double change = e.state.change, goal = kConverged * (1.0 + e.state.size);
    if (!(e.state.size <= largestSize(passes.stages))) return false;  // NaN, or near the singularity at half a turn
    // Rounding can leave a last-digit wobble just above the bound: stop there once it no longer shrinks.
    if (change <= goal || (change <= 20.0 * goal && change >= last_change)) return true;
    last_change = change;
  }
  return false;
}

void resetColumns(const ElementColumns& start, ElementState& state) {
  for (int k = 0; k < 6; ++k)
    for (int i = 0; i < 3; ++i) std::fill_n(state.phi[k][i], kMaxStages + 1, start.phi[k][i]);
}

double propagate(const ElementPasses& passes, RodElement& e, const ElementColumns& start, double goal,
                 ElementColumns& end) {
  constexpr int kMaxPasses = 60;
  passes.linearise(e.state);
  std::copy_n(&start.phi[0][0], 18, &e.state.phi_start[0][0]);
  double last_change = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    passes.column_pass(e.state, start);
    const double change = e.state.column_change;
    // What is left after a pass is about its change times the rate at which changes shrink.
    const double left = change * (pass == 0 ? 0.2 : std::min(0.2, change / last_change));
    if (left <= goal || (change <= 1e-13 && change >= last_change)) {
      passes.column_end(e.state, start, end);
      return left;
    }
    if (!std::isfinite(change)) break;
    last_change = change;
  }
  resetColumns(start, e.state);
  return std::numeric_limits<double>::infinity();
}

}  // namespace live_stiffness
