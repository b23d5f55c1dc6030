#include "live_stiffness/rod/shooting.h"

#include <Eigen/Geometry>
#include <iterator>

namespace live_stiffness {

Vector3 baseForce(const Scene& scene, const DeadLoads& loads) {
  double mass = scene.tip_mass;
  walk(
      scene, [&](int, const Segment& segment) { mass += segment.mass(); },
      [&](const Link& link) { mass += link.mass; });
  return linear(loads.tip) + mass * loads.gravity;
}

Vector3 lineLoad(const Segment& segment, const RestState& rest, const DeadLoads& loads) {
  return segment.section.linearDensity() / rest.stretch * loads.gravity;
}

bool shoot(const Scene& scene, const DeadLoads& loads, const Vector3& base_moment, bool nodes_hold_guess,
           Backbone& backbone, Vector3& residual) {
  Pose X;
  Vector3 n = baseForce(scene, loads);
  Vector3 m = base_moment;
  auto element = backbone.elements.begin();
  bool converged = true;
  walk(
      scene,
      [&](int index, const Segment& segment) {
        const RestState& rest = backbone.rest[index];
        const Vector3 line_load = lineLoad(segment, rest, loads);
        const int count = backbone.element_count[index];
        for (int k = 0; k < count && converged; ++k, ++element) {
          element->segment = index;
          element->length = rest.stretch * segment.length / count;
          element->start = k * element->length;
          element->X_start = X;
          element->n_start = n;
          element->m_start = m;
          element->line_load = line_load;
          if (!nodes_hold_guess) resetGuess(rest, *element);
          converged = integrate(rest, *element);
          X = element->X_end;
          n = element->n_end;
          m = element->m_end;
        }
      },
      [&](const Link& link) {
        const Vector3 along = link.length * X.R.col(2);
        const Vector3 weight = link.mass * loads.gravity;
        n -= weight;
        m -= along.cross(n) + 0.5 * along.cross(weight);
        X.p += along;
      });
  if (!converged) return false;
  const Vector3 offset = X.R * scene.tip_offset;
  backbone.X_BT = {X.R, X.p + offset};
  residual = m - offset.cross(n) - angular(loads.tip);
  return residual.allFinite();
}

StateColumns tipColumns(const Scene& scene, const DeadLoads& loads, const Backbone& backbone) {
  StateColumns columns;
  columns.m.leftCols<3>().setIdentity();
  columns.n.rightCols<3>().setIdentity();
  auto element = backbone.elements.begin();
  const auto along_rigid = [&](const Vector3& along, const Vector3& n) {
    const Matrix3X6 moved = -hat(along) * columns.phi;  // phi x along
    columns.p += moved;
    columns.m += hat(n) * moved - hat(along) * columns.n;
  };
  Matrix3 R = Matrix3::Identity();
  Vector3 n = baseForce(scene, loads);
  walk(
      scene,
      [&](int index, const Segment&) {
        for (int k = 0; k < backbone.element_count[index]; ++k, ++element)
          propagate(backbone.rest[index], *element, columns);
        R = std::prev(element)->X_end.R;
        n = std::prev(element)->n_end;
      },
      [&](const Link& link) {
        const Vector3 weight = link.mass * loads.gravity;
        n -= weight;
        along_rigid(link.length * R.col(2), n + 0.5 * weight);  // the weight has half the lever
      });
  along_rigid(R * scene.tip_offset, n);
  return columns;
}

}  // namespace live_stiffness
