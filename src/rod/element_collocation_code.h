#pragma once
// Integrals along one element by Gauss collocation; each lane is one node, the last one the end of the element.

#include "rod/vector3_code.h"

namespace live_stiffness {
namespace {

template <int kStages>
struct Collocation {
  static constexpr int kVectors = (kStages + kPackSize) / kPackSize;  // nodes and end

  static LIVE_STIFFNESS_INLINE const GaussLegendre& table() {
    static const GaussLegendre& table = gaussLegendre(kStages);
    return table;
  }

  // Integrals from the start to the nodes and the end, over a unit length.
  struct Rows {
    Lanes3 at[kVectors];
  };
  static LIVE_STIFFNESS_INLINE Rows integral(const GaussLegendre& t, const StageRow (&f)[3]) {
    Rows sum;
    for (int v = 0; v < kVectors; ++v) {
      const Pack a = load(t.a[0], v);
      sum.at[v] = {a * f[0][0], a * f[1][0], a * f[2][0]};
    }
#pragma GCC unroll 8
    for (int j = 1; j < kStages; ++j) {
      const Pack x = splat(f[0][j]), y = splat(f[1][j]), z = splat(f[2][j]);
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) {
        const Pack a = load(t.a[j], v);
        sum.at[v].x += a * x;
        sum.at[v].y += a * y;
        sum.at[v].z += a * z;
      }
    }
    return sum;
  }
};

}  // namespace
}  // namespace live_stiffness
