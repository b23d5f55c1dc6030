#include "rod/nodal_rotations.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lie/cayley.h"

namespace live_stiffness {

NodalRotations::NodalRotations(const Chain& chain) {
  for (const Chain::Part& part : chain.parts)
    if (part.segment >= 0) intervals.push_back(1);
  R.reserve(1 + intervals.size() * kMostIntervals);
}

void NodalRotations::resize(const Backbone& backbone, int each) {
  for (size_t k = 0; k < intervals.size(); ++k) intervals[k] = std::min(kMostIntervals, each * backbone.element_count[k]);
  makeNodes();
}

void NodalRotations::resize(const std::vector<double>& demand, double spacing) {
  constexpr double kLeast = 2.0;
  for (size_t k = 0; k < intervals.size(); ++k)
    intervals[k] = static_cast<int>(std::ceil(std::min<double>(kMostIntervals, std::max(kLeast, demand[k] / spacing))));
  makeNodes();
}

void NodalRotations::makeNodes() {
  R.resize(1 + std::accumulate(intervals.begin(), intervals.end(), 0));
  R[0].setIdentity();
}

void NodalRotations::takeUnloaded(const Chain& chain, const Backbone& backbone) {
  auto node = R.begin();
  for (const Chain::Part& part : chain.parts) {
    if (part.segment < 0) continue;
    const RestState& rest = backbone.rest[part.segment];
    const int count = intervals[part.segment];
    const Matrix3 step = expSo3(rest.stretch * part.length / count * rest.curvature);
    for (int i = 0; i < count; ++i, ++node) node[1] = node[0] * step;
  }
}

void NodalRotations::take(const Backbone& backbone) {
  const int stages = backbone.kernel->stages;
  const GaussLegendre& table = gaussLegendre(stages);
  auto node = R.begin() + 1;
  for (size_t k = 0; k < intervals.size(); ++k) {
    const int count = backbone.element_count[k], first = backbone.firstElement(static_cast<int>(k));
    for (int i = 1; i <= intervals[k]; ++i, ++node) {
      const double along = static_cast<double>(i) / intervals[k] * count;
      const int element = std::min(static_cast<int>(along), count - 1);
      const double x = along - element;
      const ElementState& e = backbone.elements[first + element].state;
      int after = 0;  // the first of the element's nodes beyond x
      while (after < stages && table.c[after] < x) ++after;
      const double from = after == 0 ? 0.0 : table.c[after - 1], share = (x - from) / (table.c[after] - from);
      Vector3 g;
      for (int j = 0; j < 3; ++j) {
        const double before = after == 0 ? 0.0 : e.g[j][after - 1];
        g[j] = before + share * (e.g[j][after] - before);
      }
      *node = backbone.elements[first + element].X_start().R * cayleyRotation(g);
    }
  }
}

double NodalRotations::bending(int segment) const {
  double sum = 0.0;
  const int first = std::accumulate(intervals.begin(), intervals.begin() + segment, 0);
  for (int i = first; i < first + intervals[segment]; ++i)
    sum += 2.0 * std::atan(0.5 * cayleyVector(R[i].transpose() * R[i + 1]).norm());
  return sum;
}

Matrix3 NodalRotations::at(int first, int count, double fraction) const {
  const double along = fraction * count;
  const int i = std::clamp(static_cast<int>(along), 0, count - 1);
  const Matrix3& before = R[first + i];
  return before * cayleyRotation((along - i) * cayleyVector(before.transpose() * R[first + i + 1]));
}

void NodalRotations::place(Backbone& backbone) const {
  const int stages = backbone.kernel->stages;
  const GaussLegendre& table = gaussLegendre(stages);
  int first = 0, element = 0;
  for (size_t k = 0; k < intervals.size(); ++k) {
    const int count = backbone.element_count[k];
    for (int i = 0; i < count; ++i, ++element) {
      const Matrix3 start = at(first, intervals[k], static_cast<double>(i) / count);
      ElementState& e = backbone.elements[element].state;
      backbone.elements[element].setStart({start, Vector3::Zero()}, Vector3::Zero(), Vector3::Zero());
      for (int node = 0; node <= kMaxStages; ++node) {
        Vector3 g = Vector3::Zero();  // beyond the end, where lanes are not used
        if (node <= stages) g = cayleyVector(start.transpose() * at(first, intervals[k], (i + table.c[node]) / count));
        for (int j = 0; j < 3; ++j) e.g[j][node] = g[j];
      }
    }
    first += intervals[k];
  }
}

}  // namespace live_stiffness
