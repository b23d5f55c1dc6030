#pragma once
// Symmetric 6x6 compliances in 21 numbers (see kPackedSize), of one section or of one section in each lane.

#include "rod/vector3_code.h"

namespace live_stiffness {
namespace {

// About the point o becomes about o + d: H C H^T with H = [I, -hat(d); 0, I], so that K -> K - hat(d) W and
// P -> P - hat(d) K^T + K_new hat(d).
template <class T>
LIVE_STIFFNESS_INLINE void shift(const VectorOf<T>& d, T* at) {
  T *P = at, *K = at + 6;
  const T* W = at + 15;
  const auto across = [&](T x, T y, T z) { return cross(d, VectorOf<T>{x, y, z}); };
  const VectorOf<T> a0 = across(K[0], K[1], K[2]), a1 = across(K[3], K[4], K[5]), a2 = across(K[6], K[7], K[8]);
  const VectorOf<T> w[3] = {across(W[0], W[1], W[2]), across(W[1], W[3], W[4]), across(W[2], W[4], W[5])};
  for (int j = 0; j < 3; ++j) K[j] -= w[j].x, K[3 + j] -= w[j].y, K[6 + j] -= w[j].z;
  const VectorOf<T> b0 = across(K[0], K[1], K[2]), b1 = across(K[3], K[4], K[5]), b2 = across(K[6], K[7], K[8]);
  P[0] -= a0.x + b0.x, P[1] -= a1.x + b0.y, P[2] -= a2.x + b0.z;
  P[3] -= a1.y + b1.y, P[4] -= a2.y + b1.z, P[5] -= a2.z + b2.z;
}

// One compliance, in a function of its own, since most are not shifted.
__attribute__((noinline)) void shiftOne(const Vector& d, PackedRow& at) { shift(d, at); }

// True at the base only: beyond it the robot can bend in every direction, so that its angular block is positive.
LIVE_STIFFNESS_INLINE bool isZero(const PackedRow& compliance) { return compliance[15] == 0.0; }

// Stores a batch of sections of an element, one in each lane. r: from the element's start, m; at: compliance of everything
// before the section, about it.
LIVE_STIFFNESS_INLINE void storeSections(const ElementState& e, const StationResults& out, int v, const PackMatrix& R,
                                         const Lanes3& r, const Pack* at) {
  const Pack pose[12] = {R.x.x, R.x.y, R.x.z, R.y.x, R.y.y, R.y.z, R.z.x, R.z.y, R.z.z, e.p_start[0] + r.x,
                          e.p_start[1] + r.y, e.p_start[2] + r.z};
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
