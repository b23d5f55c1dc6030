#include "rod/energy_descent.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lie/cayley.h"

namespace live_stiffness {
namespace {

constexpr int kMostSteps = 300, kMostHalvings = 12;
constexpr double kLongestStep = 0.7;     // rad a node
constexpr double kConverged = 1e-2;      // rad; less than what the distance of the nodes leaves
constexpr double kFollowed = 0.1;        // rad; on the way to the full loads
constexpr double kNearlyNeutral = 0.1;   // least pivot below which it is found out whether it is zero
constexpr double kFullyConverged = 1e-9;  // rad; by then the pivot is known to kNeutral
constexpr double kNeutral = 1e-7, kRounding = 1e-10;  // eigenvalues of a pivot by its largest: as good as zero, and zero
constexpr double kPush = 0.3;  // rad, off an equilibrium that is not stable

// Derivative of the Cayley vector c of A^T B by a small turn of B, in axes of B; of A it is minus the transpose.
Matrix3 derivativeOfCayley(const Vector3& c) { return Matrix3::Identity() + 0.5 * hat(c) + 0.25 * c * c.transpose(); }

Matrix3 symmetric(const Vector3& a, const Vector3& b) { return a * b.transpose() + b * a.transpose(); }

}  // namespace

EnergyDescent::EnergyDescent(const Chain& chain) : chain_(chain) {
  const size_t most = NodalRotations(chain).R.capacity();
  nodes_.reserve(most);
  trial_.reserve(most);
}

void EnergyDescent::prepare(const DeadLoads& loads, const std::vector<RestState>& rest, const NodalRotations& shape) {
  nodes_.resize(shape.R.size());
  trial_.resize(shape.R.size());
  for (Node& node : nodes_) node.load.setZero(), node.softening = 0.0;
  auto node = nodes_.begin();
  Vector3 n = loads.baseForce(chain_);
  // Half an interval, or a link, on the axis of a node.
  const auto add = [](Node& to, double length, const Vector3& force, double softening) {
    to.load += length * force;
    to.softening += length * softening * force.squaredNorm();
  };
  for (const Chain::Part& part : chain_.parts) {
    const Vector3 weight = part.mass * loads.gravity;
    if (part.segment < 0) {
      add(*node, part.length, n - 0.5 * weight, 0.0);
      n -= weight;
      continue;
    }
    const RestState& state = rest[part.segment];
    const int count = shape.intervals[part.segment];
    const double h = state.stretch * part.length / count;
    const double softening = state.c.shear_elongation(2, 2) - state.c.shear_elongation(0, 0);
    const Matrix3 stiffness = state.c.bending_torsion.inverse() / h;
    const Vector3 turn = h * state.curvature;
    const double angle = turn.norm();
    const Vector3 at_rest = angle > 1e-8 ? Vector3(2.0 * std::tan(0.5 * std::min(angle, 3.0)) / angle * turn) : turn;
    for (int i = 0; i < count; ++i) {
      add(*node, 0.5 * h, n, softening);
      n -= weight / count;
      ++node;
      add(*node, 0.5 * h, n, softening);
      node->stiffness = stiffness;
      node->rest = at_rest;
    }
  }
  for (Node& at : nodes_) {
    const double square = at.load.squaredNorm();
    at.softening = square > 0.0 ? at.softening / square : 0.0;
  }
  tip_force_ = n;
}

double EnergyDescent::energy(const std::vector<Matrix3>& R) const {
  double sum = -share_ * tip_force_.dot(R.back() * chain_.tip_offset);
  for (size_t i = 0; i < R.size(); ++i) {
    const Node& node = nodes_[i];
    const double x = share_ * node.load.dot(R[i].col(2));
    sum -= x * (1.0 + 0.5 * node.softening * x);
    if (i == 0) continue;
    const Vector3 strain = cayleyVector(R[i - 1].transpose() * R[i]) - node.rest;
    sum += 0.5 * strain.dot(node.stiffness * strain);
  }
  return sum;
}

// Gradient and Hessian by small turns of the nodes, each in axes of its node, as Cayley vectors.
void EnergyDescent::differentiate(const std::vector<Matrix3>& R, const Vector3& tip_moment) {
  for (size_t i = 0; i < R.size(); ++i) {
    Node& node = nodes_[i];
    const Vector3 b = share_ * R[i].transpose() * node.load, across(-b.y(), b.x(), 0.0);  // e3 x b
    const double slope = 1.0 + node.softening * b.z();
    node.gradient = -slope * across;
    node.diagonal = -slope * (0.5 * symmetric(b, Vector3::UnitZ()) - b.z() * Matrix3::Identity()) -
                    node.softening * across * across.transpose();
    if (i == 0) continue;
    // With m the derivative of the energy by c: second derivatives of c itself count, too.
    const Vector3 c = cayleyVector(R[i - 1].transpose() * R[i]), m = node.stiffness * (c - node.rest);
    const Matrix3 J = derivativeOfCayley(c), KJ = node.stiffness * J;
    const Vector3 twisted = 0.5 * m.cross(c);
    const Matrix3 cc = 0.125 * m.dot(c) * c * c.transpose();
    Node& before = nodes_[i - 1];
    node.gradient += J.transpose() * m;
    before.gradient -= J * m;
    node.diagonal += J.transpose() * KJ + 0.25 * symmetric(c, m + twisted) + cc;
    before.diagonal += J * node.stiffness * J.transpose() + 0.25 * symmetric(c, m - twisted) + cc;
    const Matrix3 crossed = 0.5 * hat(m) + 0.25 * c * m.transpose() + 0.25 * m.dot(c) * Matrix3::Identity();
    before.next = -J * KJ - J * crossed.transpose();
  }
  const Vector3 b = share_ * R.back().transpose() * tip_force_, &o = chain_.tip_offset;
  const Vector3 m = R.back().transpose() * tip_moment;
  nodes_.back().gradient -= o.cross(b) + m;
  nodes_.back().diagonal -= 0.5 * symmetric(b, o) - b.dot(o) * Matrix3::Identity() + 0.5 * hat(m);
}

// Block factorisation from the tip, and Newton's step. A pivot whose symmetric part is not positive definite gets the
// absolute values of its eigenvalues, so that the step goes downhill. Returns false if there was one; then the step is also
// pushed along it.
bool EnergyDescent::factorise() {
  bool positive = true;
  const size_t last = nodes_.size() - 1;
  for (size_t i = last; i > 0; --i) {
    Node& node = nodes_[i];
    Matrix3 pivot = node.diagonal;
    Vector3 right = -node.gradient;
    if (i < last) {
      const Matrix3 carried = node.next * nodes_[i + 1].pivot_inverse;
      pivot -= carried * node.next.transpose();
      right -= carried * nodes_[i + 1].step;
    }
    node.step = right;
    const Matrix3 even = 0.5 * (pivot + pivot.transpose());  // a dead moment adds an odd part
    const bool fine = even(0, 0) > 0.0 && even(0, 0) * even(1, 1) > even(0, 1) * even(0, 1) && even.determinant() > 0.0;
    node.pivot_inverse = pivot.inverse();
    if (fine && i > 1) continue;
    Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
    eigen.computeDirect(even);
    const Vector3 values = eigen.eigenvalues();
    const double largest = values.cwiseAbs().maxCoeff();
    if (i == 1) least_pivot_ = values[0] / largest;
    if (values[0] > kRounding * largest) continue;
    const Vector3 used = values.cwiseAbs();
    const auto is_zero = used.array() < kRounding * largest;  // there the energy does not change
    const Vector3 inverse = is_zero.select(0.0, used.cwiseInverse());
    node.pivot_inverse = eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
    if (values[0] > -kRounding * largest) continue;
    // Small where the gradient already says which way to fall.
    const Vector3 down = eigen.eigenvectors().col(0);
    const double wanted = down.dot(right) / used[0];
    if (positive && std::abs(wanted) < kPush) node.step += (std::copysign(kPush, wanted) - wanted) * used[0] * down;
    positive = false;
  }
  Vector3 before = Vector3::Zero();
  for (size_t i = 1; i <= last; ++i) {
    Node& node = nodes_[i];
    if (i > 1) node.step -= nodes_[i - 1].next.transpose() * before;
    node.step = node.pivot_inverse * node.step;
    before = node.step;
  }
  return positive;
}

EnergyDescent::Step EnergyDescent::step(const Vector3& tip_moment, NodalRotations& shape) {
  differentiate(shape.R, tip_moment);
  const bool positive = factorise();
  double longest = 0.0, slope = 0.0;
  for (size_t i = 1; i < nodes_.size(); ++i) {
    longest = std::max(longest, nodes_[i].step.norm());
    slope += nodes_[i].gradient.dot(nodes_[i].step);
  }
  constexpr double kTooSmall = 1e-3;  // rad; the energy cannot tell
  const double now = energy(shape.R);
  double share = std::min(1.0, kLongestStep / longest);
  for (int halving = 0; halving < kMostHalvings; ++halving, share *= 0.5) {
    trial_[0] = shape.R[0];
    for (size_t i = 1; i < nodes_.size(); ++i) trial_[i] = shape.R[i] * cayleyRotation(share * nodes_[i].step);
    const Vector3& turn = nodes_.back().step;  // about one axis, by less than its Cayley vector
    const double angle = 2.0 * std::atan(0.5 * share * turn.norm());
    const double work = tip_moment.isZero(0.0) ? 0.0 : angle * tip_moment.dot(shape.R.back() * turn.normalized());
    if (share * longest < kTooSmall || energy(trial_) - work - now <= 1e-4 * share * slope) break;
  }
  shape.R.swap(trial_);
  return {longest, !positive};
}

EnergyDescent::End EnergyDescent::run(const DeadLoads& loads, const std::vector<RestState>& rest, double first_share,
                                      NodalRotations& shape) {
  prepare(loads, rest, shape);
  share_ = std::min(1.0, first_share);
  for (int i = 0; i < kMostSteps; ++i) {
    const Step made = step(share_ * angular(loads.tip), shape);
    if (!std::isfinite(made.longest)) break;
    if (share_ < 1.0) {
      if (!made.downhill && made.longest < kFollowed) share_ = std::min(1.0, 2.0 * share_);
      continue;
    }
    if (made.downhill) continue;
    if (made.longest < kConverged && least_pivot_ >= kNearlyNeutral) return End::kMinimum;
    if (made.longest < kFullyConverged) return least_pivot_ < kNeutral ? End::kNeutral : End::kMinimum;
  }
  return End::kNotConverged;
}

}  // namespace live_stiffness
