#include "live_stiffness/estimation/stiffness_estimator.h"

#include <chrono>
#include <cmath>

#include "estimation/creep.h"
#include "lie/matrix6.h"
#include "rod/backbone.h"

namespace live_stiffness {
namespace {

EstimatorOptions checked(EstimatorOptions options) {
  FaultList faults("estimator");
  faults.checkAll(options);
  faults.throwIfAny();
  return options;
}

std::vector<double> evenFractions(int count) {
  std::vector<double> fractions;
  for (int i = 0; i <= count; ++i) fractions.push_back(static_cast<double>(i) / count);
  return fractions;
}

}  // namespace

std::vector<Station> sampleBackbone(const StiffnessModel& model, const StiffnessWorkspace& workspace,
                                    int per_segment) {
  std::vector<Station> samples;
  for (int segment = 0; segment < model.scene().segmentCount(); ++segment)
    for (double fraction : evenFractions(per_segment)) samples.push_back(model.station(workspace, segment, fraction));
  return samples;
}

StiffnessEstimator::StiffnessEstimator(Scene scene, const ModelOptions& model_options, EstimatorOptions options)
    : model_(std::move(scene), model_options), options_(checked(std::move(options))),
      workspace_(model_.makeWorkspace()), plans_(model_.scene().segmentCount(), StationPlan(options_.fractions)),
      shape_plans_(model_.scene().segmentCount(), StationPlan(evenFractions(kShapeSections))),
      creep_(std::make_unique<SceneCreep>(model_.scene())) {
  // In a workspace of its own: what comes first is still solved from rest.
  StiffnessWorkspace workspace = model_.makeWorkspace();
  model_.solve(Pressures::Zero(model_.scene().chamberCount()), Wrench::Zero(), workspace);
}

StiffnessEstimator::~StiffnessEstimator() = default;

StiffnessEstimator::Outcome StiffnessEstimator::setPressures(PressuresRef pressures, double time) {
  // What the solver will refuse must not get into the creep's memory.
  if (!std::isfinite(time) || pressures.size() != model_.scene().chamberCount() || !pressures.allFinite())
    return setPressures(pressures);
  newest_pressures_ = pressures;
  newest_effective_ = creep_->update(pressures, time);
  return solveIfMoved();
}

StiffnessEstimator::Outcome StiffnessEstimator::setPressures(PressuresRef pressures) {
  newest_pressures_ = newest_effective_ = pressures;
  return solveIfMoved();
}

StiffnessEstimator::Outcome StiffnessEstimator::solveIfMoved() {
  has_pressures_ = true;
  const bool comparable = has_solved_ && solved_effective_.size() == newest_effective_.size();
  if (comparable && (newest_effective_ - solved_effective_).norm() <= options_.update_threshold)
    return Outcome::kUnchanged;
  return solve();
}

StiffnessEstimator::Outcome StiffnessEstimator::setTipWrench(const Wrench& tip_wrench) {
  newest_wrench_ = tip_wrench;
  if (has_solved_ && tip_wrench == solved_wrench_) return Outcome::kUnchanged;
  return solve();
}

StiffnessEstimator::Outcome StiffnessEstimator::solve() {
  if (!has_pressures_) return Outcome::kUnchanged;
  has_solved_ = true;
  solved_effective_ = newest_effective_;
  solved_wrench_ = newest_wrench_;
  const auto start = std::chrono::steady_clock::now();
  candidate_.solution = model_.solve(newest_effective_, newest_wrench_, workspace_);
  status_ = candidate_.solution.status;
  if (!status_.ok()) return Outcome::kFailed;
  candidate_.stiffness = inverseOf(candidate_.solution.compliance);
  if (!candidate_.stiffness.allFinite()) {
    status_ = {SolveCode::kNotConverged, -1, 0.0};
    return Outcome::kFailed;
  }
  candidate_.solve_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  candidate_.pressures = newest_pressures_;
  candidate_.effective = newest_effective_;
  candidate_.tip_wrench = newest_wrench_;
  candidate_.tip_ellipsoid = ellipsoidOf(candidate_.solution.compliance.topLeftCorner<3, 3>());
  readStations(plans_, candidate_.stations);
  readStations(shape_plans_, candidate_.shape);
  candidate_.stretch.clear();
  for (int segment = 0; segment < model_.scene().segmentCount(); ++segment)
    candidate_.stretch.push_back(workspace_.backbone().rest[segment].stretch);
  std::swap(estimate_, candidate_);
  has_estimate_ = true;
  return Outcome::kSolved;
}

void StiffnessEstimator::readStations(std::vector<StationPlan>& plans, std::vector<Station>& stations) {
  const int per_segment = plans.front().size();
  stations.resize(plans.size() * per_segment);
  for (size_t segment = 0; segment < plans.size(); ++segment)
    model_.stations(workspace_, static_cast<int>(segment), plans[segment], stations.data() + segment * per_segment);
}

}  // namespace live_stiffness
