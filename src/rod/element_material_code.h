#pragma once
// Material compliance (10) inside one element, on a Gauss grid of its own: what is made of the rotations varies faster
// than they do, so it is denser than the stages, the denser the more the element bends. One lane is one node, or one
// station.

#include "rod/element_section_code.h"

namespace live_stiffness {
namespace {

template <int kDense>
struct Material {
  static constexpr int kVectors = kDense / kLanes;

  static LIVE_STIFFNESS_INLINE const GaussLegendre& table() {
    static const GaussLegendre& table = gaussLegendre(kDense);
    return table;
  }
  static LIVE_STIFFNESS_INLINE const NodeTransfer& transfer(int stages) {
    struct Transfers {
      NodeTransfer from[kMaxStages + 1];
      Transfers() {
        for (int stages = kMinStages; stages <= kMaxStages; ++stages) from[stages] = makeTransfer(stages, kDense);
      }
    };
    static const Transfers transfers;
    return transfers.from[stages];
  }

  struct Vectors {
    Lanes3 at[kVectors];
  };

  // Integrals of f over [0, c_i], for a unit length.
  static LIVE_STIFFNESS_INLINE Vectors integral(const NodeRow (&f)[3]) {
    Vectors sum{};
#pragma GCC unroll 12
    for (int j = 0; j < kDense; ++j) {
      const Lanes x = splat(f[0][j]), y = splat(f[1][j]), z = splat(f[2][j]);
      for (int v = 0; v < kVectors; ++v) {
        const Lanes a = load(table().a[j], v);
        sum.at[v].x += a * x, sum.at[v].y += a * y, sum.at[v].z += a * z;
      }
    }
    return sum;
  }

  // One more pass on the dense nodes: makes collocation about twenty times more accurate between its own.
  static void improve(ElementState& e, Vectors& g) {
    const GaussLegendre& t = table();
    const Lanes h = splat(e.length);
    double n_start[3], m_start[3], line_load[3];
    rotateBack(e.R_start, e.n_start, n_start);
    rotateBack(e.R_start, e.m_start, m_start);
    rotateBack(e.R_start, e.line_load, line_load);
    NodeRow rate[3];
    LanesMatrix R[kVectors];
    for (int v = 0; v < kVectors; ++v) {
      R[v] = cayley(g.at[v]);
      const Lanes3 n = splat(n_start) - (h * load(t.c, v)) * splat(line_load);
      store(rate, v, cross(n, tangentOf(e, R[v].z, n)));
    }
    const Vectors moment = integral(rate);
    for (int v = 0; v < kVectors; ++v)
      store(rate, v, cayleyRate(g.at[v], curvatureOf(e, R[v], splat(m_start) + h * moment.at[v])));
    const Vectors turn = integral(rate);
    for (int v = 0; v < kVectors; ++v) g.at[v] = h * turn.at[v];
    fillSeries(e, t, kDense, rate);
  }

  // Legendre coefficients of the rate of g, times length, from its values at n nodes.
  template <class Row>
  static LIVE_STIFFNESS_INLINE void fillSeries(ElementState& e, const GaussLegendre& t, int n, const Row (&rate)[3]) {
    e.series_terms = n;
    for (int k = 0; k < n; ++k) {
      double x = 0.0, y = 0.0, z = 0.0;
      for (int j = 0; j < n; ++j) {
        const double c = e.length * t.legendre[k][j];
        x += c * rate[0][j], y += c * rate[1][j], z += c * rate[2][j];
      }
      e.g_rate_series[k][0] = x, e.g_rate_series[k][1] = y, e.g_rate_series[k][2] = z;
    }
  }

