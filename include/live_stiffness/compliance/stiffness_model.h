#pragma once
// The incremental nonlinear Cosserat compliance model of Shi et al.: chamber pressures and tip wrench in, tip pose and
// 6x6 compliance out. A scene without weight and without a tip wrench takes the closed form; the boundary value solver
// runs only when an external load acts. An example of its use: examples/solve.cpp.

#include <memory>
#include <string>
#include <vector>

#include "live_stiffness/compliance/model_options.h"
#include "live_stiffness/compliance/stations.h"
#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

struct Backbone;      // the solved shape, and
class StaticsSolver;  // the solver of the library, see src/rod
class LoadStepper;    // of one segment, see src/section

enum class SolveCode {
  kOk = 0,
  kInvalidInput = 1,  // wrong channel count, or a value that is not finite or not physical
  kOutOfRange = 2,    // the pressures stretch a section beyond the range where it has positive area
  kNotConverged = 3,  // no equilibrium found within the bound on iterations
  kUnstable = 4,      // there is no stable equilibrium, or a neutral one: a symmetric column beyond buckling may lean in any
                      // direction and has no finite compliance
};

// Why a solve failed, without allocation; StiffnessModel::describe() makes a text of it.
struct SolveStatus {
  SolveCode code = SolveCode::kOk;
  int index = -1;      // channel (kInvalidInput) or segment (kOutOfRange) concerned; -1: none
  double value = 0.0;  // offending value: pressure, Pa; stretch; residual, rad; share of the loads (kUnstable)

  bool ok() const { return code == SolveCode::kOk; }
};

// Name of a code as programs print it: "ok", "invalid_input", "out_of_range", "not_converged", "unstable".
const char* codeName(SolveCode code);

struct StiffnessSolution {
  SolveStatus status;  // unless ok, nothing below holds
  int iterations = 0;  // over the chain; 0: closed form
  double numerical_error = 0.0;  // estimated upper bound of the relative error of pose and compliance
  Pose X_BT;                     // tip point, m
  Matrix6 compliance;            // tangent, of T under a dead wrench at T, base axes
  Matrix6 material_compliance;   // (10) about T, base axes

  StiffnessSolution() { clearCompliances(); }

 private:
  friend class StiffnessModel;
  struct Unset {};
  explicit StiffnessSolution(Unset) {}  // skips 72 zeros that every solve would overwrite
  void clearCompliances() { compliance.setZero(), material_compliance.setZero(); }
};

// Everything a solve writes to; one per thread, reused. Tied to the model it was made by.
class StiffnessWorkspace {
 public:
  struct State;  // of the library, see src/compliance/stiffness_workspace.h
  explicit StiffnessWorkspace(std::unique_ptr<State> state);
  StiffnessWorkspace(StiffnessWorkspace&&) noexcept;
  StiffnessWorkspace& operator=(StiffnessWorkspace&&) noexcept;
  ~StiffnessWorkspace();

  const Backbone& backbone() const;
  const StaticsSolver& statics() const;
  // True if the last solve was a boundary value problem, false if it took the closed form.
  bool loaded() const;
  // Forgets the last solution, so that the next solve starts cold.
  void reset();

 private:
  friend class StiffnessModel;
  std::unique_ptr<State> state_;
};

// Immutable; share it between threads, one workspace each. Must outlive its workspaces.
class StiffnessModel {
 public:
  // Throws ConfigurationError on bad options or a scene without segments.
  StiffnessModel(Scene scene, ModelOptions options);
  ~StiffnessModel();
  StiffnessModel(const StiffnessModel&) = delete;  // workspaces refer to its scene
  StiffnessModel& operator=(const StiffnessModel&) = delete;

  const Scene& scene() const { return scene_; }
  const ModelOptions& options() const { return options_; }
  StiffnessWorkspace makeWorkspace() const;

  // Solves for gauge pressures (Pa, one per chamber, base to tip; at least -1 atm) and a dead wrench at T (base axes).
  // Never throws and never allocates; a failure is a status.
  StiffnessSolution solve(PressuresRef pressures, const Wrench& tip_wrench, StiffnessWorkspace& workspace) const;

  // What solve() would refuse of this input: kOk or kInvalidInput.
  SolveStatus checkInput(PressuresRef pressures, const Wrench& tip_wrench) const;

  // Station of the last successful solve in the workspace. segment: 0 to segmentCount() - 1; fraction: 0 to 1.
  Station station(const StiffnessWorkspace& workspace, int segment, double fraction) const;
  // The same for several at once, which is faster. out: plan.size() of them. Never allocates.
  void stations(const StiffnessWorkspace& workspace, int segment, StationPlan& plan, Station* out) const;

  // A status as text, with the offending value, its legal range and a remedy.
  std::string describe(const SolveStatus& status) const;

 private:
  SolveStatus solveInto(StiffnessSolution& solution, PressuresRef pressures, const Wrench& tip_wrench,
                        StiffnessWorkspace& workspace) const;
  SolveStatus stepLoads(PressuresRef pressures, Backbone& backbone) const;

  Scene scene_;
  ModelOptions options_;
  int chamber_count_;
  bool has_weight_;
  std::vector<LoadStepper> steppers_;  // one per segment
};

}  // namespace live_stiffness
