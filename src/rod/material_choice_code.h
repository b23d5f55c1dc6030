#pragma once
// Chooses the grid for the material compliance of an element at the accuracy asked for, and estimates its error between the
// nodes. Integrals over the whole element are exact to rounding with each.

#include "rod/element_arc_code.h"
#include "rod/element_material_code.h"

namespace live_stiffness {
namespace {

// Relative error of interpolation by kDense nodes in an element that bends by x rad, at its worst section. The true error of
// arcs, for any bending up to kMaxUnloadedBending, is 0.6 to 1 times this.
template <int kDense>
LIVE_STIFFNESS_INLINE double interpolationError(double x_squared) {
  double error = (kDense == 8 ? 2.7e-8 : 1.7e-13) * (1.0 + 0.25 * x_squared);
  for (int i = 2; i < kDense; i += 2) error *= x_squared;
  return error;
}

// With the cheapest grid that is accurate enough.
template <int kStages>
struct MaterialChoice {
  static void material(ElementState& e, bool unloaded, double accuracy) {
    constexpr double kImprovement = 20.0;
    double bending = e.length * e.length * squaredNorm(e.rest_curvature), error = 0.0;
    bool improved = false;
    if (!unloaded) {
      const GaussLegendre& t = gaussLegendre(kStages);
      Pack square{};
      for (int v = 0; v < (kStages + kPackSize - 1) / kPackSize; ++v)
        square += load(t.b, v) * dot(load(e.g_rate, v), load(e.g_rate, v));
      bending = e.length * e.length * sum(square);
      improved = e.interior_error > accuracy;
      error = improved ? e.interior_error / kImprovement : e.interior_error;
    }
    e.is_arc = false;
    if (interpolationError<8>(bending) <= accuracy) run<8>(e, unloaded, bending, error, improved);
    else run<12>(e, unloaded, bending, error, improved);
  }

  static void stations(const ElementState& e, const StationBatch& s, const StationResults& out) {
    for (int v = 0; kPackSize * v < s.size; ++v) {
      if (e.is_arc) arcStations(e, s, out, v);
      else if (e.dense_nodes == 8) Material<8>::stations(e, s, out, v);
      else Material<12>::stations(e, s, out, v);
    }
  }

 private:
  template <int kDense>
  static LIVE_STIFFNESS_INLINE void run(ElementState& e, bool unloaded, double bending, double collocation_error,
                                        bool improved) {
    e.dense_nodes = kDense;
    e.unloaded = unloaded;
    e.station_error = interpolationError<kDense>(bending) + collocation_error;
    Material<kDense>::material(e, kStages, unloaded, improved);
  }
};

}  // namespace
}  // namespace live_stiffness
