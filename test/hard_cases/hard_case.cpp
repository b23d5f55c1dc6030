#include "hard_cases/hard_case.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace live_stiffness {
namespace {

class Stopwatch {
 public:
  double us() const {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

void HardOutcome::record(SolveCode code, SolveCode wanted, int iterations, double estimate, double time_us) {
  code_ = std::max(code_, code);
  iterations_ = std::max(iterations_, iterations);
  if (code == SolveCode::kOk) estimate_ = std::max(estimate_, estimate);
  time_us_ = std::max(time_us_, time_us);
  expect(code == wanted || any_status_, std::string("status ") + codeName(code) + " instead of " + codeName(wanted));
  expect(iterations <= StaticsSolver::kMaxIterations, "iterations beyond the bound");
}

StiffnessSolution HardOutcome::solve(const StiffnessModel& model, const Pressures& pressures, const Wrench& tip_wrench,
                                     StiffnessWorkspace& workspace, SolveCode wanted) {
  const Stopwatch watch;
  const StiffnessSolution solution = model.solve(pressures, tip_wrench, workspace);
  record(solution.status.code, wanted, solution.iterations, solution.numerical_error, watch.us());
  expect(solution.X_BT.p.allFinite() && solution.X_BT.R.allFinite() && solution.compliance.allFinite() &&
             solution.material_compliance.allFinite() && std::isfinite(solution.numerical_error),
         "not finite");
  return solution;
}

StiffnessSolution HardOutcome::solveCold(const StiffnessModel& model, const Pressures& pressures,
                                         const Wrench& tip_wrench, SolveCode wanted) {
  StiffnessWorkspace workspace = model.makeWorkspace();
  return solve(model, pressures, tip_wrench, workspace, wanted);
}

StaticsReport HardOutcome::solve(StaticsSolver& solver, const DeadLoads& loads, Backbone& backbone, bool stable) {
  const Stopwatch watch;
  const StaticsReport report = solver.solve(loads, backbone);
  const SolveCode code = !report.converged ? SolveCode::kNotConverged
                         : report.stable   ? SolveCode::kOk
                                           : SolveCode::kUnstable;
  record(code, stable ? SolveCode::kOk : SolveCode::kUnstable, report.iterations,
         report.truncation + report.residual, watch.us());
  return report;
}

void HardOutcome::error(double error, double tolerance, const std::string& of) {
  error_ = std::isnan(error) ? error : std::max(error_, error);
  if (error <= tolerance) return;
  std::ostringstream text;
  text << "error of " << of << " " << error << " > " << tolerance;
  expect(false, text.str());
}

void HardOutcome::expect(bool condition, const std::string& what) {
  if (condition || faults_.find(what) != std::string::npos) return;
  if (faults_.size() > 2000) return;  // enough to see
  faults_ += faults_.empty() ? what : "; " + what;
}

}  // namespace live_stiffness
