#include "parallel/clamped_rod.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "compliance/material_compliance.h"
#include "rod/conjugate_points.h"
#include "section/section_moments.h"

namespace live_stiffness {
namespace {

// Rods under end loads need so many elements of three stages that elements of five stages are faster at any accuracy.
constexpr double kCoarsest = 1e-7;

Scene sceneOf(const ParallelRod& rod) {
  Scene scene;
  Segment segment;
  segment.length = 1.0;
  segment.section = rod.section;
  scene.chain.push_back(segment);
  return scene;
}

// [f; m] or [v; w], both parts turned.
Matrix6 turned(const Matrix6& M, const Matrix3& R) {
  Matrix6 result;
  for (int i = 0; i < 6; i += 3)
    for (int j = 0; j < 6; j += 3)
      result.block<3, 3>(i, j).noalias() = R * M.block<3, 3>(i, j) * R.transpose();
  return result;
}

// Moves the guess g along with changes of base moment and end force, by the stored sensitivities: see ElementKernel::follow.
// Works on copies, which the compiler can vectorise.
void follow(ElementState& e, const double (&change)[6]) {
  constexpr int kRow = kMaxStages + 1;
  StageRow turn[3], g[3];
  double R[9];
  std::copy_n(e.R_start, 9, R);
  std::copy_n(&e.g[0][0], 3 * kRow, &g[0][0]);
  for (int i = 0; i < 3; ++i) {
    double start = 0.0;
    for (int k = 0; k < 6; ++k) start += change[k] * e.phi_start[k][i];
    for (int v = 0; v < kRow; ++v)
      turn[i][v] = change[0] * e.phi[0][i][v] + change[1] * e.phi[1][i][v] + change[2] * e.phi[2][i][v] +
                   change[3] * e.phi[3][i][v] + change[4] * e.phi[4][i][v] + change[5] * e.phi[5][i][v] - start;
  }
  for (int v = 0; v < kRow; ++v) {
    const double x = R[0] * turn[0][v] + R[3] * turn[1][v] + R[6] * turn[2][v];
    const double y = R[1] * turn[0][v] + R[4] * turn[1][v] + R[7] * turn[2][v];
    const double z = R[2] * turn[0][v] + R[5] * turn[1][v] + R[8] * turn[2][v];
    const double gx = g[0][v], gy = g[1][v], gz = g[2][v], half = 0.5 * (gx * x + gy * y + gz * z);
    g[0][v] = gx + x - 0.5 * (gy * z - gz * y - half * gx);
    g[1][v] = gy + y - 0.5 * (gz * x - gx * z - half * gy);
    g[2][v] = gz + z - 0.5 * (gx * y - gy * x - half * gz);
  }
  std::copy_n(&g[0][0], 3 * kRow, &e.g[0][0]);
}

}  // namespace

ClampedRod::ClampedRod(const ParallelRod& rod, const Vector3& gravity, double accuracy, Simd simd)
    : X_BD_(rod.X_BD),
      gravity_(rod.X_BD.R.transpose() * gravity),
      linear_density_(rod.section.linearDensity()),
      accuracy_(std::min(accuracy, kCoarsest)),
      scene_(sceneOf(rod)),
      chain_(scene_),
      backbone_(scene_, simd),
      discretisation_(chain_, accuracy_, 0) {
  backbone_.rest[0].c = SectionMoments(rod.section).complianceDensity(1.0);
  bending_compliance_ = backbone_.rest[0].c.bending_torsion.diagonal().maxCoeff();
  choose();
}

void ClampedRod::setLength(double length) {
  const double growth = length / chain_.parts[0].length;
  chain_.parts[0].length = length;
  chain_.parts[0].mass = chain_.mass = linear_density_ * length;
  prepare(chain_, loads(), backbone_);
  for (RodElement& element : backbone_.elements)
    for (StageRow& row : element.state.g)
      for (double& g : row) g *= growth;
}

void ClampedRod::changeLoad(const Vector6& change) {
  load_ += change;
  if (!has_sensitivities_) return;
  const double by[6] = {change[3], change[4], change[5], change[0], change[1], change[2]};  // columns: moment first
  for (RodElement& element : backbone_.elements) follow(element.state, by);
}

void ClampedRod::placeStraight() {
  load_.setZero();
  nodes_hold_guess_ = has_sensitivities_ = false;
}

Sweep ClampedRod::sweepOnce() {
  // The end is known only after SweepMode::kFinish.
  const SweepMode mode = nodes_hold_guess_ ? SweepMode::kFinish : SweepMode::kCold;
  const Sweep result = sweep(chain_, loads(), load_.tail<3>(), mode, backbone_);
  end_moment_ = result.residual;
  nodes_hold_guess_ = result.is_admissible;
  return result;
}

bool ClampedRod::integrate() {
  nodes_hold_guess_ = shoot(chain_, loads(), load_.tail<3>(), nodes_hold_guess_, backbone_, end_moment_) ||
                      shoot(chain_, loads(), load_.tail<3>(), false, backbone_, end_moment_);
  return nodes_hold_guess_;
}

double ClampedRod::linearise(double goal) {
  ElementSensitivities tip;
  const double left = tipSensitivities(chain_, loads(), !has_sensitivities_, goal, backbone_, tip);
  has_sensitivities_ = std::isfinite(left);
  if (!has_sensitivities_) return left;
  truncation_ = discretisation_.truncation(1.0, backbone_);
  const auto phi = sensitivityMatrix(tip.phi), p = sensitivityMatrix(tip.p), m = sensitivityMatrix(tip.m);
  // Derivative of the end pose by the load, in units that make all entries similar: L for lengths, 1 rad of bending for moments.
  const double L = length(), moment = 1.0 / (bending_compliance_ * L), force = moment / L;
  Matrix6 end_of_load;
  end_of_load.topLeftCorner<3, 3>() = (force / L) * p.rightCols<3>();
  end_of_load.topRightCorner<3, 3>() = (moment / L) * p.leftCols<3>();
  end_of_load.bottomLeftCorner<3, 3>() = force * phi.rightCols<3>();
  end_of_load.bottomRightCorner<3, 3>() = moment * phi.leftCols<3>();
  Matrix6 load_of_end = end_of_load.inverse();
  load_of_end.topRows<3>() *= force;
  load_of_end.bottomRows<3>() *= moment;
  load_of_end.leftCols<3>() *= 1.0 / L;
  Matrix6 stiffness;
  stiffness.topRows<3>() = load_of_end.topRows<3>();
  stiffness.bottomRows<3>().noalias() =
      m.rightCols<3>() * load_of_end.topRows<3>() + m.leftCols<3>() * load_of_end.bottomRows<3>();
  const Matrix3& R = X_BD_.R;
  stiffness_ = turned(stiffness, R);
  load_of_twist_.leftCols<3>().noalias() = load_of_end.leftCols<3>() * R.transpose();
  load_of_twist_.rightCols<3>().noalias() = load_of_end.rightCols<3>() * R.transpose();

  // The weight of a longer rod acts on more length, and the rod continues beyond its old end.
  const Matrix3& R_end = backbone_.X_BT.R;
  const Vector3 f = load_.head<3>(), weight = linear_density_ * gravity_;
  const Vector3 tangent = R_end * (Vector3::UnitZ() + backbone_.rest[0].c.shear_elongation * (R_end.transpose() * f));
  const Vector3 turn = R_end * (backbone_.rest[0].c.bending_torsion * (R_end.transpose() * end_moment_));
  linear(twist_of_length_) = R * (p.rightCols<3>() * weight + tangent);
  angular(twist_of_length_) = R * (phi.rightCols<3>() * weight + turn);
  linear(wrench_of_length_).setZero();
  angular(wrench_of_length_) = R * (m.rightCols<3>() * weight - tangent.cross(f));
  return stiffness_.allFinite() ? left : kInfinity;
}

bool ClampedRod::refineForLoad() {
  constexpr double kMostAnElement = 1.6;  // of L sqrt(|n| c_bt); from pi on it would be unstable, even with both ends clamped
  const double normalised_load = length() * std::sqrt(bending_compliance_ * load_.head<3>().norm());
  return normalised_load > kMostAnElement * backbone_.element_count[0] && choose();
}

bool ClampedRod::choose() {
  DeadLoads now = loads();
  angular(now.tip) = Vector3::UnitX() * std::max(load_.tail<3>().norm(), end_moment_.norm());
  if (!discretisation_.choose(now, backbone_)) return false;
  nodes_hold_guess_ = has_sensitivities_ = false;
  prepare(chain_, loads(), backbone_);
  return true;
}

bool ClampedRod::refine(double buckling_factor) {
  const double excess = buckling_factor * truncation_ / accuracy_;
  if (!(excess > 1.0)) return false;
  const int stages = backbone_.kernel->stages, count = backbone_.element_count[0];
  const double growth = std::min(2.0, std::pow(2.0 * excess, 0.5 / stages));  // the error is of order 2 stages
  const int wanted = std::max(count + 1, static_cast<int>(std::ceil(count * growth)));
  backbone_.element_count[0] = std::min(Backbone::kMaxElements, wanted);
  if (!backbone_.resize(stages)) return false;
  nodes_hold_guess_ = has_sensitivities_ = false;
  prepare(chain_, loads(), backbone_);
  return true;
}

Wrench ClampedRod::endWrench() const {
  Wrench wrench;
  linear(wrench) = X_BD_.R * load_.head<3>();
  angular(wrench) = X_BD_.R * end_moment_;
  return wrench;
}

Wrench ClampedRod::baseWrench() const {
  Wrench wrench;
  linear(wrench) = X_BD_.R * loads().baseForce(chain_);
  angular(wrench) = X_BD_.R * load_.tail<3>();
  return wrench;
}

Matrix6 ClampedRod::materialCompliance(double accuracy) {
  Matrix6 compliance;
  accumulateMaterial(chain_, accuracy, backbone_, compliance);
  return turned(compliance, X_BD_.R);
}

double ClampedRod::bendingOf(const Vector6& load) const {
  return bending_compliance_ * length() * std::max(length() * load.head<3>().norm(), load.tail<3>().norm());
}

// For rotations phi(s) with phi = 0 at both ends, and a free position of the end, the second variation has as many negative
// directions as there are conjugate points (see rod/conjugate_points.h). Clamping the position as well removes as many of
// them as the compliance of that position, with clamped rotation, has negative eigenvalues.
bool ClampedRod::isStableClamped() const {
  return conjugatePoints(backbone_) == negativeEigenvalues(stiffness_.topLeftCorner<3, 3>());
}

}  // namespace live_stiffness
