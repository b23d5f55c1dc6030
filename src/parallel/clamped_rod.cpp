#include "parallel/clamped_rod.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "compliance/material_compliance.h"
#include "section/section_moments.h"

namespace live_stiffness {
namespace {

// At a coarser accuracy elements of five stages are chosen, and a third more of them, which is slower than seven at 1e-7.
constexpr double kCoarsest = 1e-7;

Scene sceneOf(const ParallelRod& rod) {
  Scene scene;
  Segment segment;
  segment.length = 1.0;
  segment.section = rod.section;
  scene.chain.push_back(segment);
  return scene;
}

using Columns = Eigen::Map<const Eigen::Matrix<double, 3, kColumns>>;

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
  Eigen::Matrix<double, kColumns, 1> start = Eigen::Matrix<double, kColumns, 1>::Zero();
  start.segment<3>(kOfMoment) = change.tail<3>();
  start.segment<3>(kOfForce) = change.head<3>();
  for (RodElement& element : backbone_.elements) {
    double by[kColumns];
    std::copy_n(start.data(), kColumns, by);
    backbone_.kernel->follow(element.state, by);
    if (&element == &backbone_.elements.back()) break;
    const int used = &element == &backbone_.elements.front() ? kOfRotation : kColumns;
    const Vector3 phi = Columns(element.state.transfer.phi[0]).leftCols(used) * start.head(used);
    start.segment<3>(kOfMoment) = Columns(element.state.transfer.m[0]).leftCols(used) * start.head(used);
    start.segment<3>(kOfRotation) = phi;
  }
}

void ClampedRod::placeStraight() {
  load_.setZero();
  forgetShape();
}

void ClampedRod::forgetShape() {
  nodes_hold_guess_ = has_sensitivities_ = false;
  prepare(chain_, loads(), backbone_);
}

MarchResult ClampedRod::iterateOnce() {
  const MarchMode mode = nodes_hold_guess_ ? MarchMode::kIterate : MarchMode::kCold;
  const MarchResult result = march(chain_, loads(), load_.tail<3>(), mode, backbone_);
  end_moment_ = Vector3(result.residual);
  nodes_hold_guess_ = result.is_admissible;
  return result;
}

bool ClampedRod::integrate() {
  nodes_hold_guess_ = shoot(chain_, loads(), load_.tail<3>(), nodes_hold_guess_, backbone_, end_moment_) ||
                      shoot(chain_, loads(), load_.tail<3>(), false, backbone_, end_moment_);
  return nodes_hold_guess_;
}

double ClampedRod::linearise(double goal) {
  const ChainState chain = stateOf(chain_, loads(), load_.tail<3>(), backbone_);
  // Each element's sensitivities are judged by their own size, which is smaller than that of the whole rod's.
  constexpr double kOfElement = 4.0;
  Linearisation how{kOfElement * goal};
  how.cold = !has_sensitivities_;
  how.with_force = how.clamped = true;
  const auto [left, unstable] = backbone_.kernel->linearise(chain, how);
  has_sensitivities_ = std::isfinite(left);
  if (!has_sensitivities_) return left;
  unstable_ = unstable;
  truncation_ = discretisation_.truncation(backbone_);
  // From base to end, by base moment and force.
  Eigen::Matrix<double, kColumns, 6> start = Eigen::Matrix<double, kColumns, 6>::Zero();
  start.topRows<6>().setIdentity();
  Matrix3X6 phi, p = Matrix3X6::Zero(), m;
  for (const RodElement& element : backbone_.elements) {
    const int used = &element == &backbone_.elements.front() ? kOfRotation : kColumns;
    const ElementTransfer& t = element.state.transfer;
    phi.noalias() = Columns(t.phi[0]).leftCols(used) * start.topRows(used);
    p.noalias() += Columns(t.p[0]).leftCols(used) * start.topRows(used);
    m.noalias() = Columns(t.m[0]).leftCols(used) * start.topRows(used);
    start.topRows<3>() = m;
    start.bottomRows<3>() = phi;
  }
  // Derivative of the end pose by the load, in units that make all entries similar: L for lengths, 1 rad of bending for moments.
  const double L = length(), moment = 1.0 / (bending_compliance_ * L), force = moment / L;
  const Vector6 of_load = (Vector6() << Vector3::Constant(force), Vector3::Constant(moment)).finished();
  const Vector6 of_end = (Vector6() << Vector3::Constant(1.0 / L), Vector3::Ones()).finished();
  Matrix6 end_of_load;
  end_of_load << p.rightCols<3>(), p.leftCols<3>(), phi.rightCols<3>(), phi.leftCols<3>();
  const Matrix6 scaled = of_end.asDiagonal() * end_of_load * of_load.asDiagonal(), inverse = scaled.inverse();
  const Matrix6 load_of_end = of_load.asDiagonal() * inverse * of_end.asDiagonal();
  Matrix6 stiffness;
  stiffness.topRows<3>() = load_of_end.topRows<3>();
  stiffness.bottomRows<3>().noalias() =
      m.rightCols<3>() * load_of_end.topRows<3>() + m.leftCols<3>() * load_of_end.bottomRows<3>();
  const Matrix3& R = X_BD_.R;
  stiffness_ = complianceInBodyAxes(stiffness, R.transpose());
  load_of_twist_.leftCols<3>().noalias() = load_of_end.leftCols<3>() * R.transpose();
  load_of_twist_.rightCols<3>().noalias() = load_of_end.rightCols<3>() * R.transpose();

  // The weight of a longer rod acts on more length, and the rod continues beyond its old end.
  const Matrix3& R_end = backbone_.X_BT.R;
  const Vector3 f = load_.head<3>(), weight = linear_density_ * gravity_;
  const Vector3 tangent = R_end * (Vector3::UnitZ() + backbone_.rest[0].c.shear_elongation * (R_end.transpose() * f));
  const Vector3 turn = R_end * (backbone_.rest[0].c.bending_torsion * (R_end.transpose() * end_moment_));
  linear(twist_of_length_) = R * (p.rightCols<3>() * weight + tangent);
  angular(twist_of_length_) = R * (phi.rightCols<3>() * weight + turn);
  wrench_of_length_ = -stiffness_ * twist_of_length_;
  angular(wrench_of_length_) += R * (m.rightCols<3>() * weight - tangent.cross(f));
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
  discretisation_.apply(backbone_);
  forgetShape();
  return true;
}

bool ClampedRod::refine(double buckling_factor) {
  const double excess = buckling_factor * truncation_ / accuracy_;
  if (!(excess > 1.0)) return false;
  const int stages = backbone_.kernel->stages, count = backbone_.element_count[0];
  const double growth = std::min(2.0, std::pow(2.0 * excess, 0.5 / stages));  // the error is of order 2 stages
  const int wanted = std::max(count + 1, static_cast<int>(std::ceil(count * growth)));
  if (count == Backbone::kMaxElements) return false;
  backbone_.element_count[0] = std::min(Backbone::kMaxElements, wanted);
  backbone_.resize(backbone_.element_count, stages);
  forgetShape();
  return true;
}

Wrench ClampedRod::endWrench() const {
  return (Wrench() << X_BD_.R * load_.head<3>(), X_BD_.R * end_moment_).finished();
}

Wrench ClampedRod::baseWrench() const {
  return (Wrench() << X_BD_.R * loads().baseForce(chain_), X_BD_.R * load_.tail<3>()).finished();
}

Matrix6 ClampedRod::materialCompliance(double accuracy) {
  Matrix6 compliance;
  accumulateMaterial(chain_, accuracy, backbone_, compliance);
  return complianceInBodyAxes(compliance, X_BD_.R.transpose());
}

double ClampedRod::bendingOf(const Vector6& load) const {
  return bending_compliance_ * length() * std::max(length() * load.head<3>().norm(), load.tail<3>().norm());
}

// Clamping the position of an end that cannot turn removes as many directions in which the rod is not stable as the
// compliance of that position, with clamped rotation, has negative eigenvalues.
bool ClampedRod::isStableClamped() const {
  Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
  eigen.computeDirect(stiffness_.topLeftCorner<3, 3>(), Eigen::EigenvaluesOnly);
  return unstable_ == 3 - (eigen.eigenvalues().array() > 0.0).count();
}

}  // namespace live_stiffness
