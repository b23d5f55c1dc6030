#pragma once
// The linearised equations of rods and platform together, with the rods' unknowns eliminated rod by rod.
//
// x is a change of the platform's pose (twist of P), l are the lengths of the rods. The end of each rod must stay on the
// platform,
//   J_i dw_i + e_i dl_i = err_i + H_i x,   H_i maps a twist of P to that of the rod's end,
// and the platform must be in balance, sum_i H_i^T [f; m]_i = [F; M]. With K_i = d[f; m]_i / d(end pose) the first is put
// into the second, which leaves six equations. For given lengths, K_P x = imbalance, and K_P^-1 is the tangent compliance
// of P under a dead wrench; for a given pose the unknowns are six lengths. (53) is the same sum without the change of the
// loads' lever arms.

#include <deque>

#include "parallel/clamped_rod.h"

namespace live_stiffness {

class RodCoupling {
 public:
  // What is solved for. kFreeLengths: the pose is given and each rod takes the length at which nothing pulls along its
  // end; the platform need not balance.
  enum class Unknown { kPose, kLengths, kFreeLengths };

  RodCoupling(const ParallelScene& scene, double accuracy, Simd simd);

  Pose X_BP;
  Wrench wrench = Wrench::Zero();  // dead wrench on the platform at P beside its weight, base axes
  // Share of the way from straight rods, at the lengths of placeStraight(), to the platform that the rods' ends are at.
  double homotopy = 1.0;

  std::deque<ClampedRod>& rods() { return rods_; }
  const std::deque<ClampedRod>& rods() const { return rods_; }
  void placeStraight(const std::vector<double>& lengths);

  // Converged shapes of all rods. False if one cannot be found.
  bool integrateAll();
  // choose() or refineForLoad() of all rods; true if that changed one.
  bool changesAny(bool (ClampedRod::*change)());
  // One iteration of all rods. Returns the largest change, infinity if one is not admissible.
  double sweepAll();
  // All rods and the platform; columns to `goal`. Returns what the iterations left; infinity without success.
  double linearise(double goal);
  // After it, what kLengths needs besides. Six rods only.
  void assembleLengths();

  // Newton's step at the shape of the last sweep, with the last linearisation. Returns its size: largest of bending by
  // the changes of load, motion over length and turn, rad; infinity if there is none.
  double findStep(Unknown unknown);
  // The same in advance, from an equilibrium: for the changes of length (m) and of wrench about to be made.
  double findPrediction(const std::vector<double>& length_changes, const Wrench& wrench_change);
  // Makes `share` of it.
  void makeStep(Unknown unknown, double share);

  // Of the platform on the rods, all of it about P, base axes, less the platform's weight: the wrench in equilibrium.
  Wrench wrenchOfRods() const;
  // d wrench / d twist of P, after linearise(): the tangent stiffness, and its inverse (not finite if singular).
  const Matrix6& platformStiffness() const { return stiffness_; }
  const Matrix6& platformCompliance() const { return compliance_; }
  // Tip stiffness by (53): the inverses of the rods' material compliances about P, summed.
  Matrix6 materialStiffness(double accuracy);
  // The rods held by a fixed platform are stable.
  bool rodsAreStable() const;
  double largestTruncation() const;

  // Pose, loads and lengths, to go back to. Slots 0 and 1.
  void save(int slot);
  void restore(int slot);

 private:
  Pose targetOf(size_t i) const;
  Vector3 centre() const { return X_BP.R * scene_.platform_centre; }  // from P, base axes
  Vector3 leverOf(size_t i) const { return X_BP.R * scene_.rods[i].X_PE.p; }  // from P, base axes
  double solveStep(Unknown unknown, const Wrench& imbalance);
  void addStiffness(size_t i, const Matrix6& K, Matrix6& sum) const;

  struct Snapshot {
    struct Rod {
      Vector6 load;
      double length;
    };
    Pose X_BP;
    std::vector<Rod> rods;
  };

  const ParallelScene& scene_;
  std::deque<ClampedRod> rods_;
  std::vector<double> straight_lengths_;
  std::vector<Twist> errors_;       // of the rods' ends, base axes
  std::vector<Vector6> load_step_;
  std::vector<double> length_step_;
  Twist twist_step_ = Twist::Zero();
  Matrix6 stiffness_ = Matrix6::Zero(), compliance_ = Matrix6::Zero();
  Matrix6 length_inverse_ = Matrix6::Zero();  // of d(wrench of rods) / d(lengths) at a fixed platform
  Snapshot snapshots_[2];
};

}  // namespace live_stiffness
