#pragma once
// SIMD vectors of LIVE_STIFFNESS_PACK doubles (packs), and 3-vectors and 3x3 matrices of them: each lane is one Gauss node
// (or one station). Included by one translation unit for each instruction set. Everything has internal linkage, so that code
// of one instruction set cannot be linked into another.

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

struct Lanes3 {
  Pack x, y, z;
};
LIVE_STIFFNESS_INLINE Lanes3 operator+(Lanes3 a, Lanes3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
LIVE_STIFFNESS_INLINE Lanes3 operator-(Lanes3 a, Lanes3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
LIVE_STIFFNESS_INLINE Lanes3 operator*(Pack k, Lanes3 a) { return {k * a.x, k * a.y, k * a.z}; }
LIVE_STIFFNESS_INLINE Pack dot(Lanes3 a, Lanes3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
LIVE_STIFFNESS_INLINE Lanes3 cross(Lanes3 a, Lanes3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <int n>
LIVE_STIFFNESS_INLINE Lanes3 load(const double (&rows)[3][n], int v) {
  return {load(rows[0], v), load(rows[1], v), load(rows[2], v)};
}
template <int n>
LIVE_STIFFNESS_INLINE void store(double (&rows)[3][n], int v, Lanes3 a) {
  store(rows[0], v, a.x);
  store(rows[1], v, a.y);
  store(rows[2], v, a.z);
}
LIVE_STIFFNESS_INLINE Lanes3 splat(const double (&a)[3]) { return {splat(a[0]), splat(a[1]), splat(a[2])}; }

// Columns x, y, z.
struct PackMatrix {
  Lanes3 x, y, z;
};
LIVE_STIFFNESS_INLINE Lanes3 operator*(const PackMatrix& M, Lanes3 a) { return a.x * M.x + a.y * M.y + a.z * M.z; }
LIVE_STIFFNESS_INLINE Lanes3 transposedTimes(const PackMatrix& M, Lanes3 a) { return {dot(M.x, a), dot(M.y, a), dot(M.z, a)}; }
LIVE_STIFFNESS_INLINE PackMatrix splatMatrix(const double (&M)[9]) {  // row-major
  return {{splat(M[0]), splat(M[3]), splat(M[6])}, {splat(M[1]), splat(M[4]), splat(M[7])},
          {splat(M[2]), splat(M[5]), splat(M[8])}};
}
LIVE_STIFFNESS_INLINE PackMatrix operator*(const PackMatrix& A, const PackMatrix& B) { return {A * B.x, A * B.y, A * B.z}; }
// Times hat(a) from the right.
LIVE_STIFFNESS_INLINE PackMatrix timesHat(const PackMatrix& M, Lanes3 a) {
  return {a.z * M.y - a.y * M.z, a.x * M.z - a.z * M.x, a.y * M.x - a.x * M.y};
}
template <int n>
LIVE_STIFFNESS_INLINE PackMatrix loadMatrix(const double (*rows)[n], int v) {
  return {{load(rows[0], v), load(rows[3], v), load(rows[6], v)},
          {load(rows[1], v), load(rows[4], v), load(rows[7], v)},
          {load(rows[2], v), load(rows[5], v), load(rows[8], v)}};
}
template <int n>
LIVE_STIFFNESS_INLINE void storeMatrix(double (*rows)[n], int v, const PackMatrix& M) {
  store(rows[0], v, M.x.x), store(rows[1], v, M.y.x), store(rows[2], v, M.z.x);
  store(rows[3], v, M.x.y), store(rows[4], v, M.y.y), store(rows[5], v, M.z.y);
  store(rows[6], v, M.x.z), store(rows[7], v, M.y.z), store(rows[8], v, M.z.z);
}
// Symmetric matrices, rows xx xy xz yy yz zz.
template <int n>
LIVE_STIFFNESS_INLINE PackMatrix loadSymmetric(const double (*rows)[n], int v) {
  const Pack xx = load(rows[0], v), xy = load(rows[1], v), xz = load(rows[2], v), yy = load(rows[3], v),
              yz = load(rows[4], v), zz = load(rows[5], v);
  return {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
}
template <int n>
LIVE_STIFFNESS_INLINE void storeSymmetric(double (*rows)[n], int v, const PackMatrix& M) {
  store(rows[0], v, M.x.x), store(rows[1], v, M.y.x), store(rows[2], v, M.z.x);
  store(rows[3], v, M.y.y), store(rows[4], v, M.z.y), store(rows[5], v, M.z.z);
}

// Rotation matrix of the Cayley vector g = 2 tan(angle / 2) axis: I + (hat(g) + hat(g)^2 / 2) 4 / (4 + |g|^2).
LIVE_STIFFNESS_INLINE PackMatrix cayley(Lanes3 g) {
  const Pack k = 2.0 / (4.0 + dot(g, g));
  const Lanes3 kg = k * g, t = kg + kg;
  const Pack xx = kg.x * g.x, yy = kg.y * g.y, zz = kg.z * g.z;
  const Pack xy = kg.x * g.y, xz = kg.x * g.z, yz = kg.y * g.z;
  return {{1.0 - yy - zz, xy + t.z, xz - t.y}, {xy - t.z, 1.0 - xx - zz, yz + t.x}, {xz + t.y, yz - t.x, 1.0 - xx - yy}};
}

// Rate of g of a section that turns with the curvature u (body axes): R' = R hat(u).
LIVE_STIFFNESS_INLINE Lanes3 cayleyRate(Lanes3 g, Lanes3 u) {
  return u + splat(0.5) * (cross(g, u) + (0.5 * dot(g, u)) * g);
}

}  // namespace
}  // namespace live_stiffness
