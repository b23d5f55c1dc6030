#pragma once
// Tangent compliance of a chain from the sensitivities (columns) at its tip: docs/derivation.md, section 5.

#include "rod/packed_compliance_code.h"

namespace live_stiffness {
namespace {

// A 6-vector [linear; angular] in SIMD vectors.
struct Six {
  static constexpr int kVectors = (6 + kPackSize - 1) / kPackSize;
  Pack v[kVectors];

  LIVE_STIFFNESS_INLINE Six(const double (&a)[3], const double (&b)[3]) {
#if LIVE_STIFFNESS_PACK == 4
    v[0] = Pack{a[0], a[1], a[2], b[0]}, v[1] = Pack{b[1], b[2], 0.0, 0.0};
#else
    v[0] = Pack{a[0], a[1]}, v[1] = Pack{a[2], b[0]}, v[2] = Pack{b[1], b[2]};
#endif
  }
  LIVE_STIFFNESS_INLINE void add(double k, const Six& a) {
    for (int i = 0; i < kVectors; ++i) v[i] += k * a.v[i];
  }
  // With four lanes it also writes the two numbers behind the column, unless it is the last.
  LIVE_STIFFNESS_INLINE void store(double* to, bool last) const {
    for (int i = 0; i < kVectors; ++i) {
      if (kPackSize * (i + 1) <= 6 || !last) storeUnaligned(to + kPackSize * i, v[i]);
      else for (int k = kPackSize * i; k < 6; ++k) to[k] = v[i][k % kPackSize];
    }
  }
};

// With dm0 = X df + Y dM, X = -A^-1 B, Y = A^-1 from the residual's columns [A, B]: [df; dM] to the twist of T is
// C = (Q + T^T G) T with T = [X, Y; I, 0], Q the twists of the columns and G their adjoint-weighted residual, if corrected.
// A_inverse, C: column-major.
void tangent(const ElementSensitivities& tip, bool correct, double* A_inverse, double* C) {
  double row[3][3], Y[3][3], X[3][3];  // Y[k][j], X[k][j]: entry (k, j)
  crossInto(tip.m[1], tip.m[2][0], tip.m[2][1], tip.m[2][2], row[0]);
  crossInto(tip.m[2], tip.m[0][0], tip.m[0][1], tip.m[0][2], row[1]);
  crossInto(tip.m[0], tip.m[1][0], tip.m[1][1], tip.m[1][2], row[2]);
  const double scale = 1.0 / (tip.m[0][0] * row[0][0] + tip.m[0][1] * row[0][1] + tip.m[0][2] * row[0][2]);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) A_inverse[3 * j + k] = Y[k][j] = scale * row[k][j];
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      X[k][j] = -(Y[k][0] * tip.m[3 + j][0] + Y[k][1] * tip.m[3 + j][1] + Y[k][2] * tip.m[3 + j][2]);

  Six H[6] = {{tip.p[0], tip.phi[0]}, {tip.p[1], tip.phi[1]}, {tip.p[2], tip.phi[2]},
              {tip.p[3], tip.phi[3]}, {tip.p[4], tip.phi[4]}, {tip.p[5], tip.phi[5]}};
  if (correct) {
    const Six T[3] = {{X[0], Y[0]}, {X[1], Y[1]}, {X[2], Y[2]}};
    const double nothing[3] = {};
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < 3; ++k) H[j].add(tip.adjoint_residual[k][j], T[k]);
      H[j].add(1.0, Six({tip.adjoint_residual[3][j], tip.adjoint_residual[4][j], tip.adjoint_residual[5][j]}, nothing));
    }
  }
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    const double(*row)[3] = j < 3 ? X : Y;
    Six column = j < 3 ? H[3 + j] : Six({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    for (int k = 0; k < 3; ++k) column.add(row[k][j % 3], H[k]);
    column.store(C + 6 * j, j == 5);
  }
}

}  // namespace
}  // namespace live_stiffness
