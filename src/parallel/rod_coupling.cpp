#include "parallel/rod_coupling.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace live_stiffness {
namespace {

// From a twist of P to the twist of the point at `lever` from it.
Twist atLever(const Twist& twist, const Vector3& lever) {
  Twist result = twist;
  linear(result) += angular(twist).cross(lever);
  return result;
}

// From a wrench at `lever` from P to the same wrench about P.
Wrench aboutP(const Wrench& wrench, const Vector3& lever) {
  Wrench result = wrench;
  angular(result) += lever.cross(linear(wrench));
  return result;
}

}  // namespace

RodCoupling::RodCoupling(const ParallelScene& scene, double accuracy, Simd simd) : scene_(scene) {
  const size_t count = scene.rods.size();
  const Vector3 gravity = scene.gravity.value_or(Vector3::Zero());
  for (const ParallelRod& rod : scene.rods) rods_.emplace_back(rod, gravity, accuracy, simd);
  straight_lengths_.assign(count, 1.0);
  errors_.assign(count, Twist::Zero());
  load_step_.assign(count, Vector6::Zero());
  length_step_.assign(count, 0.0);
  for (Snapshot& snapshot : snapshots_) snapshot.rods.resize(count);
}

void RodCoupling::placeStraight(const std::vector<double>& lengths) {
  for (size_t i = 0; i < rods_.size(); ++i) {
    straight_lengths_[i] = lengths[i];
    rods_[i].placeStraight();
    rods_[i].setLength(lengths[i]);
  }
}

Pose RodCoupling::targetOf(size_t i) const {
  const Pose place = X_BP * scene_.rods[i].X_PE;
  if (homotopy >= 1.0) return place;
  const Pose straight = scene_.rods[i].X_BD * Pose{Matrix3::Identity(), straight_lengths_[i] * Vector3::UnitZ()};
  return {expSo3(homotopy * logSo3(place.R * straight.R.transpose())) * straight.R,
          straight.p + homotopy * (place.p - straight.p)};
}

bool RodCoupling::integrateAll() {
  for (ClampedRod& rod : rods_)
    if (!rod.integrate()) return false;
  return true;
}

bool RodCoupling::changesAny(bool (ClampedRod::*change)()) {
  bool changed = false;
  for (ClampedRod& rod : rods_) changed = (rod.*change)() || changed;
  return changed;
}

double RodCoupling::sweepAll() {
  double change = 0.0;
  for (ClampedRod& rod : rods_) {
    const MarchResult march = rod.iterateOnce();
    if (!march.is_admissible) return kInfinity;
    change = std::max(change, march.change);
  }
  return change;
}

// sum += H^T K H.
void RodCoupling::addStiffness(size_t i, const Matrix6& K, Matrix6& sum) const {
  const Matrix3 lever_hat = hat(leverOf(i));
  Matrix6 right = K;  // K H
  right.rightCols<3>().noalias() -= K.leftCols<3>() * lever_hat;
  sum.topRows<3>() += right.topRows<3>();
  sum.bottomRows<3>() += right.bottomRows<3>();
  sum.bottomRows<3>().noalias() += lever_hat * right.topRows<3>();
}

double RodCoupling::linearise(double goal) {
  double left = 0.0;
  for (ClampedRod& rod : rods_) {
    left = std::max(left, rod.linearise(goal));
    if (!std::isfinite(left)) return kInfinity;
  }
  stiffness_.setZero();
  for (size_t i = 0; i < rods_.size(); ++i) {
    addStiffness(i, rods_[i].stiffness(), stiffness_);
    // The force at the rod's end moves along with it.
    stiffness_.bottomRightCorner<3, 3>() += hat(linear(rods_[i].endWrench())) * hat(leverOf(i));
  }
  stiffness_.bottomRightCorner<3, 3>() -= hat(scene_.platformWeight()) * hat(centre());
  compliance_ = stiffness_.inverse();
  return left;
}

void RodCoupling::assembleLengths() {
  Matrix6 of_lengths;
  for (size_t i = 0; i < 6; ++i) of_lengths.col(i) = aboutP(rods_[i].wrenchOfLength(), leverOf(i));
  length_inverse_ = of_lengths.inverse();
}

