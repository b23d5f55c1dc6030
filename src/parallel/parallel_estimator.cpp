#include "parallel/parallel_estimator.h"

#include <chrono>

#include "lie/matrix6.h"

namespace live_stiffness {

ParallelEstimator::ParallelEstimator(ParallelScene scene, const ParallelOptions& options)
    : model_(std::move(scene), options), workspace_(model_.makeWorkspace()) {
  for (int i = 0; i < kSectionsPerRod; ++i) fractions_.push_back(i / (kSectionsPerRod - 1.0));
}

bool ParallelEstimator::setLengths(const std::vector<double>& lengths) {
  if (has_lengths_ && lengths == lengths_) return false;
  lengths_ = lengths;
  has_lengths_ = true;
  return solve();
}

bool ParallelEstimator::setWrench(const Wrench& wrench) {
  if (wrench == wrench_) return false;
  wrench_ = wrench;
  return has_lengths_ && solve();
}

bool ParallelEstimator::solve() {
  const auto start = std::chrono::steady_clock::now();
  candidate_.solution = model_.solve(lengths_, wrench_, workspace_);
  candidate_.solve_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  status_ = candidate_.solution.status;
  if (!status_.ok()) return false;
  candidate_.stiffness = inverseOf(candidate_.solution.compliance);
  if (!candidate_.stiffness.allFinite()) {
    status_ = {SolveCode::kNotConverged, -1, 0.0};
    return false;
  }
  candidate_.lengths = lengths_;
  candidate_.wrench = wrench_;
  candidate_.ellipsoids = ellipsoidsOf(candidate_.solution.compliance);
  candidate_.rods.resize(lengths_.size());
  for (size_t i = 0; i < lengths_.size(); ++i)
    model_.stations(workspace_, static_cast<int>(i), fractions_, candidate_.rods[i]);
  std::swap(estimate_, candidate_);
  has_estimate_ = true;
  return true;
}

}  // namespace live_stiffness
