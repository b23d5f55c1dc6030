#pragma once
// An element on which nothing external acts and which bends the same in all directions is an arc of a circle: pose and
// material compliance of any of its sections in closed form. One lane is one section. See docs/derivation.md.
//
// With the angle theta = s |u_rest|, q1 in the plane of the arc and across its first tangent q3, q2 = q3 x q1 its axis:
//   d = q1 sin(theta) + q3 cos(theta),   r = s (q1 (1 - cos(theta)) + q3 sin(theta)) / theta,
//   S = c_s I + (c_e - c_s) d d^T,   B = c_b I + (c_t - c_b) d d^T,
// so that all entries of (10) are integrals of powers of sines and cosines, and these are polynomials in
//   c = (1 - cos(theta)) / theta^2,   t = (theta - sin(theta)) / theta^3.

#include "rod/element_section_code.h"
#include "rod/packed_compliance_code.h"

namespace live_stiffness {
namespace {

LIVE_STIFFNESS_INLINE bool bendsAsArc(const ElementState& e) {
  return e.bend_xx == e.bend_yy && e.bend_xy == 0.0 && e.rest_curvature[2] == 0.0;
}

struct Arc {
  LanesMatrix R;
  Lanes r[3];             // from the start
  Lanes compliance[kPackedSize];  // about the start
};

LIVE_STIFFNESS_INLINE void setPlane(ElementState& e) {
  const double* u = e.rest_curvature;
  const double square = u[0] * u[0] + u[1] * u[1];
  const bool straight = !(square > 1e-290);  // below, digits of the square are lost, and any axis will do
  e.arc_curvature = straight ? 0.0 : __builtin_sqrt(square);
  const double ax = straight ? 1.0 : u[0] / e.arc_curvature, ay = straight ? 0.0 : u[1] / e.arc_curvature;
  e.arc_axis[0] = ax, e.arc_axis[1] = ay;
  rotate(e.R_start, {ay, -ax, 0.0}, e.arc_q1);
  rotate(e.R_start, {ax, ay, 0.0}, e.arc_q2);
  rotate(e.R_start, {0.0, 0.0, 1.0}, e.arc_q3);
}

LIVE_STIFFNESS_INLINE Arc arcTo(const ElementState& e, Lanes s) {
  const double ax = e.arc_axis[0], ay = e.arc_axis[1], curvature = e.arc_curvature;
  const double(&q1)[3] = e.arc_q1, (&q2)[3] = e.arc_q2, (&q3)[3] = e.arc_q3;
  const Lanes angle = curvature * s, x = angle * angle;
  const Lanes c = series(kCosine, x), t = series(kThird, x), t2 = 0.25 * (t + c - x * t * c);  // t of twice the angle
  const Lanes sine = 1.0 - x * t, d3 = 1.0 - x * c, d1 = angle * sine, r3 = s * sine, r1 = s * angle * c;

  // Integrals of d d^T, r, r r^T, and of r x d = q2 s theta c times d and itself.
  const Lanes s2 = s * s, s3 = s2 * s;
  const Lanes d1d1 = 2.0 * s * x * t2, d3d3 = s - d1d1, d1d3 = 0.5 * s * angle * sine * sine;
  const Lanes int_r1 = s2 * angle * t, int_r3 = s2 * c;
  const Lanes r3r3 = 2.0 * s3 * t2, r1r1 = 2.0 * s3 * (t - t2), r1r3 = 0.5 * s3 * angle * c * c;
  const Lanes xd1 = 0.5 * s2 * x * c * c, xd3 = s2 * angle * (2.0 * t2 - t), xx = r1r1;

  const double cb = e.bend_xx, db = e.torsion - e.bend_xx, cs = e.shear, ds = e.elongation - e.shear;
  const Lanes P11 = cs * s + ds * d1d1 + cb * r3r3, P22 = cs * s + cb * (r1r1 + r3r3) + db * xx,
              P33 = cs * s + ds * d3d3 + cb * r1r1, P13 = ds * d1d3 - cb * r1r3;
  const Lanes K12 = -cb * int_r3, K21 = cb * int_r3 + db * xd1, K23 = db * xd3 - cb * int_r1, K32 = cb * int_r1;
  const Lanes W11 = cb * s + db * d1d1, W22 = cb * s, W33 = cb * s + db * d3d3, W13 = db * d1d3;

  Arc arc;
  int k = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j, ++k) {
      const double q11 = q1[i] * q1[j], q22 = q2[i] * q2[j], q33 = q3[i] * q3[j], q13 = q1[i] * q3[j] + q3[i] * q1[j];
      arc.compliance[k] = q11 * P11 + q22 * P22 + q33 * P33 + q13 * P13;
      arc.compliance[15 + k] = q11 * W11 + q22 * W22 + q33 * W33 + q13 * W13;
    }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      arc.compliance[6 + 3 * i + j] =
          (q1[i] * q2[j]) * K12 + (q2[i] * q1[j]) * K21 + (q2[i] * q3[j]) * K23 + (q3[i] * q2[j]) * K32;
  Lanes across[3], along[3];  // q1 and q3 turned by the angle about q2
  for (int i = 0; i < 3; ++i) {
    across[i] = d3 * q1[i] - d1 * q3[i];
    along[i] = d1 * q1[i] + d3 * q3[i];
    arc.r[i] = r1 * q1[i] + r3 * q3[i];
  }
  arc.R = {{ay * across[0] + ax * q2[0], ay * across[1] + ax * q2[1], ay * across[2] + ax * q2[2]},
           {ay * q2[0] - ax * across[0], ay * q2[1] - ax * across[1], ay * q2[2] - ax * across[2]},
           {along[0], along[1], along[2]}};
  return arc;
}

// End and compliance of the element.
inline void placeArc(ElementState& e) {
  setPlane(e);
  const Arc arc = arcTo(e, splat(e.length));
  const Lanes R[9] = {arc.R.x.x, arc.R.y.x, arc.R.z.x, arc.R.x.y, arc.R.y.y,
                      arc.R.z.y, arc.R.x.z, arc.R.y.z, arc.R.z.z};
  for (int i = 0; i < 9; ++i) e.R_end[i] = R[i][0];
  for (int i = 0; i < 3; ++i) {
    e.offset_end[i] = arc.r[i][0];
    e.n_end[i] = e.m_end[i] = 0.0;
  }
  for (int i = 0; i < kPackedSize; ++i) e.compliance[i] = arc.compliance[i][0];
  e.is_arc = e.unloaded = true;
  e.compliance_error = e.station_error = 0.0;
}

inline void arcStations(const ElementState& e, const StationBatch& s, int v) {
  const Arc arc = arcTo(e, e.length * load(s.fraction, v));
  storeSections(e, s, v, arc.R, arc.r, arc.compliance);
}

}  // namespace
}  // namespace live_stiffness
