#pragma once
// Newton's step of multiple shooting, stability and tangent compliance by a Riccati sweep over the joints: docs/derivation.md,
// sections 4 and 5. Every element has its own start values; a joint is where one element ends and the next one starts.

#include "rod/element_shape_code.h"

namespace live_stiffness {
namespace {

// One number of each of six columns; two more are not used, to fill SIMD vectors.
struct Six {
  static constexpr int kPacks = 8 / kPackSize;
  Pack at[kPacks];

  // The unit column j.
  static LIVE_STIFFNESS_INLINE Six unit(int j) {
    Six row{};
    row.at[j / kPackSize][j % kPackSize] = 1.0;
    return row;
  }
  LIVE_STIFFNESS_INLINE void add(double k, const Six& a) {
    for (int v = 0; v < kPacks; ++v) at[v] += k * a.at[v];
  }
  LIVE_STIFFNESS_INLINE double operator[](int j) const { return at[j / kPackSize][j % kPackSize]; }
};
// Rows of the sensitivities of an element by what they are by: end of the element from its start.
template <int kCount>
LIVE_STIFFNESS_INLINE void addEnd(const double (&part)[kColumns][3], const Six* start, Six* end) {
#pragma GCC unroll 9
  for (int c = 0; c < kCount; ++c)
    for (int i = 0; i < 3; ++i) end[i].add(part[c][i], start[c]);
}
// twist += a^T G a.
template <int kCount>
LIVE_STIFFNESS_INLINE void addAdjointResidual(const ElementTransfer& t, const Six* start, Six* twist) {
  for (int c = 0; c < kCount; ++c) {
    Six work{};
#pragma GCC unroll 9
    for (int l = 0; l < kCount; ++l) work.add(t.adjoint_residual[c][l], start[l]);
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) twist[i].add(start[c][i], work);
  }
}

struct Joints {
  // S = 0 at T, whose moment is dead; M = D - S B, and S of the element's start is M^-1 (S A - C). Returns in how
  // many directions the equilibrium is not stable: M B^-1 = D B^-1 - S is the stiffness of the joint for a clamped start of the
  // element, a pivot of the block Cholesky factorisation of the second variation. clamped: T cannot turn either.
  static int factorise(ElementState* elements, int count, bool clamped) {
    Matrix S{};
    int unstable = 0;
    for (int k = count - 1; k >= 0; --k) {
      ElementState& e = elements[k];
      const ElementTransfer& t = e.transfer;
      const bool clamped_end = clamped && k == count - 1;
      const Matrix B = columns(t.phi + kOfMoment), D = columns(t.m + kOfMoment);
      const Matrix M = clamped_end ? B : D - S * B;
      if (!clamped_end) unstable += notPositive(M * inverse(B));
      const Matrix M_inverse = inverse(M);
      put(M_inverse, e.pivot_inverse);
      if (k == 0) break;
      const Matrix A = columns(t.phi + kOfRotation), C = columns(t.m + kOfRotation);
      S = S * A - C;
      if (clamped_end) S = Matrix{} - A;
      S = M_inverse * S;
      put(S, e.stiffness);
    }
    return unstable;
  }

  // Newton's step for the gaps at the joints and the moment that T lacks; shorter if a section would turn by more than
  // `most`, rad. Returns the largest turn, as it would have been.
  static double correct(ElementState* elements, int count, const double (&lacking)[3], double most) {
    Vector s = get(lacking);
    for (int k = count - 1; k >= 0; --k) {
      ElementState& e = elements[k];
      s = get(e.pivot_inverse) * s;
      put(s, e.step_moment);
      if (k > 0) s = get(e.stiffness) * get(e.gap_turn) + s - get(e.gap_moment);
    }
    Vector phi{};
    double largest = 0.0;
    for (int k = 0; k < count; ++k) {
      ElementState& e = elements[k];
      Vector m = get(e.step_moment), turned{};
      if (k > 0) {
        phi = phi + get(e.gap_turn);
        m = m + get(e.stiffness) * phi;
        turned = columns(e.transfer.phi + kOfRotation) * phi;
      }
      put(m, e.step_moment);
      put(phi, e.step_turn);
      phi = turned + columns(e.transfer.phi + kOfMoment) * m;
      largest = largerOf(dot(phi, phi), largest);
    }
    largest = __builtin_sqrt(largest);
    const double scale = largest > most ? most / largest : 1.0;
    for (int k = 0; k < count; ++k) {
      ElementState& e = elements[k];
      for (int i = 0; i < 3; ++i) e.step_moment[i] *= scale, e.step_turn[i] *= scale;
    }
    return largest;
  }

  // The equilibrium by a unit wrench [f; m] at T (dead, base axes), six columns: C maps it to the twist of T, 6x6, column-major.
  // With the adjoint-weighted residual a^T G a of every element, a the columns of its start, if `corrected`.
  static void tangent(ElementState* elements, int count, bool corrected, double* C) {
    Six s[3] = {Six::unit(3), Six::unit(4), Six::unit(5)};  // moment at the end of an element whose start is held
    Matrix S{};
    for (int k = count - 1; k >= 0; --k) {
      ElementState& e = elements[k];
      Matrix from = Matrix{} - columns(e.transfer.m + kOfForce);
      if (k < count - 1) from = from + S * columns(e.transfer.phi + kOfForce);
      double by_force[9];
      put(from, by_force);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) s[i].at[j / kPackSize][j % kPackSize] += by_force[3 * i + j];
      Six at_start[3] = {};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) at_start[i].add(e.pivot_inverse[3 * i + j], s[j]);
      for (int i = 0; i < 3; ++i) {
        s[i] = at_start[i];
        for (int v = 0; v < Six::kPacks; ++v) store(e.by_wrench[i], v, s[i].at[v]);
      }
      if (k > 0) S = get(e.stiffness);
    }
    Six twist[6] = {}, start[kColumns] = {};
    for (int j = 0; j < 3; ++j) start[kOfForce + j] = Six::unit(j);
    for (int k = 0; k < count; ++k) {
      const ElementState& e = elements[k];
      Six phi[3] = {};
      for (int i = 0; i < 3; ++i) {
        for (int v = 0; v < Six::kPacks; ++v) start[kOfMoment + i].at[v] = load(e.by_wrench[i], v);
        for (int j = 0; j < 3 && k > 0; ++j) start[kOfMoment + i].add(e.stiffness[3 * i + j], start[kOfRotation + j]);
      }
      if (k == 0) {
        addEnd<kOfRotation>(e.transfer.p, start, twist);
        addEnd<kOfRotation>(e.transfer.phi, start, phi);
        if (corrected) addAdjointResidual<kOfRotation>(e.transfer, start, twist);
      } else {
        addEnd<kColumns>(e.transfer.p, start, twist);
        addEnd<kColumns>(e.transfer.phi, start, phi);
        if (corrected) addAdjointResidual<kColumns>(e.transfer, start, twist);
      }
      for (int i = 0; i < 3; ++i) start[kOfRotation + i] = phi[i];
    }
    for (int i = 0; i < 3; ++i)
      for (int v = 0; v < Six::kPacks; ++v) twist[3 + i].at[v] += start[kOfRotation + i].at[v];
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) C[6 * j + i] = twist[i][j];
  }
};

}  // namespace
}  // namespace live_stiffness
