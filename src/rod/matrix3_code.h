#pragma once
// Single 3-vectors and 3x3 matrices (row-major) as plain numbers, for the loops along a chain.

#include "rod/packs.h"

namespace live_stiffness {
namespace {

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

// out = R a, R^T a.
LIVE_STIFFNESS_INLINE void rotate(const double (&R)[9], const double (&a)[3], double (&out)[3]) {
  for (int i = 0; i < 3; ++i) out[i] = R[3 * i] * a[0] + R[3 * i + 1] * a[1] + R[3 * i + 2] * a[2];
}
LIVE_STIFFNESS_INLINE void rotateBack(const double (&R)[9], const double (&a)[3], double (&out)[3]) {
  for (int i = 0; i < 3; ++i) out[i] = R[i] * a[0] + R[3 + i] * a[1] + R[6 + i] * a[2];
}
// Cross product of numbers or of packs.
template <class T>
LIVE_STIFFNESS_INLINE void crossInto(const T (&d)[3], T x, T y, T z, T (&out)[3]) {
  out[0] = d[1] * z - d[2] * y;
  out[1] = d[2] * x - d[0] * z;
  out[2] = d[0] * y - d[1] * x;
}

// The Cayley vector of R Q^T, by which R is turned from Q, base axes.
LIVE_STIFFNESS_INLINE void turnBetween(const double (&Q)[9], const double (&R)[9], double (&turn)[3]) {
  const auto entry = [&](int i, int j) {
    return R[3 * i] * Q[3 * j] + R[3 * i + 1] * Q[3 * j + 1] + R[3 * i + 2] * Q[3 * j + 2];
  };
  const double scale = 2.0 / (1.0 + entry(0, 0) + entry(1, 1) + entry(2, 2));
  turn[0] = scale * (entry(2, 1) - entry(1, 2));
  turn[1] = scale * (entry(0, 2) - entry(2, 0));
  turn[2] = scale * (entry(1, 0) - entry(0, 1));
}
// a becomes cayley(turn) a, R becomes cayley(turn) R.
LIVE_STIFFNESS_INLINE void turnVector(const double (&turn)[3], double (&a)[3]) {
  const double k = 4.0 / (4.0 + squaredNorm(turn));
  double once[3], twice[3];
  crossInto(turn, a[0], a[1], a[2], once);
  crossInto(turn, once[0], once[1], once[2], twice);
  for (int i = 0; i < 3; ++i) a[i] += k * (once[i] + 0.5 * twice[i]);
}
LIVE_STIFFNESS_INLINE void turnBy(const double (&turn)[3], double (&R)[9]) {
  for (int j = 0; j < 3; ++j) {
    double column[3] = {R[j], R[3 + j], R[6 + j]};
    turnVector(turn, column);
    for (int i = 0; i < 3; ++i) R[3 * i + j] = column[i];
  }
}

// A general 3x3 matrix.
struct Three {
  double at[3][3];

  // Of three columns of sensitivities.
  static LIVE_STIFFNESS_INLINE Three ofColumns(const double (*columns)[3]) {
    return {{{columns[0][0], columns[1][0], columns[2][0]},
             {columns[0][1], columns[1][1], columns[2][1]},
             {columns[0][2], columns[1][2], columns[2][2]}}};
  }
  static LIVE_STIFFNESS_INLINE Three of(const double (&a)[9]) {
    return {{{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {a[6], a[7], a[8]}}};
  }
  LIVE_STIFFNESS_INLINE void copyTo(double (&to)[9]) const {
    for (int i = 0; i < 9; ++i) to[i] = at[i / 3][i % 3];
  }
  LIVE_STIFFNESS_INLINE Three inverse() const {
    double row[3][3];
    for (int i = 0; i < 3; ++i) {
      const double *a = at[(i + 1) % 3], *b = at[(i + 2) % 3];
      row[i][0] = a[1] * b[2] - a[2] * b[1], row[i][1] = a[2] * b[0] - a[0] * b[2], row[i][2] = a[0] * b[1] - a[1] * b[0];
    }
    const double scale = 1.0 / (at[0][0] * row[0][0] + at[0][1] * row[0][1] + at[0][2] * row[0][2]);
    Three result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result.at[j][i] = scale * row[i][j];
    return result;
  }
  // How many eigenvalues of the symmetric part are not positive, by Sylvester's law of inertia. 3 if they are NaN.
  LIVE_STIFFNESS_INLINE int notPositive() const {
    const double xy = 0.5 * (at[0][1] + at[1][0]), xz = 0.5 * (at[0][2] + at[2][0]), yz = 0.5 * (at[1][2] + at[2][1]);
    const double minor = at[0][0] * at[1][1] - xy * xy;
    const double determinant = at[2][2] * minor - at[0][0] * yz * yz - at[1][1] * xz * xz + 2.0 * xy * xz * yz;
    return !(at[0][0] > 0.0) + !(at[0][0] * minor > 0.0) + !(minor * determinant > 0.0);
  }
};
LIVE_STIFFNESS_INLINE Three operator*(const Three& a, const Three& b) {
  Three c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c.at[i][j] = a.at[i][0] * b.at[0][j] + a.at[i][1] * b.at[1][j] + a.at[i][2] * b.at[2][j];
  return c;
}
LIVE_STIFFNESS_INLINE Three operator-(const Three& a, const Three& b) {
  Three c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c.at[i][j] = a.at[i][j] - b.at[i][j];
  return c;
}
LIVE_STIFFNESS_INLINE Three operator+(const Three& a, const Three& b) {
  Three c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c.at[i][j] = a.at[i][j] + b.at[i][j];
  return c;
}
struct Vector {
  double at[3];
};
LIVE_STIFFNESS_INLINE Vector vectorOf(const double (&a)[3]) { return {{a[0], a[1], a[2]}}; }
LIVE_STIFFNESS_INLINE Vector operator*(const Three& a, const Vector& b) {
  Vector c;
  for (int i = 0; i < 3; ++i) c.at[i] = a.at[i][0] * b.at[0] + a.at[i][1] * b.at[1] + a.at[i][2] * b.at[2];
  return c;
}
LIVE_STIFFNESS_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2]}};
}
LIVE_STIFFNESS_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
}

}  // namespace
}  // namespace live_stiffness
