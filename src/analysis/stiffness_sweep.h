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

class StiffnessSweep {
 public:
  // model and plan must outlive the sweep. Throws ConfigurationError unless the plan has as many chambers as the scene.
  StiffnessSweep(const StiffnessModel& model, const PressurePlan& plan, const StiffnessCriterion& criterion,
                 ComplianceKind kind);

  // One row. Every solve starts cold, so the result depends on the row only, and not on the row that the thread solved
  // before.
  SweepRow solve(long row, StiffnessWorkspace& workspace, Pressures& chambers) const;

  // Takes rows first to first + rows.size() - 1; called in order, by one thread at a time.
  using Sink = std::function<void(long first, const std::vector<SweepRow>& rows)>;
  // All rows, by at most `threads` threads (0: all cores), in blocks of `block` rows. Results do not depend on either.
  void run(const Sink& sink, int threads = 0, long block = 16384) const;

 private:
  const StiffnessModel& model_;
  const PressurePlan& plan_;
  StiffnessCriterion criterion_;
  ComplianceKind kind_;
};

}  // namespace live_stiffness