  // With r from the start to the node: [S - K hat(r), K; K^T, B], K = hat(r) B, the integrand of (10).
  static void material(ElementState& e, int stages, bool unloaded, bool improved) {
    const GaussLegendre& t = table();
    const Lanes h = splat(e.length);
    Vectors g{};
    if (unloaded) {
      for (int v = 0; v < kVectors; ++v) g.at[v] = cayleyOfRotation((h * load(t.c, v)) * splat(e.rest_curvature));
    } else {
      const NodeTransfer& from = transfer(stages);
      for (int j = 0; j < stages; ++j) {
        const Lanes x = splat(e.length * e.g_rate[0][j]), y = splat(e.length * e.g_rate[1][j]), z = splat(e.length * e.g_rate[2][j]);
        for (int v = 0; v < kVectors; ++v) {
          const Lanes a = load(from.integral[j], v);
          g.at[v].x += a * x, g.at[v].y += a * y, g.at[v].z += a * z;
        }
      }
      if (improved) improve(e, g);
      else fillSeries(e, gaussLegendre(stages), stages, e.g_rate);
    }
    const LanesMatrix R_start = splatMatrix(e.R_start);
    const Lanes3 n_start = splat(e.n_start), reach = h * splat(e.line_load);
    LanesMatrix R[kVectors];
    Lanes3 missing{};
    for (int v = 0; v < kVectors; ++v) {
      R[v] = R_start * cayley(g.at[v]);
      const Lanes3 tangent = tangentOf(e, R[v].z, n_start - load(t.c, v) * reach);
      store(e.dense_tangent, v, tangent);
      missing = missing - load(t.b, v) * tangent;
    }
    // Collocation is more accurate at the end than on the way; a constant takes the difference out.
    const double per_length = 1.0 / e.length;
    const Lanes3 constant{splat(sum(missing.x) + per_length * e.offset_end[0]),
                          splat(sum(missing.y) + per_length * e.offset_end[1]),
                          splat(sum(missing.z) + per_length * e.offset_end[2])};
    for (int v = 0; v < kVectors; ++v) store(e.dense_tangent, v, load(e.dense_tangent, v) + constant);
    const Vectors offset = integral(e.dense_tangent);
    for (int v = 0; v < kVectors; ++v) {
      const Lanes3 r = h * offset.at[v];
      const LanesMatrix B = bendOf(e, R[v]), S = stretchOf(e, R[v].z);
      const LanesMatrix K{cross(r, B.x), cross(r, B.y), cross(r, B.z)}, Kr = timesHat(K, r);
      storeSymmetric(e.density, v, LanesMatrix{S.x - Kr.x, S.y - Kr.y, S.z - Kr.z});
      storeMatrix(e.density + 6, v, K);
      storeSymmetric(e.density + 15, v, B);
    }
    Lanes total[kPackedSize];
    for (int i = 0; i < kPackedSize; ++i) {
      total[i] = h * load(t.b, 0) * load(e.density[i], 0);
      for (int v = 1; v < kVectors; ++v) total[i] += h * load(t.b, v) * load(e.density[i], v);
    }
    sums(total, e.compliance);
  }

