#include "live_stiffness/compliance/material_compliance.h"

#include <algorithm>

namespace live_stiffness {

Matrix6 elementCompliance(const RestState& rest, const RodElement& element, const Vector3& p_B) {
  // With r from the point to the section and S = R c_se R^T, B = R c_bt R^T, (3) about the point is
  // [S + r^ B r^T^, r^ B; B r^T^, B].
  Matrix6 C = Matrix6::Zero();
  for (int i = 0; i < kStages; ++i) {
    const Matrix3& R = element.X[i].R;
    const Matrix3 r_hat = hat(element.X[i].p - p_B);
    const Matrix3 B = R * (element.weight(i) * rest.c.bending_torsion) * R.transpose();
    const Matrix3 r_hat_B = r_hat * B;
    C.topLeftCorner<3, 3>() += R * (element.weight(i) * rest.c.shear_elongation) * R.transpose() -
                               r_hat_B * r_hat;
    C.topRightCorner<3, 3>() += r_hat_B;
    C.bottomRightCorner<3, 3>() += B;
  }
  C.bottomLeftCorner<3, 3>() = C.topRightCorner<3, 3>().transpose();
  return C;
}

Matrix6 tipMaterialCompliance(const Backbone& backbone) {
  Matrix6 C = Matrix6::Zero();
  for (const RodElement& element : backbone.elements)
    C += elementCompliance(backbone.rest[element.segment], element, backbone.X_BT.p);
  return C;
}

Station stationAt(const Backbone& backbone, int segment, double fraction, bool loaded) {
  const RestState& rest = backbone.rest[segment];
  const int first = backbone.firstElement(segment);
  const double along = std::clamp(fraction, 0.0, 1.0) * backbone.element_count[segment];
  const int whole = std::min(static_cast<int>(along), backbone.element_count[segment] - 1);
  const RodElement& element = backbone.elements[first + whole];
  const double part = along - whole;

  Station station;
  station.stretch = rest.stretch;
  if (part > 0.0) {
    const RodElement piece = part < 1.0 ? pieceOf(rest, element, part * element.length, loaded) : element;
    station.X_BS = piece.X_end;
    station.compliance = elementCompliance(rest, piece, station.X_BS.p);
  } else {
    station.X_BS = element.X_start;
  }
  for (int k = 0; k < first + whole; ++k) {
    const RodElement& before = backbone.elements[k];
    station.compliance += elementCompliance(backbone.rest[before.segment], before, station.X_BS.p);
  }
  return station;
}

}  // namespace live_stiffness
