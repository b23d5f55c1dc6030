#pragma once
// Material compliance (10) inside one element, on a Gauss grid of its own: what is made of the rotations varies faster
// than they do, so it is denser than the stages, the denser the more the element bends. One lane is one node, or one
// station.

#include "rod/element_arc_code.h"
#include "rod/packed_compliance_code.h"

namespace live_stiffness {
namespace {

template <int kDense>
struct Material {
  static constexpr int kVectors = kDense / kPackSize;

  static LIVE_STIFFNESS_INLINE const GaussLegendre& table() {
    static const GaussLegendre& table = gaussLegendre(kDense);
    return table;
  }
  static LIVE_STIFFNESS_INLINE const NodeTransfer& transfer(int stages) {
    struct Transfers {
      NodeTransfer from[kMaxStages + 1];
      Transfers() {
        for (int stages : kStageCounts) from[stages] = makeTransfer(stages, kDense);
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
      const Pack x = splat(f[0][j]), y = splat(f[1][j]), z = splat(f[2][j]);
      for (int v = 0; v < kVectors; ++v) {
        const Pack a = load(table().a[j], v);
        sum.at[v].x += a * x, sum.at[v].y += a * y, sum.at[v].z += a * z;
      }
    }
    return sum;
  }

  // One more iteration on the dense nodes: makes collocation about twenty times more accurate between its own.
  static LIVE_STIFFNESS_INLINE void improve(const ElementState& e, Vectors& g, Vectors& g_rate) {
    const GaussLegendre& t = table();
    const Pack h = splat(e.length);
    const Matrix R_start = get(e.R_start);
    const Lanes3 n_start = splat(transposedTimes(R_start, get(e.n_start)));
    const Lanes3 m_start = splat(transposedTimes(R_start, get(e.m_start)));
    const Lanes3 line_load = splat(transposedTimes(R_start, get(e.line_load)));
    NodeRow rate[3];
    PackMatrix R[kVectors];
    for (int v = 0; v < kVectors; ++v) {
      R[v] = cayley(g.at[v]);
      const Lanes3 n = n_start - (h * load(t.c, v)) * line_load;
      store(rate, v, cross(n, tangentOf(e, R[v].z, n)));
    }
    const Vectors moment = integral(rate);
    for (int v = 0; v < kVectors; ++v) {
      g_rate.at[v] = cayleyRate(g.at[v], curvatureOf(e, transposedTimes(R[v], m_start + h * moment.at[v])));
      store(rate, v, g_rate.at[v]);
    }
    const Vectors turn = integral(rate);
    for (int v = 0; v < kVectors; ++v) g.at[v] = h * turn.at[v];
  }

  // g and its rate at the dense nodes.
  static LIVE_STIFFNESS_INLINE void rotations(const ElementState& e, int stages, bool unloaded, bool improved,
                                              Vectors& g, Vectors& g_rate) {
    if (unloaded) {
      const Lanes3 u = splat(get(e.rest_curvature));
      for (int v = 0; v < kVectors; ++v) {
        g.at[v] = cayleyOfRotation((splat(e.length) * load(table().c, v)) * u);
        g_rate.at[v] = cayleyRate(g.at[v], u);
      }
      return;
    }
    const NodeTransfer& from = transfer(stages);
    const double per_length = 1.0 / e.length;
    for (int j = 0; j < stages; ++j) {
      const Lanes3 at = splat(Vector{e.g[0][j], e.g[1][j], e.g[2][j]});
      for (int v = 0; v < kVectors; ++v) {
        g.at[v] = g.at[v] + load(from.value[j], v) * at;
        g_rate.at[v] = g_rate.at[v] + (per_length * load(from.slope[j], v)) * at;
      }
    }
    if (improved) improve(e, g, g_rate);
  }

  // With r from the start to the node: [S - K hat(r), K; K^T, B], K = hat(r) B, the integrand of (10).
  static void material(ElementState& e, int stages, bool unloaded, bool improved) {
    const GaussLegendre& t = table();
    const Pack h = splat(e.length);
    Vectors g{}, g_rate{};
    rotations(e, stages, unloaded, improved, g, g_rate);
    const PackMatrix R_start = splat(get(e.R_start));
    const Lanes3 n_start = splat(get(e.n_start)), reach = h * splat(get(e.line_load));
    PackMatrix R[kVectors];
    NodeRow tangent_row[3];
    Lanes3 tangent[kVectors], missing{};
    for (int v = 0; v < kVectors; ++v) {
      R[v] = R_start * cayley(g.at[v]);
      tangent[v] = tangentOf(e, R[v].z, n_start - load(t.c, v) * reach);
      missing = missing - load(t.b, v) * tangent[v];
    }
    // Collocation is more accurate at the end than on the way; a constant takes the difference out.
    const double per_length = 1.0 / e.length;
    const Lanes3 constant{splat(sum(missing.x) + per_length * e.offset_end[0]),
                          splat(sum(missing.y) + per_length * e.offset_end[1]),
                          splat(sum(missing.z) + per_length * e.offset_end[2])};
    for (int v = 0; v < kVectors; ++v) {
      tangent[v] = tangent[v] + constant;
      store(tangent_row, v, tangent[v]);
    }
    const Vectors offset = integral(tangent_row);
    for (int v = 0; v < kVectors; ++v) {
      const Lanes3 r = h * offset.at[v], q = g_rate.at[v];
      const PackMatrix B = bendOf(e, R[v]), S = stretchOf(e, R[v].z);
      const PackMatrix K{cross(r, B.x), cross(r, B.y), cross(r, B.z)}, Kr = timesHat(K, r);
      const Pack row[kDenseRow] = {S.x.x - Kr.x.x, S.y.x - Kr.y.x, S.z.x - Kr.z.x, S.y.y - Kr.y.y, S.z.y - Kr.z.y,
                                    S.z.z - Kr.z.z, K.x.x, K.y.x, K.z.x, K.x.y, K.y.y, K.z.y, K.x.z, K.y.z, K.z.z,
                                    B.x.x, B.y.x, B.z.x, B.y.y, B.z.y, B.z.z, tangent[v].x, tangent[v].y, tangent[v].z,
                                    q.x, q.y, q.z, Pack{}};
      double* nodes[kPackSize];
      for (int lane = 0; lane < kPackSize; ++lane) nodes[lane] = e.dense[kPackSize * v + lane];
      storeAcross(row, nodes);
    }
    double weight[kDense];
    for (int j = 0; j < kDense; ++j) weight[j] = e.length * t.b[j];
    weighted<kPackedRow>(e, weight, 1, e.compliance);
  }

  // Sum of the first n numbers of the rows, weighted; weights are `apart` from one another.
  template <int n>
  static LIVE_STIFFNESS_INLINE void weighted(const ElementState& e, const double* weight, int apart, double* total) {
    constexpr int kRowVectors = n / kPackSize;
    Pack sum[kRowVectors];
#pragma GCC unroll 14
    for (int i = 0; i < kRowVectors; ++i) sum[i] = splat(weight[0]) * load(e.dense[0], i);
#pragma GCC unroll 12
    for (int j = 1; j < kDense; ++j) {
      const Pack w = splat(weight[apart * j]);
#pragma GCC unroll 14
      for (int i = 0; i < kRowVectors; ++i) sum[i] += w * load(e.dense[j], i);
    }
    for (int i = 0; i < kRowVectors; ++i) store(total, i, sum[i]);
  }

  // Weighted sums of rows, one a lane; then all about the sections.
  static void stations(const ElementState& e, const StationBatch& s, const StationResults& out, int v) {
    double weight[kDense][kPackSize] __attribute__((aligned(32))), sums[kPackSize][kDenseRow] __attribute__((aligned(32)));
    for (int j = 0; j < kDense; ++j) store(weight[j], 0, e.length * load(s.weight[j], v));
#pragma GCC unroll 4
    for (int lane = 0; lane < kPackSize; ++lane) weighted<kDenseRow>(e, &weight[0][lane], kPackSize, sums[lane]);
    Pack row[kDenseRow];
    loadAcross(sums, row);
    Lanes3 g{row[kDenseRate], row[kDenseRate + 1], row[kDenseRate + 2]};
    if (e.unloaded) g = cayleyOfRotation((e.length * load(s.fraction, v)) * splat(get(e.rest_curvature)));
    const PackMatrix R = splat(get(e.R_start)) * cayley(g);
    const Lanes3 r{row[kDenseTangent], row[kDenseTangent + 1], row[kDenseTangent + 2]};
    if (!isZero(e.start_compliance))
      for (int i = 0; i < kPackedSize; ++i) row[i] += e.start_compliance[i];
    shift(r, row);
    storeSections(e, out, v, R, r, row);
  }
};

}  // namespace
}  // namespace live_stiffness
