#include "live_stiffness/rod/conjugate_points.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace live_stiffness {
namespace {

// All eigenvalues of a matrix that has three real ones are positive.
bool hasPositiveEigenvalues(const Matrix3& G) {
  const double minors = G(0, 0) * G(1, 1) - G(0, 1) * G(1, 0) + G(0, 0) * G(2, 2) - G(0, 2) * G(2, 0) +
                        G(1, 1) * G(2, 2) - G(1, 2) * G(2, 1);
  return G.trace() > 0.0 && minors > 0.0 && G.determinant() > 0.0;
}

}  // namespace

bool hasConjugatePoint(const Scene& scene, const DeadLoads& loads, const Backbone& backbone) {
  StateColumns columns;
  columns.m.leftCols<3>().setIdentity();
  Matrix3 before = Matrix3::Zero(), R = Matrix3::Identity();
  Vector3 n = baseForce(scene, loads);
  bool found = false;
  auto element = backbone.elements.begin();
  walk(
      scene,
      [&](int index, const Segment&) {
        for (int k = 0; k < backbone.element_count[index]; ++k, ++element) {
          propagate(backbone.rest[index], *element, columns);
          const Matrix3 phi = columns.phi.leftCols<3>();
          if (!before.isZero(0.0) && !found) found = !hasPositiveEigenvalues(phi * before.inverse());
          before = phi;
          R = element->X_end.R;
          n = element->n_end;
        }
      },
      [&](const Link& link) {  // turns as one, see tipColumns()
        const Vector3 weight = link.mass * loads.gravity;
        n -= weight;
        columns.m -= hat(n + 0.5 * weight) * hat(link.length * R.col(2)) * columns.phi;
      });
  return found;
}

}  // namespace live_stiffness
