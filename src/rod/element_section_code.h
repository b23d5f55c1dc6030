#pragma once
// The constitutive law of a section, and other code that shape, sensitivities and material compliance of an element share. In
// section axes the actuation wrench of a fluidic segment is constant along it, so it is a rest strain and not a load (see
// docs/derivation.md, section 1):
//   v = e3 + c_se R^T n,   u = u_rest + c_bt R^T m                                             (7), (9), (37)
// with n, m the external loads only.

#include "rod/element_kernel.h"
#include "rod/vector3_code.h"

namespace live_stiffness {
namespace {

// b: R^T m.
template <class T>
LIVE_STIFFNESS_INLINE VectorOf<T> curvatureOf(const ElementState& e, const VectorOf<T>& b) {
  return {e.rest_curvature[0] + e.bend_xx * b.x + e.bend_xy * b.y,
          e.rest_curvature[1] + e.bend_xy * b.x + e.bend_yy * b.y, e.rest_curvature[2] + e.torsion * b.z};
}

LIVE_STIFFNESS_INLINE Lanes3 tangentOf(const ElementState& e, const Lanes3& z, const Lanes3& n) {
  return (1.0 + (e.elongation - e.shear) * dot(z, n)) * z + splat(e.shear) * n;
}
// R c R^T of both densities, using that R^T R = I: bend = yy I + (xx - yy) x x^T + ... + (torsion - yy) z z^T.
LIVE_STIFFNESS_INLINE PackMatrix bendOf(const ElementState& e, const PackMatrix& R) {
  const Lanes3 a = splat(e.bend_xx - e.bend_yy) * R.x + splat(e.bend_xy) * R.y, b = splat(e.bend_xy) * R.x,
               c = splat(e.torsion - e.bend_yy) * R.z;
  PackMatrix B{R.x.x * a + R.y.x * b + R.z.x * c, R.x.y * a + R.y.y * b + R.z.y * c,
                R.x.z * a + R.y.z * b + R.z.z * c};
  B.x.x += e.bend_yy, B.y.y += e.bend_yy, B.z.z += e.bend_yy;
  return B;
}
LIVE_STIFFNESS_INLINE PackMatrix stretchOf(const ElementState& e, const Lanes3& z) {
  const Lanes3 c = splat(e.elongation - e.shear) * z;
  PackMatrix S{z.x * c, z.y * c, z.z * c};
  S.x.x += e.shear, S.y.y += e.shear, S.z.z += e.shear;
  return S;
}
// sin(t) / t, (1 - cos(t)) / t^2 and (t - sin(t)) / t^3 in x = t^2, exact to rounding up to kMaxUnloadedBending.
constexpr int kTerms = 10;
constexpr double kSine[kTerms] = {
    1.0, -0.16666666666666666, 0.008333333333333333, -0.0001984126984126984, 2.7557319223985893e-06,
    -2.505210838544172e-08, 1.6059043836821613e-10, -7.647163731819816e-13, 2.8114572543455206e-15,
    -8.22063524662433e-18};
constexpr double kCosine[kTerms] = {
    0.5, -0.041666666666666664, 0.001388888888888889, -2.48015873015873e-05, 2.755731922398589e-07,
    -2.08767569878681e-09, 1.1470745597729725e-11, -4.779477332387385e-14, 1.5619206968586225e-16,
    -4.110317623312165e-19};
constexpr double kThird[kTerms] = {
    0.16666666666666666, -0.008333333333333333, 0.0001984126984126984, -2.7557319223985893e-06,
    2.505210838544172e-08, -1.6059043836821613e-10, 7.647163731819816e-13, -2.8114572543455206e-15,
    8.22063524662433e-18, -1.9572941063391263e-20};
// Even and odd powers separately: half the latency of Horner's rule.
LIVE_STIFFNESS_INLINE Pack series(const double (&k)[kTerms], Pack x) {
  const Pack x2 = x * x;
  Pack even = splat(k[kTerms - 2]), odd = splat(k[kTerms - 1]);
#pragma GCC unroll 10
  for (int i = kTerms - 4; i >= 0; i -= 2) {
    even = even * x2 + k[i];
    odd = odd * x2 + k[i + 1];
  }
  return odd * x + even;
}

// 2 tan(|w| / 2) along w: the Cayley vector of the rotation vector w, |w| up to kMaxUnloadedBending.
LIVE_STIFFNESS_INLINE Lanes3 cayleyOfRotation(const Lanes3& w) {
  const Pack x = dot(w, w);
  return (2.0 * series(kSine, x) / (2.0 - x * series(kCosine, x))) * w;
}
// Smallest ratio of a Legendre coefficient to the one before that the error estimate assumes.
constexpr double kDecay = 0.05;

}  // namespace
}  // namespace live_stiffness
