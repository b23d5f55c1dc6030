#pragma once
// An element without external load that bends equally in all directions is an arc of a circle: pose and material compliance
// of its sections in closed form. Each lane is one section. See docs/derivation.md, section 7.
//
// With the angle theta = s |u_rest|, q3 the tangent at the start, q1 normal to it in the plane of the arc, q2 = q3 x q1:
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
  PackMatrix R;
  Lanes3 r;                      // from the start
  Pack compliance[kPackedRow];   // about the section
};

LIVE_STIFFNESS_INLINE void setPlane(ElementState& e) {
  const double* u = e.rest_curvature;
  const double square = u[0] * u[0] + u[1] * u[1];
  const bool straight = !(square > 1e-290);  // smaller squares lose digits, and then any axis is right
  const double root = __builtin_sqrt(square), per_root = 1.0 / root;
  const double ax = straight ? 1.0 : per_root * u[0], ay = straight ? 0.0 : per_root * u[1];
  e.arc_square = straight ? 0.0 : square;
  e.arc_curvature = straight ? 0.0 : root;
  e.arc_axis[0] = ax, e.arc_axis[1] = ay;
  const Matrix R = get(e.R_start);
  put(ay * R.x - ax * R.y, e.arc_q1);
  put(ax * R.x + ay * R.y, e.arc_q2);
  put(R.z, e.arc_q3);
}

LIVE_STIFFNESS_INLINE Arc arcTo(const ElementState& e, Pack s) {
  const double ax = e.arc_axis[0], ay = e.arc_axis[1];
  const double(&q1)[3] = e.arc_q1, (&q2)[3] = e.arc_q2, (&q3)[3] = e.arc_q3;
  const Pack s2 = s * s, s3 = s2 * s, angle = e.arc_curvature * s, x = e.arc_square * s2;
  const Pack c = series(kCosine, x), t = series(kThird, x), t2 = 0.25 * (t + c - x * t * c);  // t of twice the angle
  const Pack sine = 1.0 - x * t, d3 = 1.0 - x * c, d1 = angle * sine, r3 = s * sine, r1 = s * angle * c;

  Arc arc;
  Pack across[3], along[3];  // q1 and q3 turned by the angle about q2
  for (int i = 0; i < 3; ++i) {
    across[i] = d3 * q1[i] - d1 * q3[i];
    along[i] = d1 * q1[i] + d3 * q3[i];
  }
  arc.r = {r1 * q1[0] + r3 * q3[0], r1 * q1[1] + r3 * q3[1], r1 * q1[2] + r3 * q3[2]};
  arc.R = {{ay * across[0] + ax * q2[0], ay * across[1] + ax * q2[1], ay * across[2] + ax * q2[2]},
           {ay * q2[0] - ax * across[0], ay * q2[1] - ax * across[1], ay * q2[2] - ax * across[2]},
           {along[0], along[1], along[2]}};

  // Integrals of d d^T, r, r r^T, and of r x d = q2 s theta c times d and itself.
  const Pack d1d1 = 2.0 * s * x * t2, d3d3 = s - d1d1, d1d3 = 0.5 * s * angle * sine * sine;
  const Pack int_r1 = s2 * angle * t, int_r3 = s2 * c;
  const Pack r3r3 = 2.0 * s3 * t2, r1r1 = 2.0 * s3 * (t - t2), r1r3 = 0.5 * s3 * angle * c * c;
  const Pack xd1 = 0.5 * s2 * x * c * c, xd3 = s2 * angle * (2.0 * t2 - t), xx = r1r1;

  const double cb = e.bend_xx, db = e.torsion - e.bend_xx, cs = e.shear, ds = e.elongation - e.shear;
  const Pack P11 = cs * s + ds * d1d1 + cb * r3r3, P22 = cs * s + cb * (r1r1 + r3r3) + db * xx,
              P33 = cs * s + ds * d3d3 + cb * r1r1, P13 = cb * r1r3 - ds * d1d3;
  const Pack K12 = cb * int_r3, K21 = -(cb * int_r3 + db * xd1), K23 = db * xd3 - cb * int_r1, K32 = cb * int_r1;
  const Pack bend = cb * s, D11 = db * d1d1, D33 = db * d3d3, D13 = -db * d1d3;  // W = bend I + D

  // Seen from its end it is the same arc, with that end's basis q1', -q2, -q3' instead of q1, q2, q3: hence the signs.
  Pack P1[3], P3[3], D1[3], D3[3], K1[3], K3[3];
  for (int i = 0; i < 3; ++i) {
    P1[i] = P11 * across[i] + P13 * along[i], P3[i] = P13 * across[i] + P33 * along[i];
    D1[i] = D11 * across[i] + D13 * along[i], D3[i] = D13 * across[i] + D33 * along[i];
    K1[i] = K12 * across[i] + K32 * along[i], K3[i] = K21 * across[i] + K23 * along[i];
  }
  arc.compliance[21] = arc.compliance[22] = arc.compliance[23] = Pack{};
  int k = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j, ++k) {
      arc.compliance[k] = across[i] * P1[j] + along[i] * P3[j] + (q2[i] * q2[j]) * P22;
      arc.compliance[15 + k] = across[i] * D1[j] + along[i] * D3[j];
      if (i == j) arc.compliance[15 + k] += bend;
    }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) arc.compliance[6 + 3 * i + j] = K1[i] * q2[j] + q2[i] * K3[j];
  return arc;
}

// End and compliance of the element.
inline void placeArc(ElementState& e) {
  setPlane(e);
  const Arc arc = arcTo(e, splat(e.length));
  const Pack R[9] = {arc.R.x.x, arc.R.y.x, arc.R.z.x, arc.R.x.y, arc.R.y.y,
                      arc.R.z.y, arc.R.x.z, arc.R.y.z, arc.R.z.z};
  storeFirst(R, e.R_end);
  put(Vector{arc.r.x[0], arc.r.y[0], arc.r.z[0]}, e.offset_end);
  for (int i = 0; i < 3; ++i) e.n_end[i] = e.m_end[i] = 0.0;
  storeFirst(arc.compliance, e.compliance);
  e.is_arc = e.unloaded = true;
  e.station_error = 0.0;
}

inline void arcStations(const ElementState& e, const StationBatch& s, const StationResults& out, int v) {
  Arc arc = arcTo(e, e.length * load(s.fraction, v));
  if (!isZero(e.start_compliance)) {
    Pack before[kPackedSize];
    for (int i = 0; i < kPackedSize; ++i) before[i] = splat(e.start_compliance[i]);
    shift(arc.r, before);
    for (int i = 0; i < kPackedSize; ++i) arc.compliance[i] += before[i];
  }
  storeSections(e, out, v, arc.R, arc.r, arc.compliance);
}

}  // namespace
}  // namespace live_stiffness
