#pragma once
// A named hard case: it solves something difficult and compares with a truth that the solver has no part in. Each is
// both a test (hard_cases_test) and a row of the report (hard_cases_report).

#include <functional>
#include <string>
#include <vector>

#include "live_stiffness/compliance/stiffness_model.h"
#include "rod/statics.h"
#include "support/scenes.h"

namespace live_stiffness {

class HardOutcome {
 public:
  // A solve of this case, timed. Wants a status: kOk unless another one is the honest answer.
  StiffnessSolution solve(const StiffnessModel& model, const Pressures& pressures, const Wrench& tip_wrench,
                          StiffnessWorkspace& workspace, SolveCode wanted = SolveCode::kOk);
  StiffnessSolution solveCold(const StiffnessModel& model, const Pressures& pressures, const Wrench& tip_wrench,
                              SolveCode wanted = SolveCode::kOk);
  // The same of statics alone.
  StaticsReport solve(StaticsSolver& solver, const DeadLoads& loads, Backbone& backbone, bool stable = true);

  // No status but the honest one is wanted of the solves to come: they may fail, but not be wrong.
  void allowFailure() { any_status_ = true; }

  // A relative error against the truth, and the most it may be.
  void error(double error, double tolerance, const std::string& of);
  void expect(bool condition, const std::string& what);

  bool ok() const { return faults_.empty(); }
  const std::string& faults() const { return faults_; }
  SolveCode worstCode() const { return code_; }
  double worstError() const { return error_; }
  double largestEstimate() const { return estimate_; }
  int mostIterations() const { return iterations_; }
  double longestTimeUs() const { return time_us_; }

 private:
  void record(SolveCode code, SolveCode wanted, int iterations, double estimate, double time_us);

  SolveCode code_ = SolveCode::kOk;
  double error_ = 0.0, estimate_ = 0.0, time_us_ = 0.0;
  int iterations_ = 0;
  bool any_status_ = false;
  std::string faults_;
};

// Of scenes of any size, which a step in Pa does not fit.
inline ModelOptions continuousOptions(double accuracy = 1e-10) {
  ModelOptions options = accurateTo(accuracy);
  options.stepping = Stepping::kContinuous;
  return options;
}

struct HardCase {
  std::string name;   // lower_case
  std::string truth;  // what it is compared with
  std::function<void(HardOutcome&)> run;
};

struct HardTheme {
  std::string name;
  std::vector<HardCase> cases;
};

HardTheme straightAndCurved();
HardTheme buckling();
HardTheme sectionLimits();
HardTheme slenderAndStiff();
HardTheme loadsAndStarts();

inline std::vector<HardTheme> hardThemes() {
  return {straightAndCurved(), buckling(), sectionLimits(), slenderAndStiff(), loadsAndStarts()};
}

}  // namespace live_stiffness
