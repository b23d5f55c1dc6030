#pragma once
// Equilibrium of a parallel robot: platform pose from rod lengths, or rod lengths from platform pose.

#include "parallel/rod_coupling.h"

namespace live_stiffness {

struct ParallelReport {
  bool converged = false;
  bool stable = false;         // tangent stiffness positive definite, and every rod stable with both ends held
  int iterations = 0;          // sweeps and converged shots over all rods, all attempts together
  double step = 0.0;           // size of the step that was left to make, rad
  double truncation = 0.0;     // estimated relative error of discretisation
  double iteration = 0.0;      // estimated relative error of shape and columns, left by their last iterations
};

class ParallelStatics {
 public:
  static constexpr int kMaxIterations = 600;
  using Unknown = RodCoupling::Unknown;

  // accuracy: relative, of pose and compliance.
  ParallelStatics(const ParallelScene& scene, double accuracy, Simd simd = Simd::kBest);
  ParallelStatics(const ParallelStatics&) = delete;  // its parts refer to one another

  // Solves for the platform pose under a dead wrench at P (base axes). lengths: positive, one a rod, m. Starts from the
  // last solution unless reset() was called: sweeps that mend shapes, loads and pose together, then damped Newton steps
  // along the way from the last lengths and wrench. From nothing: rods that reach a guessed pose without axial force,
  // and from their lengths and wrench along the way to those given; the equilibrium that this leads to is the answer.
  ParallelReport solveForPose(const std::vector<double>& lengths, const Wrench& wrench);

  // Solves for the lengths (read them from the rods) that hold the platform at X_BP. Six rods only.
  ParallelReport solveForLengths(const Pose& X_BP, const Wrench& wrench);

  void reset() { warm_ = false; }
  // Shape and tangent of the last solve.
  RodCoupling& coupling() { return coupling_; }
  const std::deque<ClampedRod>& rods() const { return coupling_.rods(); }

 private:
  struct Goal {
    Unknown unknown;
    Pose X_BP;  // kLengths
    const std::vector<double>* lengths;  // kPose
    Wrench wrench;
  };
  ParallelReport solve(const Goal& goal);
  void setInputs(const Goal& goal, const Wrench& last_wrench);
  bool chordIteration(Unknown unknown, ParallelReport& report);
  bool newton(Unknown unknown, double goal, ParallelReport& report);
  template <class Set>
  bool follow(Set set, Unknown unknown, ParallelReport& report);
  bool followInputs(const Goal& goal, ParallelReport& report);
  bool startCold(const Goal& goal, ParallelReport& report);
  bool finish(Unknown unknown, ParallelReport& report);
  bool linearise(Unknown unknown, ParallelReport& report);
  bool isStable() const;

  const ParallelScene& scene_;
  double accuracy_;
  RodCoupling coupling_;
  std::vector<double> start_lengths_;
  bool warm_ = false;
};

}  // namespace live_stiffness
