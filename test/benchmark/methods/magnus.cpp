#include "benchmark/methods/magnus.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace live_stiffness {
namespace {

// Gauss-Legendre nodes c, weights b and Runge-Kutta matrix a on [0, 1].
template <int kNodes>
struct Gauss {
  Eigen::Matrix<double, kNodes, kNodes> a;
  Eigen::Matrix<double, kNodes, 1> b, c;
  Gauss();
};

template <>
Gauss<2>::Gauss() {
  const double r = std::sqrt(3.0) / 6.0;
  a << 0.25, 0.25 - r, 0.25 + r, 0.25;
  b << 0.5, 0.5;
  c << 0.5 - r, 0.5 + r;
}

template <>
Gauss<3>::Gauss() {
  const double r = std::sqrt(15.0);
  a << 5.0 / 36, 2.0 / 9 - r / 15, 5.0 / 36 - r / 30,
       5.0 / 36 + r / 24, 2.0 / 9, 5.0 / 36 - r / 24,
       5.0 / 36 + r / 30, 2.0 / 9 + r / 15, 5.0 / 36;
  b << 5.0 / 18, 4.0 / 9, 5.0 / 18;
  c << 0.5 - r / 10, 0.5, 0.5 + r / 10;
}

template <int kNodes>
const Gauss<kNodes>& gauss() {
  static const Gauss<kNodes> table;
  return table;
}

Twist bracket(const Twist& x, const Twist& y) {
  Twist result;
  linear(result) = angular(x).cross(linear(y)) + linear(x).cross(angular(y));
  angular(result) = angular(x).cross(angular(y));
  return result;
}

// Omega with X_end = X_start exp(Omega) for X' = X xi, from h xi at the nodes. The expansions are for Y' = A Y; here
// Y = X^-1 and A = -xi, hence the signs.
Twist omega(const Eigen::Matrix<double, 6, 2>& h_xi) {
  const Twist a1 = -0.5 * (h_xi.col(0) + h_xi.col(1));
  const Twist a2 = std::sqrt(3.0) * (h_xi.col(0) - h_xi.col(1));
  return -a1 + bracket(a1, a2) / 12.0;
}

Twist omega(const Eigen::Matrix<double, 6, 3>& h_xi) {
  const Twist a1 = -h_xi.col(1);
  const Twist a2 = std::sqrt(15.0) / 3.0 * (h_xi.col(0) - h_xi.col(2));
  const Twist a3 = -10.0 / 3.0 * (h_xi.col(2) - 2.0 * h_xi.col(1) + h_xi.col(0));
  const Twist c1 = bracket(a1, a2);
  const Twist c2 = bracket(a1, 2.0 * a3 + c1) / -60.0;
  return -(a1 + a3 / 12.0 + bracket(-20.0 * a1 - a3 + c1, a2 + c2) / 240.0);
}

}  // namespace

template <int kNodes>
Magnus<kNodes>::Magnus(const Scene& scene, int elements)
    : BaseMomentShooting("Magnus " + std::to_string(2 * kNodes) + ", " + std::to_string(elements) + " elements", scene),
      elements_(elements), rotation_(elements * chain().softCount()) {
  forget();
}

template <int kNodes>
void Magnus<kNodes>::forget() {
  for (NodeVectors& rotation : rotation_) rotation(0, 0) = std::numeric_limits<double>::quiet_NaN();
}

// Fixed-point passes for the rotation vectors from the element's start to its nodes.
template <int kNodes>
bool Magnus<kNodes>::step(const SoftPiece& piece, double h, NodeVectors& rotation, RodState& state,
                          Nodes& nodes) const {
  constexpr double kConverged = 1e-12;  // rad
  const Gauss<kNodes>& g = gauss<kNodes>();
  const RodState start = state;
  if (std::isnan(rotation(0, 0))) {
    const Vector3 u = piece.rest.curvature + piece.rest.c.bending_torsion * (start.X.R.transpose() * start.m);
    rotation = h * u * g.c.transpose();
  }
  for (int i = 0; i < kNodes; ++i) nodes.n.col(i) = start.n - g.c[i] * h * piece.line_load;
  NodeVectors m_rate, rotation_rate;
  Eigen::Matrix<double, 6, kNodes> h_xi;
  double change = 1.0;
  for (int pass = 0; pass < 50 && change > kConverged; ++pass) {
    for (int i = 0; i < kNodes; ++i) {
      Matrix3& R = nodes.X[i].R;
      R.noalias() = start.X.R * expSo3(rotation.col(i));
      const Vector3 v = Vector3::UnitZ() + piece.rest.c.shear_elongation * (R.transpose() * nodes.n.col(i));
      nodes.tangent.col(i).noalias() = R * v;
      m_rate.col(i) = nodes.n.col(i).cross(nodes.tangent.col(i));
      h_xi.col(i).template head<3>() = h * v;
    }
    nodes.m.noalias() = h * m_rate * g.a.transpose();
    nodes.m.colwise() += start.m;
    for (int i = 0; i < kNodes; ++i) {
      const Vector3 u =
          piece.rest.curvature + piece.rest.c.bending_torsion * (nodes.X[i].R.transpose() * nodes.m.col(i));
      h_xi.col(i).template tail<3>() = h * u;
      rotation_rate.col(i) = h * bodyRateToVectorRate(rotation.col(i), u);
    }
    const NodeVectors next = rotation_rate * g.a.transpose();
    change = (next - rotation).cwiseAbs().maxCoeff();
    rotation = next;
    if (!(rotation.cwiseAbs().maxCoeff() < 6.0)) {
      rotation(0, 0) = std::numeric_limits<double>::quiet_NaN();
      return false;
    }
  }
  const Twist total = omega(h_xi);
  state.X = start.X * expSe3(linear(total), angular(total), 1.0);
  state.n -= h * piece.line_load;
  state.m += h * m_rate * g.b;
  const NodeVectors p = h * nodes.tangent * g.a.transpose();
  for (int i = 0; i < kNodes; ++i) nodes.X[i].p = start.X.p + p.col(i);
  return change <= kConverged;
}

