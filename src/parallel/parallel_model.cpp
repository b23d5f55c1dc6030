#include "live_stiffness/parallel/parallel_model.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "compliance/station_reader.h"
#include "live_stiffness/checks.h"
#include "parallel/parallel_statics.h"

namespace live_stiffness {
namespace {

constexpr Range kLengths{1e-4, 1e3};  // m

ParallelSolution failed(const SolveStatus& status) {
  ParallelSolution solution;
  solution.status = status;
  return solution;
}

ParallelSolution completed(const ParallelReport& report, RodCoupling& coupling, double accuracy) {
  ParallelSolution solution;
  solution.iterations = report.iterations;
  if (!report.converged) solution.status = {SolveCode::kNotConverged, -1, report.step};
  else if (!report.stable) solution.status = {SolveCode::kUnstable, -1, 0.0};
  if (!solution.status.ok()) return solution;
  solution.X_BP = coupling.X_BP;
  solution.compliance = coupling.platformCompliance();
  solution.material_compliance = coupling.materialStiffness(accuracy).inverse();
  // Towards buckling an error of the loads grows as the compliance itself does.
  const auto compliance_norm = [](const Matrix6& C) { return C.topLeftCorner<3, 3>().norm(); };
  const double growth = std::max(1.0, compliance_norm(solution.compliance) / compliance_norm(solution.material_compliance));
  solution.numerical_error = growth * (report.truncation + report.step + report.iteration) + 1e-14;
  // A sum is finite only if all its terms are.
  if (!std::isfinite(solution.X_BP.p.sum() + solution.compliance.sum() + solution.material_compliance.sum()))
    solution.status = {SolveCode::kNotConverged, -1, 0.0};
  return solution;
}

}  // namespace

ParallelWorkspace::ParallelWorkspace(std::unique_ptr<ParallelStatics> statics) : statics_(std::move(statics)) {}
ParallelWorkspace::ParallelWorkspace(ParallelWorkspace&&) noexcept = default;
ParallelWorkspace::~ParallelWorkspace() = default;

std::vector<double> ParallelWorkspace::lengths() const {
  std::vector<double> lengths;
  for (const ClampedRod& rod : statics_->rods()) lengths.push_back(rod.length());
  return lengths;
}

void ParallelWorkspace::reset() { statics_->reset(); }

ParallelModel::ParallelModel(ParallelScene scene, ParallelOptions options)
    : scene_(std::move(scene)), options_(options) {
  FaultList faults("parallel model");
  if (scene_.rods.empty()) faults.add("rods: must hold at least one rod");
  faults.check(kAccuracy, options_.accuracy);
  faults.throwIfAny();
}

ParallelWorkspace ParallelModel::makeWorkspace() const {
  return ParallelWorkspace(std::make_unique<ParallelStatics>(scene_, options_.accuracy));
}

ParallelSolution ParallelModel::solve(const std::vector<double>& lengths, const Wrench& wrench,
                                      ParallelWorkspace& workspace) const {
  if (lengths.size() != scene_.rods.size())
    return failed({SolveCode::kInvalidInput, -1, static_cast<double>(lengths.size())});
  for (size_t i = 0; i < lengths.size(); ++i)
    if (!kLengths.contains(lengths[i])) return failed({SolveCode::kInvalidInput, static_cast<int>(i), lengths[i]});
  if (!wrench.allFinite()) return failed({SolveCode::kInvalidInput, scene_.rodCount(), std::nan("")});
  ParallelStatics& statics = *workspace.statics_;
  return completed(statics.solveForPose(lengths, wrench), statics.coupling(), options_.accuracy);
}

ParallelSolution ParallelModel::solveForLengths(const Pose& X_BP, const Wrench& wrench,
                                                ParallelWorkspace& workspace) const {
  const double skewness = (X_BP.R.transpose() * X_BP.R - Matrix3::Identity()).norm();
  if (scene_.rodCount() != 6) return failed({SolveCode::kInvalidInput, -2, static_cast<double>(scene_.rodCount())});
  if (!(skewness < 1e-6) || !X_BP.p.allFinite() || !(X_BP.R.determinant() > 0.0))
    return failed({SolveCode::kInvalidInput, -3, skewness});
  if (!wrench.allFinite()) return failed({SolveCode::kInvalidInput, scene_.rodCount(), std::nan("")});
  ParallelStatics& statics = *workspace.statics_;
  return completed(statics.solveForLengths(X_BP, wrench), statics.coupling(), options_.accuracy);
}

void ParallelModel::stations(const ParallelWorkspace& workspace, int rod, const std::vector<double>& fractions,
                             std::vector<Pose>& out) const {
  const ClampedRod& held = workspace.statics().rods()[rod];
  out.resize(fractions.size());
  for (size_t i = 0; i < fractions.size(); ++i)
    out[i] = held.X_BD() * stationAt(held.backbone(), 0, fractions[i], {options_.accuracy, true}).X_BQ;
}

std::string ParallelModel::describe(const SolveStatus& status) const {
  const std::string value = numberText(status.value), rods = std::to_string(scene_.rodCount());
  switch (status.code) {
    case SolveCode::kOk:
      return "ok";
    case SolveCode::kInvalidInput:
      if (status.index == -1)
        return value + " lengths given, but the scene has " + rods + " rods: give one length per rod";
      if (status.index == -2) return "the scene has " + rods + " rods: lengths for a pose need exactly six";
      if (status.index == -3) return "the pose must be finite and its orientation a rotation";
      if (status.index >= scene_.rodCount()) return "the wrench must be finite";
      return "length of rod " + std::to_string(status.index + 1) + " is " + value + " m: must be " + kLengths.text() +
             " m; is it in another unit?";
    case SolveCode::kOutOfRange:
      break;
    case SolveCode::kNotConverged:
      return "no equilibrium found within the bound on iterations: the lengths may not fit one another, or the loads "
             "be too large";
    case SolveCode::kUnstable:
      return "only an unstable equilibrium was found: a rod or the platform would buckle; lower the loads, or choose "
             "lengths that differ less";
  }
  return "unknown status";
}

}  // namespace live_stiffness
