#include "support/orthonormality.h"

#include <stdexcept>

#include "rod/backbone.h"
#include "support/errors.h"
#include "support/literal_rod.h"
#include "support/rest_state.h"

namespace live_stiffness {
namespace {

Pressures figurePressures() { return bars(1.0, {1.5, 1.5, 1.0, 1.0, 0.0, 0.0}); }

Scene sceneOf(const OrthonormalityCase& which) { return which.has_weight ? paperScene(1) : weightlessPaperScene(1); }

RestState restOf(const Scene& scene, Stepping stepping) {
  const Pressures pressures = figurePressures();
  const int steps = stepCount(pressures.maxCoeff(), ModelOptions().pressure_step);
  return restState(std::get<Segment>(scene.chain[0]).section, pressures, stepping, steps);
}

}  // namespace

std::vector<double> rungeKuttaOrthonormality(const OrthonormalityCase& which, int elements) {
  const Scene scene = sceneOf(which);
  const RestState rest = restOf(scene, which.stepping);
  const DeadLoads loads{scene.gravity.value_or(Vector3::Zero()), Wrench::Zero()};
  const LiteralRod rod(std::get<Segment>(scene.chain[0]), scene.tip_mass, loads, figurePressures(), rest);
  std::vector<double> errors;
  for (const Pose& X : rod.solveAlong(elements)) errors.push_back(orthonormalityError(X.R));
  return errors;
}

SolverOrthonormality solverOrthonormality(const OrthonormalityCase& which, int stations) {
  ModelOptions options;
  options.stepping = which.stepping;
  const StiffnessModel model(sceneOf(which), options);
  StiffnessWorkspace workspace = model.makeWorkspace();
  const StiffnessSolution solution = model.solve(figurePressures(), Wrench::Zero(), workspace);
  if (!solution.status.ok()) throw std::runtime_error(model.describe(solution.status));
  SolverOrthonormality result;
  result.elements = workspace.backbone().element_count[0];
  for (int i = 0; i < stations; ++i)
    result.errors.push_back(orthonormalityError(model.station(workspace, 0, i / (stations - 1.0)).X_BQ.R));
  return result;
}

double unloadedBending(const OrthonormalityCase& which) {
  const Scene scene = sceneOf(which);
  const RestState rest = restOf(scene, which.stepping);
  return rest.curvature.norm() * rest.stretch * std::get<Segment>(scene.chain[0]).length;
}

}  // namespace live_stiffness
