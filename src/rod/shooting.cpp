#include "live_stiffness/rod/shooting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace live_stiffness {

void prepare(const Chain& chain, const DeadLoads& loads, Backbone& backbone) {
  const GaussLegendre& table = gaussLegendre(backbone.passes->stages);
  auto element = backbone.elements.begin();
  for (const Chain::Part& part : chain.parts) {
    if (part.segment < 0) continue;
    const RestState& rest = backbone.rest[part.segment];
    const int count = backbone.element_count[part.segment];
    const double length = rest.stretch * part.length;
    for (int k = 0; k < count; ++k, ++element) {
      const Vector3 turn_before = element->state.length * Vector3(element->state.rest_curvature);
      element->state.length = length / count;
      element->start = k * element->state.length;
      element->setSection(rest);
      const Vector3 turn = element->state.length * rest.curvature - turn_before;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= kMaxStages; ++j) element->state.g[i][j] += turn[i] * table.c[j];
      element->setLoads(part.mass / length * loads.gravity);
    }
  }
}

Sweep sweep(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, Pass pass, Backbone& backbone) {
  Sweep result;
  result.sound = true;
  const double largest_size = largestSize(backbone.passes->stages);
  Pose X;
  Vector3 n = loads.baseForce(chain);
  Vector3 m = base_moment;
  auto element = backbone.elements.begin();
  for (const Chain::Part& part : chain.parts) {
    if (part.segment < 0) {
      const Vector3 along = part.length * X.R.col(2);
      const Vector3 weight = part.mass * loads.gravity;
      n -= weight;
      m -= along.cross(n) + 0.5 * along.cross(weight);
      X.p += along;
      continue;
    }
    for (int k = 0; k < backbone.element_count[part.segment]; ++k, ++element) {
      element->setStart(X, n, m);
      switch (pass) {
        case Pass::kOnce: backbone.passes->pass(element->state); break;
        case Pass::kFinish: backbone.passes->finish(element->state); break;
        case Pass::kAnew:
          resetGuess(*element);
          result.sound = integrate(*backbone.passes, *element) && result.sound;
      }
      X = element->X_end();
      n = element->n_end();
      m = element->m_end();
      result.change = std::max(result.change, element->state.change);
      result.sound = result.sound && element->state.size <= largest_size;
    }
  }
  const Vector3 offset = X.R * chain.tip_offset;
  backbone.X_BT = {X.R, X.p + offset};
  result.residual = m - offset.cross(n) - angular(loads.tip);
  result.sound = result.sound && result.residual.allFinite();
  return result;
}

bool shoot(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, bool nodes_hold_guess,
           Backbone& backbone, Vector3& residual) {
  constexpr int kMaxSweeps = 100;
  constexpr double kConverged = 2e-16, kWobble = 1e-13;  // rad
  double last_change = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMaxSweeps; ++i) {
    const bool anew = i == 0 && !nodes_hold_guess;
    const Sweep s = sweep(chain, loads, base_moment, anew ? Pass::kAnew : Pass::kFinish, backbone);
    residual = s.residual;
    if (!s.sound) return false;
    // Rounding can leave a last-digit wobble just above the bound: stop there once it no longer shrinks.
    if (s.change <= kConverged || (s.change <= kWobble && s.change >= last_change)) return true;
    last_change = s.change;
  }
  return false;
}

double tipColumns(const Chain& chain, const DeadLoads& loads, bool fresh, double goal, Backbone& backbone,
                  ElementColumns& columns) {
  columns = {};
  columnsOf(columns.m).leftCols<3>().setIdentity();
  double change = 0.0;
  const auto along_rigid = [&](const Vector3& along, const Vector3& n) {
    const Matrix3X6 moved = -hat(along) * columnsOf(columns.phi);  // phi x along
    columnsOf(columns.p) += moved;
    columnsOf(columns.m) += hat(n) * moved;
    columnsOf(columns.m).rightCols<3>() -= hat(along);
  };
  Matrix3 R = Matrix3::Identity();
  Vector3 n = loads.baseForce(chain);
  auto element = backbone.elements.begin();
  for (const Chain::Part& part : chain.parts) {
    if (part.segment < 0) {
      const Vector3 weight = part.mass * loads.gravity;
      n -= weight;
      along_rigid(part.length * R.col(2), n + 0.5 * weight);  // the weight has half the lever
      continue;
    }
    for (int k = 0; k < backbone.element_count[part.segment]; ++k, ++element) {
      const ElementColumns start = columns;
      if (fresh) resetColumns(start, element->state);
      change = std::max(change, propagate(*backbone.passes, *element, start, goal, columns));
    }
    const RodElement& last = *std::prev(element);
    R = last.X_end().R;
    n = last.n_end();
  }
  if (!chain.tip_offset.isZero(0.0)) along_rigid(R * chain.tip_offset, n);
  return change;
}

}  // namespace live_stiffness
