#include "analysis/stiffness_sweep.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "live_stiffness/analysis/eigenscrews.h"

namespace live_stiffness {

void sweepStiffness(const StiffnessModel& model, const PressurePlan& plan, const StiffnessCriterion& criterion,
                    ComplianceKind kind, const SweepSink& sink, int threads, long block) {
  const int chambers = model.scene().chamberCount(), mapped = plan.channels().chamberCount();
  if (mapped != chambers)
    throw ConfigurationError("stiffness map",
                             {"the channels feed " + std::to_string(mapped) + " chambers, but the scene has " +
                              std::to_string(chambers) + ": name the channel of each chamber"});
  struct Worker {
    StiffnessWorkspace workspace;
    Pressures chambers;
  };
  tbb::enumerable_thread_specific<Worker> workers([&] {
    return Worker{model.makeWorkspace(), Pressures::Zero(chambers)};
  });
  const auto solve = [&](long row, Worker& worker) {
    SweepRow result;
    plan.chamberPressures(row, worker.chambers);
    worker.workspace.reset();
    const StiffnessSolution solution = model.solve(worker.chambers, Wrench::Zero(), worker.workspace);
    result.code = solution.status.code;
    if (!solution.status.ok()) return result;
    const Matrix6& C = kind == ComplianceKind::kTangent ? solution.compliance : solution.material_compliance;
    const Eigenstiffnesses eta = eigenstiffnessesOfCompliance(C);
    result.X_BT = solution.X_BT;
    result.eigenstiffnesses = eta.values;
    switch (criterion.kind) {  // the criteria that are already computed
      case CriterionKind::kLargestEigenstiffness: result.tau = eta.values[0]; break;
      case CriterionKind::kSmallestEigenstiffness: result.tau = eta.values[2]; break;
      default: result.tau = criterion(C);
    }
    if (!eta.definite || !std::isfinite(result.tau)) result.code = SolveCode::kUnstable;
    return result;
  };
  tbb::task_arena arena(threads > 0 ? threads : static_cast<int>(tbb::task_arena::automatic));
  std::vector<SweepRow> rows;
  for (long first = 0; first < plan.rows(); first += block) {
    rows.resize(std::min(block, plan.rows() - first));
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<size_t>(0, rows.size(), 64), [&](const tbb::blocked_range<size_t>& range) {
        Worker& worker = workers.local();
        for (size_t i = range.begin(); i != range.end(); ++i) rows[i] = solve(first + static_cast<long>(i), worker);
      });
      sink(first, rows);  // inside the arena, so that the limit on threads holds for it, too
    });
  }
}

}  // namespace live_stiffness