  // Everything as Legendre series in x, integrated from 0 to x, which is exactly nothing at x = 0:
  //   int P_k(xi) dx = (xi^2 - 1) P_k'(xi) / (2 k (k + 1)),  P_{k+1}' = P_{k-1}' + (2 k + 1) P_k,  xi = 2 x - 1.
  static void stations(const ElementState& e, const StationBatch& s, int v) {
    const GaussLegendre& t = table();
    const Lanes x = load(s.fraction, v), xi = 2.0 * x - 1.0, bubble = 2.0 * x * (x - 1.0);
    Lanes integral[kDense], before = splat(1.0), now = xi, slope_before{}, slope = splat(1.0);
    integral[0] = x;
#pragma GCC unroll 12
    for (int k = 1; k < kDense; ++k) {
      integral[k] = bubble * slope * (1.0 / (k * (k + 1)));
      const Lanes next_slope = slope_before + (2.0 * k + 1.0) * now;
      const Lanes next = ((2.0 * k + 1.0) / (k + 1.0)) * xi * now - (k / (k + 1.0)) * before;
      slope_before = slope, slope = next_slope;
      before = now, now = next;
    }
    Lanes3 g{};
    if (e.unloaded) g = cayleyOfRotation((e.length * x) * splat(e.rest_curvature));
    else for (int k = 0; k < e.series_terms; ++k) g = g + integral[k] * splat(e.g_rate_series[k]);
    const LanesMatrix R = splatMatrix(e.R_start) * cayley(g);

    Lanes weight[kDense];
#pragma GCC unroll 12
    for (int k = 0; k < kDense; ++k) integral[k] *= e.length;
#pragma GCC unroll 12
    for (int j = 0; j < kDense; ++j) {
      weight[j] = integral[0] * t.legendre[0][j];
#pragma GCC unroll 12
      for (int k = 1; k < kDense; ++k) weight[j] += integral[k] * t.legendre[k][j];
    }
    const auto upTo = [&](const NodeRow& row) {
      Lanes total = weight[0] * row[0];
#pragma GCC unroll 12
      for (int j = 1; j < kDense; ++j) total += weight[j] * row[j];
      return total;
    };
    const Lanes3 r{upTo(e.dense_tangent[0]), upTo(e.dense_tangent[1]), upTo(e.dense_tangent[2])};
    Lanes c[kPackedSize];
    #pragma GCC unroll 21
    for (int i = 0; i < kPackedSize; ++i) c[i] = s.start_compliance[i] + upTo(e.density[i]);
    // From the element's start to the section: K -> K - hat(r) W, P -> P - hat(r) K^T + K_new hat(r).
    const LanesMatrix P{{c[0], c[1], c[2]}, {c[1], c[3], c[4]}, {c[2], c[4], c[5]}};
    const LanesMatrix K{{c[6], c[9], c[12]}, {c[7], c[10], c[13]}, {c[8], c[11], c[14]}};
    const LanesMatrix W{{c[15], c[16], c[17]}, {c[16], c[18], c[19]}, {c[17], c[19], c[20]}};
    const LanesMatrix K_new{K.x - cross(r, W.x), K.y - cross(r, W.y), K.z - cross(r, W.z)};
    const LanesMatrix a{cross(r, Lanes3{K.x.x, K.y.x, K.z.x}), cross(r, Lanes3{K.x.y, K.y.y, K.z.y}),
                        cross(r, Lanes3{K.x.z, K.y.z, K.z.z})};
    const LanesMatrix b = timesHat(K_new, r);
    const LanesMatrix P_new{P.x - a.x + b.x, P.y - a.y + b.y, P.z - a.z + b.z};

    const Lanes3 p = splat(s.p_start) + r;
    const Lanes pose[12] = {R.x.x, R.x.y, R.x.z, R.y.x, R.y.y, R.y.z, R.z.x, R.z.y, R.z.z, p.x, p.y, p.z};
    const Lanes compliance[36] = {
        P_new.x.x, P_new.x.y, P_new.x.z, K_new.x.x, K_new.y.x, K_new.z.x,  //
        P_new.x.y, P_new.y.y, P_new.y.z, K_new.x.y, K_new.y.y, K_new.z.y,  //
        P_new.x.z, P_new.y.z, P_new.z.z, K_new.x.z, K_new.y.z, K_new.z.z,  //
        K_new.x.x, K_new.x.y, K_new.x.z, W.x.x,     W.x.y,     W.x.z,      //
        K_new.y.x, K_new.y.y, K_new.y.z, W.x.y,     W.y.y,     W.y.z,      //
        K_new.z.x, K_new.z.y, K_new.z.z, W.x.z,     W.y.z,     W.z.z};
    storeAcross(pose, s.pose + kLanes * v);
    storeAcross(compliance, s.compliance + kLanes * v);
  }
};

// Relative error of interpolation by kDense nodes in an element that bends by x rad, at its worst section. Arcs of any
// bending up to kMaxUnloadedBending err by 0.6 to 1 of it.
template <int kDense>
LIVE_STIFFNESS_INLINE double interpolationError(double x_squared) {
  double error = (kDense == 4 ? 2.0e-3 : kDense == 8 ? 2.7e-8 : 1.7e-13) * (1.0 + 0.25 * x_squared);
  for (int i = 2; i < kDense; i += 2) error *= x_squared;
  return error;
}

// The same of the integral over the whole element; of 8 nodes and more it is below rounding.
template <int kDense>
LIVE_STIFFNESS_INLINE double quadratureError(double x_squared) {
  return kDense == 4 ? 5e-8 * x_squared * x_squared * x_squared * (1.0 + 0.25 * x_squared) : 0.0;
}

// On the cheapest grid that is accurate enough.
template <int kStages>
struct MaterialChoice {
  static void material(ElementState& e, bool unloaded, double accuracy) {
    constexpr double kImprovement = 20.0;
    double bending = e.length * e.length * squaredNorm(e.rest_curvature), error = 0.0;
    bool improved = false;
    if (!unloaded) {
      const GaussLegendre& t = gaussLegendre(kStages);
      Lanes square{};
      for (int v = 0; v < (kStages + kLanes - 1) / kLanes; ++v)
        square += load(t.b, v) * dot(load(e.g_rate, v), load(e.g_rate, v));
      bending = e.length * e.length * sum(square);
      improved = e.interior_error > accuracy;
      error = improved ? e.interior_error / kImprovement : e.interior_error;
    }
    e.unloaded = unloaded;
    if (kStages <= 4 && interpolationError<4>(bending) <= accuracy) run<4>(e, bending, error, improved);
    else if (interpolationError<8>(bending) <= accuracy) run<8>(e, bending, error, improved);
    else run<12>(e, bending, error, improved);
  }

  static void stations(const ElementState& e, const StationBatch& s) {
    for (int v = 0; kLanes * v < s.size; ++v) {
      switch (e.dense_nodes) {
        case 4: Material<4>::stations(e, s, v); break;
        case 8: Material<8>::stations(e, s, v); break;
        default: Material<12>::stations(e, s, v);
      }
    }
  }

 private:
  template <int kDense>
  static LIVE_STIFFNESS_INLINE void run(ElementState& e, double bending, double collocation_error, bool improved) {
    e.dense_nodes = kDense;
    e.station_error = interpolationError<kDense>(bending) + collocation_error;
    e.compliance_error = quadratureError<kDense>(bending);
    Material<kDense>::material(e, kStages, e.unloaded, improved);
  }
};

}  // namespace
}  // namespace live_stiffness
