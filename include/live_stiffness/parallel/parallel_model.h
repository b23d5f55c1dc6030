#pragma once
// The compliance model of a parallel continuum robot (Appendix E): rod lengths and platform wrench in, platform pose
// and 6x6 compliance out; and the inverse, platform pose in and rod lengths out.

#include <memory>
#include <string>
#include <vector>

#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/parallel/parallel_scene.h"

namespace live_stiffness {

struct ParallelOptions {
  double accuracy = kAccuracy.standard;  // relative, of pose and compliance
};

struct ParallelSolution {
  SolveStatus status;    // unless ok, nothing below holds; index: rod concerned
  int iterations = 0;    // over all rods
  double numerical_error = 0.0;  // estimated upper bound of the relative error of pose and compliance
  Pose X_BP;                     // platform, m
  Matrix6 compliance = Matrix6::Zero();           // tangent, of P under a dead wrench at P, base axes
  Matrix6 material_compliance = Matrix6::Zero();  // about P by (53): inverse of the sum of the rods' tip stiffnesses
};

class ParallelStatics;  // the solver of the library, see src/parallel

// Everything a solve writes to; one per thread, reused. Tied to the model it was made by.
class ParallelWorkspace {
 public:
  explicit ParallelWorkspace(std::unique_ptr<ParallelStatics> statics);
  ParallelWorkspace(ParallelWorkspace&&) noexcept;
  ~ParallelWorkspace();

  // Lengths of the rods between base and platform in the last solve, m.
  std::vector<double> lengths() const;
  const ParallelStatics& statics() const { return *statics_; }
  // Forgets the last solution, so that the next solve starts cold.
  void reset();

 private:
  friend class ParallelModel;
  std::unique_ptr<ParallelStatics> statics_;
};

// Immutable; share it between threads, one workspace each. Must outlive its workspaces.
class ParallelModel {
 public:
  // Throws ConfigurationError on bad options or a scene without rods.
  ParallelModel(ParallelScene scene, ParallelOptions options);
  ParallelModel(const ParallelModel&) = delete;  // workspaces refer to its scene
  ParallelModel& operator=(const ParallelModel&) = delete;

  const ParallelScene& scene() const { return scene_; }
  const ParallelOptions& options() const { return options_; }
  ParallelWorkspace makeWorkspace() const;

  // Solves for rod lengths (m, one for each rod, in the order of the scene) and a dead wrench at P (base axes), in addition
  // to the platform's weight. Never throws and never allocates; a failure is a status.
  ParallelSolution solve(const std::vector<double>& lengths, const Wrench& wrench, ParallelWorkspace& workspace) const;

  // The lengths that hold the platform at X_BP under the wrench: those of the workspace afterwards.
  // For six rods; kInvalidInput for another number.
  ParallelSolution solveForLengths(const Pose& X_BP, const Wrench& wrench, ParallelWorkspace& workspace) const;

  // Section of a rod after a successful solve, in B. rod: 0 to rodCount() - 1; fractions of its length, 0 to 1. out: as
  // many as fractions; allocates only to grow.
  void stations(const ParallelWorkspace& workspace, int rod, const std::vector<double>& fractions,
                std::vector<Pose>& out) const;

  // A status as text, with the offending value, its legal range and a remedy.
  std::string describe(const SolveStatus& status) const;

 private:
  ParallelScene scene_;
  ParallelOptions options_;
};

}  // namespace live_stiffness
