#pragma once
// SIMD vectors of LIVE_STIFFNESS_PACK doubles (packs). Included by one translation unit for each instruction set. Everything
// has internal linkage, so that code of one instruction set cannot be linked into another.

#include "rod/element_state.h"

namespace live_stiffness {
namespace {

#define LIVE_STIFFNESS_INLINE inline __attribute__((always_inline))

constexpr int kPackSize = LIVE_STIFFNESS_PACK;
typedef double Pack __attribute__((vector_size(8 * LIVE_STIFFNESS_PACK)));

LIVE_STIFFNESS_INLINE Pack load(const double* row, int v) { return reinterpret_cast<const Pack*>(row)[v]; }
LIVE_STIFFNESS_INLINE void store(double* row, int v, Pack x) { reinterpret_cast<Pack*>(row)[v] = x; }
LIVE_STIFFNESS_INLINE void storeUnaligned(double* to, Pack x) {
  typedef double Unaligned __attribute__((vector_size(8 * LIVE_STIFFNESS_PACK), aligned(8)));
  *reinterpret_cast<Unaligned*>(to) = x;
}
LIVE_STIFFNESS_INLINE Pack splat(double x) { return x - Pack{}; }  // minus: 0 + x would not be x for -0
// The number as a T: a double or a pack.
template <class T>
LIVE_STIFFNESS_INLINE T splatAs(double x) {
  return x - T{};
}

LIVE_STIFFNESS_INLINE double sum(Pack x) {
  double result = x[0];
  for (int i = 1; i < kPackSize; ++i) result += x[i];
  return result;
}

// Selects lanes by their index: those of a first, then those of b. gcc 9 (Noetic) and clang have no builtin in common for this.
#if defined(__clang__)
#define LIVE_STIFFNESS_PICK(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
typedef long long PackMask __attribute__((vector_size(8 * LIVE_STIFFNESS_PACK)));
#define LIVE_STIFFNESS_PICK(a, b, ...) __builtin_shuffle(a, b, PackMask{__VA_ARGS__})
#endif

// Sums over the lanes of each row, and transposition of rows to one array for each lane (out[lane][0...] = rows[...][lane]),
// square by square.
LIVE_STIFFNESS_INLINE Pack sumsOfSquare(const Pack* rows) {
#if LIVE_STIFFNESS_PACK == 4
  const Pack a = LIVE_STIFFNESS_PICK(rows[0], rows[1], 0, 4, 2, 6) + LIVE_STIFFNESS_PICK(rows[0], rows[1], 1, 5, 3, 7);
  const Pack b = LIVE_STIFFNESS_PICK(rows[2], rows[3], 0, 4, 2, 6) + LIVE_STIFFNESS_PICK(rows[2], rows[3], 1, 5, 3, 7);
  return LIVE_STIFFNESS_PICK(a, b, 0, 1, 4, 5) + LIVE_STIFFNESS_PICK(a, b, 2, 3, 6, 7);
#else
  return LIVE_STIFFNESS_PICK(rows[0], rows[1], 0, 2) + LIVE_STIFFNESS_PICK(rows[0], rows[1], 1, 3);
#endif
}
LIVE_STIFFNESS_INLINE void storeSquareAcross(const Pack* rows, double* const* out, int at) {
#if LIVE_STIFFNESS_PACK == 4
  const Pack a = LIVE_STIFFNESS_PICK(rows[0], rows[1], 0, 4, 2, 6), b = LIVE_STIFFNESS_PICK(rows[0], rows[1], 1, 5, 3, 7),
              c = LIVE_STIFFNESS_PICK(rows[2], rows[3], 0, 4, 2, 6), d = LIVE_STIFFNESS_PICK(rows[2], rows[3], 1, 5, 3, 7);
  storeUnaligned(out[0] + at, LIVE_STIFFNESS_PICK(a, c, 0, 1, 4, 5));
  storeUnaligned(out[1] + at, LIVE_STIFFNESS_PICK(b, d, 0, 1, 4, 5));
  storeUnaligned(out[2] + at, LIVE_STIFFNESS_PICK(a, c, 2, 3, 6, 7));
  storeUnaligned(out[3] + at, LIVE_STIFFNESS_PICK(b, d, 2, 3, 6, 7));
#else
  storeUnaligned(out[0] + at, LIVE_STIFFNESS_PICK(rows[0], rows[1], 0, 2));
  storeUnaligned(out[1] + at, LIVE_STIFFNESS_PICK(rows[0], rows[1], 1, 3));
#endif
}
template <int n>
LIVE_STIFFNESS_INLINE void sums(const Pack (&rows)[n], double* out) {
  constexpr int kSquares = n / kPackSize * kPackSize;
#pragma GCC unroll 16
  for (int i = 0; i < kSquares; i += kPackSize) storeUnaligned(out + i, sumsOfSquare(rows + i));
  for (int i = kSquares; i < n; ++i) out[i] = sum(rows[i]);
}
template <int n>
LIVE_STIFFNESS_INLINE void storeAcross(const Pack (&rows)[n], double* const* out) {
  static_assert(n % kPackSize == 0);
#pragma GCC unroll 18
  for (int i = 0; i < n; i += kPackSize) storeSquareAcross(rows + i, out, i);
}

// The first lane of each row. Stores whole vectors where possible, since vector loads of numbers that were just stored one by
// one are slow.
template <int n>
LIVE_STIFFNESS_INLINE void storeFirst(const Pack (&rows)[n], double* out) {
  for (int i = 0; i + kPackSize <= n; i += kPackSize) {
    Pack several{};
    for (int lane = 0; lane < kPackSize; ++lane) several[lane] = rows[i + lane][0];
    storeUnaligned(out + i, several);
  }
  for (int i = n / kPackSize * kPackSize; i < n; ++i) out[i] = rows[i][0];
}

// The inverse: rows[...][lane] = in[lane][...].
template <int n>
LIVE_STIFFNESS_INLINE void loadAcross(const double (*in)[n], Pack* rows) {
  static_assert(n % kPackSize == 0);
#pragma GCC unroll 14
  for (int i = 0; i < n / kPackSize; ++i) {
    Pack square[kPackSize];
    double* out[kPackSize];
    for (int lane = 0; lane < kPackSize; ++lane) {
      square[lane] = load(in[lane], i);
      out[lane] = reinterpret_cast<double*>(rows + kPackSize * i + lane);
    }
    storeSquareAcross(square, out, 0);
  }
}

}  // namespace
}  // namespace live_stiffness
