#pragma once
// 3-vectors and 3x3 matrices of T, for the innermost loops: double, or a pack, each lane of which is one Gauss node (or one
// station). Every formula of rotations stands here once for both.

#include "rod/packs.h"

namespace live_stiffness {
namespace {

template <class T>
struct VectorOf {
  T x, y, z;
};
template <class T>
struct MatrixOf {
  VectorOf<T> x, y, z;  // columns
};
using Vector = VectorOf<double>;
using Matrix = MatrixOf<double>;
using Lanes3 = VectorOf<Pack>;
using PackMatrix = MatrixOf<Pack>;

template <class T>
LIVE_STIFFNESS_INLINE VectorOf<T> operator+(const VectorOf<T>& a, const VectorOf<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
LIVE_STIFFNESS_INLINE VectorOf<T> operator-(const VectorOf<T>& a, const VectorOf<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
LIVE_STIFFNESS_INLINE VectorOf<T> operator*(T k, const VectorOf<T>& a) {
  return {k * a.x, k * a.y, k * a.z};
}
template <class T>
LIVE_STIFFNESS_INLINE T dot(const VectorOf<T>& a, const VectorOf<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
LIVE_STIFFNESS_INLINE VectorOf<T> cross(const VectorOf<T>& a, const VectorOf<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
LIVE_STIFFNESS_INLINE MatrixOf<T> operator+(const MatrixOf<T>& A, const MatrixOf<T>& B) {
  return {A.x + B.x, A.y + B.y, A.z + B.z};
}
template <class T>
LIVE_STIFFNESS_INLINE MatrixOf<T> operator-(const MatrixOf<T>& A, const MatrixOf<T>& B) {
  return {A.x - B.x, A.y - B.y, A.z - B.z};
}
template <class T>
LIVE_STIFFNESS_INLINE VectorOf<T> operator*(const MatrixOf<T>& M, const VectorOf<T>& a) {
  return a.x * M.x + a.y * M.y + a.z * M.z;
}
template <class T>
LIVE_STIFFNESS_INLINE MatrixOf<T> operator*(const MatrixOf<T>& A, const MatrixOf<T>& B) {
  return {A * B.x, A * B.y, A * B.z};
}
template <class T>
LIVE_STIFFNESS_INLINE VectorOf<T> transposedTimes(const MatrixOf<T>& M, const VectorOf<T>& a) {
  return {dot(M.x, a), dot(M.y, a), dot(M.z, a)};
}
// M hat(a).
template <class T>
LIVE_STIFFNESS_INLINE MatrixOf<T> timesHat(const MatrixOf<T>& M, const VectorOf<T>& a) {
  return {a.z * M.y - a.y * M.z, a.x * M.z - a.z * M.x, a.y * M.x - a.x * M.y};
}

// Rotation matrix of the Cayley vector g = 2 tan(angle / 2) axis: I + (hat(g) + hat(g)^2 / 2) 4 / (4 + |g|^2).
template <class T>
LIVE_STIFFNESS_INLINE MatrixOf<T> cayley(const VectorOf<T>& g) {
  const T k = 2.0 / (4.0 + dot(g, g));
  const VectorOf<T> kg = k * g, t = kg + kg;
  const T xx = kg.x * g.x, yy = kg.y * g.y, zz = kg.z * g.z;
  const T xy = kg.x * g.y, xz = kg.x * g.z, yz = kg.y * g.z;
  return {{1.0 - yy - zz, xy + t.z, xz - t.y}, {xy - t.z, 1.0 - xx - zz, yz + t.x}, {xz + t.y, yz - t.x, 1.0 - xx - yy}};
}
// Rate of g of a section that turns with the curvature u (body axes): R' = R hat(u).
template <class T>
LIVE_STIFFNESS_INLINE VectorOf<T> cayleyRate(const VectorOf<T>& g, const VectorOf<T>& u) {
  return u + splatAs<T>(0.5) * (cross(g, u) + (0.5 * dot(g, u)) * g);
}

// Single vectors and matrices (row-major) of an element or a chain.
LIVE_STIFFNESS_INLINE Vector get(const double (&a)[3]) { return {a[0], a[1], a[2]}; }
LIVE_STIFFNESS_INLINE void put(const Vector& a, double (&to)[3]) { to[0] = a.x, to[1] = a.y, to[2] = a.z; }
LIVE_STIFFNESS_INLINE Matrix get(const double (&M)[9]) {
  return {{M[0], M[3], M[6]}, {M[1], M[4], M[7]}, {M[2], M[5], M[8]}};
}
LIVE_STIFFNESS_INLINE void put(const Matrix& M, double (&to)[9]) {
  to[0] = M.x.x, to[1] = M.y.x, to[2] = M.z.x;
  to[3] = M.x.y, to[4] = M.y.y, to[5] = M.z.y;
  to[6] = M.x.z, to[7] = M.y.z, to[8] = M.z.z;
}
// Of three columns of sensitivities.
LIVE_STIFFNESS_INLINE Matrix columns(const double (*column)[3]) { return {get(column[0]), get(column[1]), get(column[2])}; }

template <int n>
LIVE_STIFFNESS_INLINE void copy(const double (&from)[n], double (&to)[n]) {
  for (int i = 0; i < n; ++i) to[i] = from[i];
}
template <int n>
LIVE_STIFFNESS_INLINE double squaredNorm(const double (&a)[n]) {
  double sum = a[0] * a[0];
  for (int i = 1; i < n; ++i) sum += a[i] * a[i];
  return sum;
}
LIVE_STIFFNESS_INLINE double largerOf(double a, double b) { return a > b ? a : b; }

// The Cayley vector of R Q^T, by which R is turned from Q, base axes.
LIVE_STIFFNESS_INLINE Vector turnBetween(const Matrix& Q, const Matrix& R) {
  const double trace = dot(Q.x, R.x) + dot(Q.y, R.y) + dot(Q.z, R.z);
  return 2.0 / (1.0 + trace) * (cross(Q.x, R.x) + cross(Q.y, R.y) + cross(Q.z, R.z));
}
LIVE_STIFFNESS_INLINE Matrix inverse(const Matrix& M) {
  const Vector x = cross(M.y, M.z), y = cross(M.z, M.x), z = cross(M.x, M.y);  // rows, times the determinant
  const double scale = 1.0 / dot(M.x, x);
  return {scale * Vector{x.x, y.x, z.x}, scale * Vector{x.y, y.y, z.y}, scale * Vector{x.z, y.z, z.z}};
}
// How many eigenvalues of the symmetric part are not positive, by Sylvester's law of inertia. 3 if they are NaN.
LIVE_STIFFNESS_INLINE int notPositive(const Matrix& M) {
  const double xy = 0.5 * (M.x.y + M.y.x), xz = 0.5 * (M.x.z + M.z.x), yz = 0.5 * (M.y.z + M.z.y);
  const double minor = M.x.x * M.y.y - xy * xy;
  const double determinant = M.z.z * minor - M.x.x * yz * yz - M.y.y * xz * xz + 2.0 * xy * xz * yz;
  return !(M.x.x > 0.0) + !(M.x.x * minor > 0.0) + !(minor * determinant > 0.0);
}

// Packs from and to rows of one number for each node.
template <int n>
LIVE_STIFFNESS_INLINE Lanes3 load(const double (&rows)[3][n], int v) {
  return {load(rows[0], v), load(rows[1], v), load(rows[2], v)};
}
template <int n>
LIVE_STIFFNESS_INLINE void store(double (&rows)[3][n], int v, const Lanes3& a) {
  store(rows[0], v, a.x);
  store(rows[1], v, a.y);
  store(rows[2], v, a.z);
}
LIVE_STIFFNESS_INLINE Lanes3 splat(const Vector& a) { return {splat(a.x), splat(a.y), splat(a.z)}; }
LIVE_STIFFNESS_INLINE PackMatrix splat(const Matrix& M) { return {splat(M.x), splat(M.y), splat(M.z)}; }
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

}  // namespace
}  // namespace live_stiffness
