#pragma once
// Live estimation of a parallel robot: solves for every new set of rod lengths, and keeps the last good estimate when a
// solve fails.

#include <string>
#include <vector>

#include "live_stiffness/analysis/ellipsoid.h"
#include "live_stiffness/parallel/parallel_model.h"

namespace live_stiffness {

// Everything known about the robot at one set of rod lengths.
struct ParallelEstimate {
  std::vector<double> lengths;      // of the rods between base and platform, m, in the order of the scene
  Wrench wrench = Wrench::Zero();   // dead wrench on the platform at P, without its weight, base axes
  ParallelSolution solution;
  Matrix6 stiffness = Matrix6::Zero();  // inverse of solution.compliance
  EllipsoidPair ellipsoids;             // of solution.compliance, half axes in m/N and rad/(N m)
  std::vector<std::vector<Pose>> rods;  // shape of each rod, base to platform: sections in B
  double solve_time = 0.0;              // s
};

class ParallelEstimator {
 public:
  static constexpr int kSectionsPerRod = 25;  // of ParallelEstimate::rods

  // Throws ConfigurationError on bad options or scene.
  ParallelEstimator(ParallelScene scene, const ParallelOptions& options);

  // Solves for new lengths (m), or for a new wrench on the platform (base axes) once lengths are known. True if it was
  // solved and gave an estimate. The same input as last time is not solved again.
  bool setLengths(const std::vector<double>& lengths);
  bool setWrench(const Wrench& wrench);

  // The last good estimate; nullptr before the first.
  const ParallelEstimate* estimate() const { return has_estimate_ ? &estimate_ : nullptr; }
  // Status of the newest solve; unless ok, estimate() is of earlier input.
  const SolveStatus& status() const { return status_; }
  std::string statusText() const { return status_.ok() ? "" : model_.describe(status_); }
  const ParallelModel& model() const { return model_; }

 private:
  bool solve();

  ParallelModel model_;
  ParallelWorkspace workspace_;
  std::vector<double> lengths_;
  Wrench wrench_ = Wrench::Zero();
  std::vector<double> fractions_;
  SolveStatus status_;
  ParallelEstimate estimate_, candidate_;
  bool has_lengths_ = false, has_estimate_ = false;
};

}  // namespace live_stiffness