// Collocation of the linearised rod (see rk4_sensitivities.cpp) at the same nodes, moments eliminated.
template <int kNodes>
void Magnus<kNodes>::carryColumns(const SoftPiece& piece, double h, const Nodes& nodes, RodColumns& columns) const {
  constexpr int kSize = 3 * kNodes;
  const Gauss<kNodes>& g = gauss<kNodes>();
  std::array<Matrix3, kNodes> bend, shear, bend_of_phi, p_of_phi, m_of_phi, m_of_force;
  for (int j = 0; j < kNodes; ++j) {
    const Matrix3& R = nodes.X[j].R;
    const Matrix3 n_hat = hat(nodes.n.col(j)), tangent_hat = hat(nodes.tangent.col(j));
    bend[j] = R * piece.rest.c.bending_torsion * R.transpose();
    shear[j] = R * piece.rest.c.shear_elongation * R.transpose();
    bend_of_phi[j] = bend[j] * hat(nodes.m.col(j));
    p_of_phi[j] = shear[j] * n_hat - tangent_hat;
    m_of_phi[j] = n_hat * p_of_phi[j];
    m_of_force[j] = n_hat * shear[j] - tangent_hat;
  }
  Eigen::Matrix<double, kSize, kSize> lhs;
  Eigen::Matrix<double, kSize, 6> phi;
  for (int i = 0; i < kNodes; ++i) {
    Matrix3 once = Matrix3::Zero();
    for (int j = 0; j < kNodes; ++j) once += h * g.a(i, j) * bend[j];
    phi.template middleRows<3>(3 * i) = columns.phi + once * columns.m;
    for (int k = 0; k < kNodes; ++k) {
      Matrix3 twice = Matrix3::Zero();
      for (int j = 0; j < kNodes; ++j) twice += (h * h * g.a(i, j) * g.a(j, k)) * bend[j];
      phi.template block<3, 3>(3 * i, 3) += twice * m_of_force[k];
      lhs.template block<3, 3>(3 * i, 3 * k) = -h * g.a(i, k) * bend_of_phi[k] - twice * m_of_phi[k];
    }
    lhs.template block<3, 3>(3 * i, 3 * i) += Matrix3::Identity();
  }
  phi = lhs.partialPivLu().solve(phi).eval();

  std::array<Matrix3X6, kNodes> m_rate;
  for (int j = 0; j < kNodes; ++j) {
    m_rate[j] = m_of_phi[j] * phi.template middleRows<3>(3 * j);
    m_rate[j].template rightCols<3>() += m_of_force[j];
  }
  for (int i = 0; i < kNodes; ++i) {
    Matrix3X6 m = columns.m;
    for (int j = 0; j < kNodes; ++j) m += h * g.a(i, j) * m_rate[j];
    const Matrix3X6 phi_i = phi.template middleRows<3>(3 * i);
    columns.phi += h * g.b[i] * (bend_of_phi[i] * phi_i + bend[i] * m);
    columns.p += h * g.b[i] * (p_of_phi[i] * phi_i);
    columns.p.template rightCols<3>() += h * g.b[i] * shear[i];
  }
  for (int j = 0; j < kNodes; ++j) columns.m += h * g.b[j] * m_rate[j];
}

template <int kNodes>
bool Magnus<kNodes>::integrate(int index, const SoftPiece& piece, RodState& state) {
  Nodes nodes;
  for (int k = 0; k < elements_; ++k)
    if (!step(piece, piece.length / elements_, rotation_[index * elements_ + k], state, nodes)) return false;
  return true;
}

template <int kNodes>
bool Magnus<kNodes>::integrate(int index, const SoftPiece& piece, RodState& state, RodColumns& columns,
                               MaterialSum& sum) {
  const double h = piece.length / elements_;
  Nodes nodes;
  for (int k = 0; k < elements_; ++k) {
    if (!step(piece, h, rotation_[index * elements_ + k], state, nodes)) return false;
    carryColumns(piece, h, nodes, columns);
    for (int i = 0; i < kNodes; ++i) sum.add(nodes.X[i], piece.rest.c, h * gauss<kNodes>().b[i]);
  }
  return true;
}

template class Magnus<2>;
template class Magnus<3>;

}  // namespace live_stiffness
