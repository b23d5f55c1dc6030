#pragma once
// Live estimation: decides when to re-solve, and keeps the last good estimate when a solve fails.

#include <memory>
#include <string>
#include <vector>

#include "live_stiffness/analysis/ellipsoid.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

class SceneCreep;

struct EstimatorOptions {
  double update_threshold = kUpdateThreshold.standard;  // solve again when the change of pressure exceeds it (13), Pa
  std::vector<double> fractions = kEllipsoidFractions.standard;  // of each segment, where stations are evaluated

  template <class Options, class Visit>
  static void forEachParameter(Options& options, Visit&& visit) {
    visit(kUpdateThreshold, options.update_threshold);
    visit(kEllipsoidFractions, options.fractions);
  }
};

constexpr int kShapeSections = 20;  // of a segment, between the stations of an estimate's shape

// Everything known about the robot at one set of pressures.
struct Estimate {
  Pressures pressures;                  // measured, gauge, Pa, one per chamber
  Pressures effective;                  // those that the solution is of: after the scene's creep, if it has any
  Wrench tip_wrench = Wrench::Zero();   // dead wrench at T, base axes
  StiffnessSolution solution;
  Matrix6 stiffness = Matrix6::Zero();  // inverse of solution.compliance
  Ellipsoid tip_ellipsoid;              // of the translational block of solution.compliance, half axes in m/N
  std::vector<Station> stations;        // fractions of segment 1, then of segment 2, ...
  std::vector<Station> shape;           // kShapeSections + 1 evenly spaced ones of each segment, base to tip
  std::vector<double> stretch;          // of each segment
  double solve_time = 0.0;              // s
};

// The shape of the last successful solve in a workspace at per_segment + 1 evenly spaced sections of each segment
// (compliance included), base to tip.
std::vector<Station> sampleBackbone(const StiffnessModel& model, const StiffnessWorkspace& workspace, int per_segment);

class StiffnessEstimator {
 public:
  enum class Outcome { kUnchanged, kSolved, kFailed };

  // Throws ConfigurationError on bad options or scene. Solves once at rest, so that the first estimate does not have to wait
  // for memory and code that were never touched.
  StiffnessEstimator(Scene scene, const ModelOptions& model_options, EstimatorOptions options);
  ~StiffnessEstimator();

  // New pressures at `time` (s): solves if what they come to after creep moved by more than the threshold since the last
  // solve, or if there was none. The first ones count as having been there for long.
  Outcome setPressures(PressuresRef pressures, double time);
  // The same without a clock: the robot has settled under these pressures.
  Outcome setPressures(PressuresRef pressures);
  // New tip wrench (base axes): solves if it differs from the one of the last solve and pressures are known.
  Outcome setTipWrench(const Wrench& tip_wrench);
  // Solves for the newest pressures and wrench, whatever they are. kUnchanged when no pressures are known yet. Like the
  // above, never allocates after the first two solves.
  Outcome solve();

  // The last good estimate; nullptr before the first.
  const Estimate* estimate() const { return has_estimate_ ? &estimate_ : nullptr; }
  // The newest pressures (empty: none yet) and tip wrench that were set.
  const Pressures& pressures() const { return newest_pressures_; }
  const Wrench& tipWrench() const { return newest_wrench_; }
  // Status of the newest solve; unless ok, estimate() is of earlier pressures.
  const SolveStatus& status() const { return status_; }
  std::string statusText() const { return status_.ok() ? "" : model_.describe(status_); }
  const StiffnessModel& model() const { return model_; }

 private:
  Outcome solveIfMoved();
  void readStations(std::vector<StationPlan>& plans, std::vector<Station>& stations);

  StiffnessModel model_;
  EstimatorOptions options_;
  StiffnessWorkspace workspace_;
  std::vector<StationPlan> plans_, shape_plans_;  // one per segment
  std::unique_ptr<SceneCreep> creep_;
  Pressures newest_pressures_, newest_effective_, solved_effective_;
  Wrench newest_wrench_ = Wrench::Zero(), solved_wrench_ = Wrench::Zero();
  SolveStatus status_;
  Estimate estimate_, candidate_;
  bool has_pressures_ = false, has_solved_ = false, has_estimate_ = false;
};

}  // namespace live_stiffness