// First order: errors of the ends and imbalance that the changes would cause.
double RodCoupling::findPrediction(const std::vector<double>& length_changes, const Wrench& wrench_change) {
  Wrench imbalance = wrench_change;
  for (size_t i = 0; i < rods_.size(); ++i) {
    errors_[i] = -length_changes[i] * rods_[i].twistOfLength();
    imbalance -= length_changes[i] * aboutP(rods_[i].wrenchOfLength(), leverOf(i));
  }
  return solveStep(Unknown::kPose, imbalance);
}

double RodCoupling::findStep(Unknown unknown) {
  Wrench imbalance = wrench - wrenchOfRods();
  for (size_t i = 0; i < rods_.size(); ++i) {
    const ClampedRod& rod = rods_[i];
    errors_[i] = residualTwist(targetOf(i), rod.X_BE());
    const Wrench change = rod.stiffness() * errors_[i];
    imbalance -= aboutP(change, leverOf(i));
    if (unknown == Unknown::kFreeLengths) {
      const Vector3 along = rod.X_BE().R.col(2);
      length_step_[i] = -along.dot(linear(rod.endWrench()) + linear(change)) / along.dot(linear(rod.wrenchOfLength()));
    }
  }
  return solveStep(unknown, imbalance);
}

double RodCoupling::solveStep(Unknown unknown, const Wrench& imbalance) {
  if (unknown == Unknown::kPose) {
    twist_step_ = compliance_ * imbalance;
    std::fill(length_step_.begin(), length_step_.end(), 0.0);
  } else {
    twist_step_.setZero();
    if (unknown == Unknown::kLengths) {
      const Vector6 step = length_inverse_ * imbalance;
      std::copy_n(step.data(), 6, length_step_.begin());
    }
  }
  double size = angular(twist_step_).norm();
  for (size_t i = 0; i < rods_.size(); ++i) {
    const ClampedRod& rod = rods_[i];
    Twist end = errors_[i];
    if (unknown == Unknown::kPose) end += atLever(twist_step_, leverOf(i));
    else end -= length_step_[i] * rod.twistOfLength();
    load_step_[i] = rod.loadOfTwist() * end;
    const double motion = linear(twist_step_).norm() + std::abs(length_step_[i]);
    size = std::max({size, rod.bendingOf(load_step_[i]), motion / rod.length()});
    if (!(load_step_[i].allFinite() && std::isfinite(length_step_[i]))) return kInfinity;
  }
  return size;
}

void RodCoupling::makeStep(Unknown unknown, double share) {
  if (unknown == Unknown::kPose) {
    X_BP.p += share * linear(twist_step_);
    X_BP.R = expSo3(share * angular(twist_step_)) * X_BP.R;
  }
  for (size_t i = 0; i < rods_.size(); ++i) {
    if (unknown != Unknown::kPose) {
      const double least = 0.5 * rods_[i].length();  // lengths stay positive
      rods_[i].setLength(std::max(least, rods_[i].length() + share * length_step_[i]));
    }
    rods_[i].changeLoad(share * load_step_[i]);
  }
}

Wrench RodCoupling::wrenchOfRods() const {
  Wrench sum = -aboutP((Wrench() << scene_.platformWeight(), Vector3::Zero()).finished(), centre());
  for (size_t i = 0; i < rods_.size(); ++i) sum += aboutP(rods_[i].endWrench(), leverOf(i));
  return sum;
}

Matrix6 RodCoupling::materialStiffness(double accuracy) {
  Matrix6 sum = Matrix6::Zero();
  for (size_t i = 0; i < rods_.size(); ++i) addStiffness(i, rods_[i].materialCompliance(accuracy).inverse(), sum);
  return sum;
}

bool RodCoupling::rodsAreStable() const {
  return std::all_of(rods_.begin(), rods_.end(), [](const ClampedRod& rod) { return rod.isStableClamped(); });
}

double RodCoupling::largestTruncation() const {
  double largest = 0.0;
  for (const ClampedRod& rod : rods_) largest = std::max(largest, rod.truncation());
  return largest;
}

void RodCoupling::save(int slot) {
  snapshots_[slot].X_BP = X_BP;
  for (size_t i = 0; i < rods_.size(); ++i) snapshots_[slot].rods[i] = {rods_[i].load(), rods_[i].length()};
}

void RodCoupling::restore(int slot) {
  X_BP = snapshots_[slot].X_BP;
  for (size_t i = 0; i < rods_.size(); ++i) {
    rods_[i].setLength(snapshots_[slot].rods[i].length);
    rods_[i].setLoad(snapshots_[slot].rods[i].load);
  }
}

}  // namespace live_stiffness
