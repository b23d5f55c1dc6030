#pragma once
// The one interface of everything that speed_report measures: the library's solver and its opponents.

#include <string>

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

// A solver for one scene. Each solve() includes load stepping and starts from the last solution unless reset() was
// called or the last solve failed.
class StiffnessMethod {
 public:
  explicit StiffnessMethod(std::string name) : name_(std::move(name)) {}
  virtual ~StiffnessMethod() = default;

  // pressures: gauge, Pa, one per chamber, base to tip. Of the solution, opponents set status, pose and compliances.
  virtual StiffnessSolution solve(PressuresRef pressures) = 0;
  virtual void reset() = 0;
  const std::string& name() const { return name_; }

 protected:
  static constexpr SolveStatus statusOf(bool converged) {
    return {converged ? SolveCode::kOk : SolveCode::kNotConverged};
  }

 private:
  std::string name_;
};

}  // namespace live_stiffness
