#pragma once
// Stiffness over the workspace (Fig. 10): solves every row of a plan, on all cores.

#include <functional>

#include "analysis/pressure_plan.h"
#include "live_stiffness/analysis/stiffness_criterion.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

enum class ComplianceKind {
  kTangent,   // StiffnessSolution::compliance, what a hand would feel
  kMaterial,  // StiffnessSolution::material_compliance, the paper's
};

struct SweepRow {
  SolveCode code = SolveCode::kOk;  // unless kOk, nothing below holds
  Pose X_BT;
  Vector6 eigenstiffnesses = Vector6::Zero();  // N, positive ones first, see eigenscrews.h
  double tau = 0.0;                            // the criterion (22)
};

// Takes rows first to first + rows.size() - 1; called in order, by one thread at a time.
using SweepSink = std::function<void(long first, const std::vector<SweepRow>& rows)>;

// Solves all rows by at most `threads` threads (0: all cores), in blocks of `block` rows. Every solve starts cold, so that a
// row depends on neither, nor on the row that the thread solved before. Throws ConfigurationError unless the plan has as many
// chambers as the scene.
void sweepStiffness(const StiffnessModel& model, const PressurePlan& plan, const StiffnessCriterion& criterion,
                    ComplianceKind kind, const SweepSink& sink, int threads = 0, long block = 16384);

}  // namespace live_stiffness
