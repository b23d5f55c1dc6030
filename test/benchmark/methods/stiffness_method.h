#pragma once
// The one interface of everything that speed_report measures: the library's solver and its opponents.

#include <string>

#include "live_stiffness/conventions.h"
#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

struct MethodSolution {
  bool converged = false;  // unless true, nothing below holds
  Pose X_BT;               // tip point, m
  Matrix6 compliance = Matrix6::Zero();           // tangent, of T under a dead wrench at T, base axes
  Matrix6 material_compliance = Matrix6::Zero();  // (10) about T, base axes
};

// A solver for one scene. Each solve() includes load stepping and starts from the last solution unless reset() was
// called or the last solve failed.
class StiffnessMethod {
 public:
  explicit StiffnessMethod(std::string name) : name_(std::move(name)) {}
  virtual ~StiffnessMethod() = default;

  // pressures: gauge, Pa, one per chamber, base to tip.
  virtual MethodSolution solve(PressuresRef pressures) = 0;
  virtual void reset() = 0;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace live_stiffness
