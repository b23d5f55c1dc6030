#pragma once
// Symmetric 6x6 compliances in 21 numbers (see kPackedSize), of one section or of one section in each lane.

#include "rod/matrix3_code.h"

namespace live_stiffness {
namespace {

// About the point o becomes about o + d: H C H^T with H = [I, -hat(d); 0, I], so that K -> K - hat(d) W and
// P -> P - hat(d) K^T + K_new hat(d).
template <class T>
LIVE_STIFFNESS_INLINE void shift(const T (&d)[3], T* at) {
  T *P = at, *K = at + 6;
  const T* W = at + 15;
  T a[3][3], w[3][3], b[3][3];
  for (int j = 0; j < 3; ++j) crossInto(d, K[3 * j], K[3 * j + 1], K[3 * j + 2], a[j]);
  crossInto(d, W[0], W[1], W[2], w[0]);
  crossInto(d, W[1], W[3], W[4], w[1]);
  crossInto(d, W[2], W[4], W[5], w[2]);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) K[3 * i + j] = K[3 * i + j] - w[j][i];
  for (int i = 0; i < 3; ++i) crossInto(d, K[3 * i], K[3 * i + 1], K[3 * i + 2], b[i]);
  P[0] = P[0] - (a[0][0] + b[0][0]);
  P[1] = P[1] - (a[1][0] + b[0][1]);
  P[2] = P[2] - (a[2][0] + b[0][2]);
  P[3] = P[3] - (a[1][1] + b[1][1]);
  P[4] = P[4] - (a[2][1] + b[1][2]);
  P[5] = P[5] - (a[2][2] + b[2][2]);
}

// One compliance, in a function of its own, since most are not shifted.
__attribute__((noinline)) void shiftOne(const double (&d)[3], PackedRow& at) { shift(d, at); }

// True at the base only: beyond it the robot can bend in every direction, so that its angular block is positive.
LIVE_STIFFNESS_INLINE bool isZero(const PackedRow& compliance) { return compliance[15] == 0.0; }

// Stores a batch of sections of an element, one in each lane. r: from the element's start, m; at: compliance of everything
// before the section, about it.
LIVE_STIFFNESS_INLINE void storeSections(const ElementState& e, const StationResults& out, int v, const PackMatrix& R,
                                         const Pack (&r)[3], const Pack* at) {
  const Pack pose[12] = {R.x.x, R.x.y, R.x.z, R.y.x, R.y.y, R.y.z, R.z.x, R.z.y, R.z.z, e.p_start[0] + r[0],
                          e.p_start[1] + r[1], e.p_start[2] + r[2]};
  const Pack *P = at, *K = at + 6, *W = at + 15;
  const Pack compliance[36] = {P[0], P[1], P[2], K[0], K[1], K[2],  //
                                P[1], P[3], P[4], K[3], K[4], K[5],  //
                                P[2], P[4], P[5], K[6], K[7], K[8],  //
                                K[0], K[3], K[6], W[0], W[1], W[2],  //
                                K[1], K[4], K[7], W[1], W[3], W[4],  //
                                K[2], K[5], K[8], W[2], W[4], W[5]};
  storeAcross(pose, out.pose + kPackSize * v);
  storeAcross(compliance, out.compliance + kPackSize * v);
}

}  // namespace
}  // namespace live_stiffness
