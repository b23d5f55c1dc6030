#include "live_stiffness/analysis/stiffness_criterion.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "csv_table.h"
#include "live_stiffness/analysis/directional_stiffness.h"
#include "live_stiffness/analysis/eigenscrews.h"
#include "live_stiffness/analysis/ellipsoid.h"
#include "live_stiffness/analysis/stiffness_matrix.h"

namespace live_stiffness {
namespace {

struct NamedKind {
  const char* name;
  CriterionKind kind;
};
constexpr NamedKind kKinds[] = {{"largest_eigenstiffness", CriterionKind::kLargestEigenstiffness},
                                {"smallest_eigenstiffness", CriterionKind::kSmallestEigenstiffness},
                                {"trace", CriterionKind::kTrace},
                                {"largest_stiffness", CriterionKind::kLargestStiffness},
                                {"smallest_stiffness", CriterionKind::kSmallestStiffness},
                                {"directional", CriterionKind::kDirectional},
                                {"constrained", CriterionKind::kConstrained}};

bool hasDirection(CriterionKind kind) {
  return kind == CriterionKind::kDirectional || kind == CriterionKind::kConstrained;
}

}  // namespace

double StiffnessCriterion::operator()(const Matrix6& C) const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (kind == CriterionKind::kLargestEigenstiffness || kind == CriterionKind::kSmallestEigenstiffness) {
    const Eigenstiffnesses eta = eigenstiffnessesOfCompliance(C);
    return !eta.definite ? kNaN : eta.values[kind == CriterionKind::kLargestEigenstiffness ? 0 : 2];
  }
  if (Eigen::LLT<Matrix6>(0.5 * C + 0.5 * C.transpose()).info() != Eigen::Success) return kNaN;
  switch (kind) {
    case CriterionKind::kLargestStiffness: return 1.0 / ellipsoidOf(C.topLeftCorner<3, 3>()).half_axes[0];
    case CriterionKind::kSmallestStiffness: return 1.0 / ellipsoidOf(C.topLeftCorner<3, 3>()).half_axes[2];
    case CriterionKind::kDirectional: return freeStiffnessAlong(C, {Vector3::Zero(), direction});
    default: break;
  }
  const StiffnessMatrix stiffness = stiffnessOf(C);
  if (!stiffness.invertible) return kNaN;
  return kind == CriterionKind::kTrace ? stiffness.K.topLeftCorner<3, 3>().trace()
                                       : constrainedStiffnessAlong(stiffness.K, {Vector3::Zero(), direction});
}

std::string StiffnessCriterion::name() const {
  for (const NamedKind& named : kKinds)
    if (named.kind == kind)
      return hasDirection(kind) ? std::string(named.name) + ":" + numberText(direction.x()) + "," +
                                      numberText(direction.y()) + "," + numberText(direction.z())
                                : named.name;
  return "unknown";
}

const char* StiffnessCriterion::unit() const {
  return kind == CriterionKind::kLargestEigenstiffness || kind == CriterionKind::kSmallestEigenstiffness ? "N" : "N/m";
}

StiffnessCriterion criterionNamed(const std::string& text, FaultList& faults) {
  const size_t colon = text.find(':');
  const std::string word = text.substr(0, colon);
  for (const NamedKind& named : kKinds) {
    if (word != named.name || (colon != std::string::npos) != hasDirection(named.kind)) continue;
    StiffnessCriterion criterion;
    criterion.kind = named.kind;
    if (hasDirection(named.kind))
      criterion.direction = directionNamed("criterion " + word, text.substr(colon + 1), faults);
    return criterion;
  }
  faults.add("criterion = " + text + ": must be one of largest_eigenstiffness, smallest_eigenstiffness, trace, "
             "largest_stiffness, smallest_stiffness, directional:D, constrained:D with D x, y, z or dx,dy,dz");
  return {};
}

Vector3 directionNamed(const std::string& name, const std::string& text, FaultList& faults) {
  const bool negative = !text.empty() && text[0] == '-';
  const std::string axis = negative || (!text.empty() && text[0] == '+') ? text.substr(1) : text;
  if (axis.size() == 1 && axis[0] >= 'x' && axis[0] <= 'z')
    return Vector3::Unit(axis[0] - 'x') * (negative ? -1.0 : 1.0);
  const std::optional<std::vector<double>> numbers = numberList(text, ',');
  const bool good = numbers && numbers->size() == 3;
  const Vector3 direction = good ? Vector3(numbers->data()) : Vector3::Zero();
  const double size = direction.stableNorm();
  if (good && size > 0.0 && std::isfinite(size)) return direction / size;
  faults.add(name + " = " + text + ": must be x, y, z or three finite numbers dx,dy,dz that are not all zero");
  return Vector3::UnitX();
}

}  // namespace live_stiffness
