#pragma once
// Is numerical_error true? Random scenes, each solved to a requested accuracy and again as well as possible.

#include <functional>

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

struct EstimateCase {
  int segments = 0;
  bool loaded = false;       // a boundary value problem, not the closed form
  double requested = 0.0;    // accuracy, log-uniform 1e-9 to 1e-3
  double estimate = 0.0;     // numerical_error
  double error = 0.0;        // the true one, largest of pose, tangent and material compliance
  SolveCode code = SolveCode::kOk;
  SolveCode reference = SolveCode::kOk;  // of the solution at accuracy 1e-13

  bool solved() const { return code == SolveCode::kOk && reference == SolveCode::kOk; }
  // kReference is what the reference is good for: near the limit of its residual of 1e-12 rad.
  bool withinTenEstimates() const { return error < 10.0 * estimate + kReference; }
  bool withinRequested() const { return error < requested; }
  static constexpr double kReference = 1e-11;
};

struct EstimateShares {
  int cases = 0, solved = 0, loaded = 0, within_ten_estimates = 0, within_requested = 0;
  int status_differs = 0;        // solved at one accuracy, refused at the other
  int of_code[5] = {};           // of the solutions at the requested accuracy
  double worst_ratio = 0.0;      // of error to estimate

  double tenEstimatesShare() const { return double(within_ten_estimates) / std::max(solved, 1); }
  double requestedShare() const { return double(within_requested) / std::max(solved, 1); }
};

// The same seed gives the same cases; on_case sees each of them.
EstimateShares checkEstimates(unsigned seed, int cases, const std::function<void(const EstimateCase&)>& on_case);

}  // namespace live_stiffness
