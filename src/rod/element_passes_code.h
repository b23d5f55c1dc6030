#pragma once
// The equations of one element, see docs/derivation.md. In body axes the actuation wrench of a fluidic segment is
// constant along it, so it is a rest strain and not a load:
//   v = e3 + c_se R^T n,   u = u_rest + c_bt R^T m                                             (7), (9), (37)
//   p' = R v,  R' = R hat(u),  n' = -w - R f,  m' = -p' x n                                    (8)
// with n, m the external loads only. Collocated at the Gauss nodes; one lane is one node, the last one the end.

#include "rod/element_passes_tables.h"
#include "rod/lanes.h"

namespace live_stiffness {
namespace {

template <int kStages>
struct Passes {
  static constexpr int kVectors = (kStages + kLanes) / kLanes;  // nodes and end
  static constexpr int kDense = kStages <= 5 ? 8 : 12;  // nodes of material()
  static constexpr int kDenseVectors = kDense / kLanes;

  struct Tables {
    const GaussLegendre& stages = gaussLegendre(kStages);
    const GaussLegendre& dense = gaussLegendre(kDense);
    const NodeTransfer to_dense = makeTransfer(kStages, kDense);
  };
  static LIVE_STIFFNESS_INLINE const Tables& tables() {
    static const Tables tables;
    return tables;
  }

  // Integrals from the start to the nodes and the end, over a unit length.
  struct Rows {
    Lanes3 at[kVectors];
  };
  static LIVE_STIFFNESS_INLINE Rows integral(const GaussLegendre& t, const StageRow (&f)[3]) {
    Rows sum{};
#pragma GCC unroll 8
    for (int j = 0; j < kStages; ++j) {
      const Lanes x = splat(f[0][j]), y = splat(f[1][j]), z = splat(f[2][j]);
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) {
        const Lanes a = load(t.a[j], v);
        sum.at[v].x += a * x;
        sum.at[v].y += a * y;
        sum.at[v].z += a * z;
      }
    }
    return sum;
  }

  template <bool kFinish>
  static void pass(ElementState& e) {
    const GaussLegendre& t = tables().stages;
    const Lanes h = splat(e.length);
    double n_start[3], m_start[3], line_load[3];  // in the axes of the start, as everything below
    rotateBack(e.R_start, e.n_start, n_start);
    rotateBack(e.R_start, e.m_start, m_start);
    rotateBack(e.R_start, e.line_load, line_load);
    const double reach[3] = {e.length * line_load[0], e.length * line_load[1], e.length * line_load[2]};

    LanesMatrix R[kVectors];
    Rows follower{};
    for (int v = 0; v < kVectors; ++v) R[v] = cayley(load(e.g, v));
    if (e.follows) {
      StageRow f[3];
      for (int v = 0; v < kVectors; ++v) store(f, v, R[v] * splat(e.follower_load));
      follower = integral(t, f);
    }
    StageRow m_rate[3], n_rows[3], m_rows[3];
    Lanes3 tangent[kVectors];
    for (int v = 0; v < kVectors; ++v) {
      Lanes3 n = splat(n_start) - load(t.c, v) * splat(reach);
      if (e.follows) n = n - h * follower.at[v];
      tangent[v] = tangentOf(e, R[v].z, n);
      store(m_rate, v, cross(n, tangent[v]));
      store(n_rows, v, n);
    }
    const Rows moment = integral(t, m_rate);
    for (int v = 0; v < kVectors; ++v) {
      const Lanes3 m = splat(m_start) + h * moment.at[v];
      store(e.g_rate, v, cayleyRate(load(e.g, v), curvatureOf(e, R[v], m)));
      store(m_rows, v, m);
    }
    const Rows next = integral(t, e.g_rate);
    Lanes change{}, size{};
    for (int v = 0; v < kVectors; ++v) {
      const Lanes3 before = load(e.g, v), after = h * next.at[v], step = after - before;
      change += dot(step, step);
      size += dot(before, before);
      store(e.g, v, after);
    }
    e.change = __builtin_sqrt(sum(change));
    e.size = __builtin_sqrt(sum(size));
    endState(e, n_rows, m_rows);
    if (!kFinish) return;

    const LanesMatrix R_start = splatMatrix(e.R_start);
    for (int v = 0; v < kVectors; ++v) {
      storeMatrix(e.R, v, R_start * R[v]);
      store(e.tangent, v, R_start * tangent[v]);
      store(e.n, v, R_start * load(n_rows, v));
      store(e.m, v, R_start * load(m_rows, v));
    }
    const Rows offset = integral(t, e.tangent);
    for (int v = 0; v < kVectors; ++v) store(e.offset, v, h * offset.at[v]);
    for (int i = 0; i < 3; ++i) e.offset_end[i] = e.offset[i][kStages];
    estimateTruncation(e, t);
  }

  static LIVE_STIFFNESS_INLINE Lanes3 curvatureOf(const ElementState& e, const LanesMatrix& R, Lanes3 m) {
    const Lanes3 b = transposedTimes(R, m);
    return {e.rest_curvature[0] + e.bend_xx * b.x + e.bend_xy * b.y,
            e.rest_curvature[1] + e.bend_xy * b.x + e.bend_yy * b.y, e.rest_curvature[2] + e.torsion * b.z};
  }

  static LIVE_STIFFNESS_INLINE Lanes3 tangentOf(const ElementState& e, Lanes3 z, Lanes3 n) {
    return (1.0 + (e.elongation - e.shear) * dot(z, n)) * z + splat(e.shear) * n;
  }

  static LIVE_STIFFNESS_INLINE void endState(ElementState& e, const StageRow (&n)[3], const StageRow (&m)[3]) {
    rotate(e.R_start, {n[0][kStages], n[1][kStages], n[2][kStages]}, e.n_end);
    rotate(e.R_start, {m[0][kStages], m[1][kStages], m[2][kStages]}, e.m_end);
    endRotation(e);
  }

  static LIVE_STIFFNESS_INLINE void endRotation(ElementState& e) {
    const double g[3] = {e.g[0][kStages], e.g[1][kStages], e.g[2][kStages]};
    const double k = 2.0 / (4.0 + g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    const double kg[3] = {k * g[0], k * g[1], k * g[2]};
    const double xx = kg[0] * g[0], yy = kg[1] * g[1], zz = kg[2] * g[2];
    const double xy = kg[0] * g[1], xz = kg[0] * g[2], yz = kg[1] * g[2];
    const double x = 2.0 * kg[0], y = 2.0 * kg[1], z = 2.0 * kg[2];
    double column[3];
    const auto put = [&](int j) {
      for (int i = 0; i < 3; ++i) e.R_end[3 * i + j] = column[i];
    };
    rotate(e.R_start, {1.0 - yy - zz, xy + z, xz - y}, column), put(0);
    rotate(e.R_start, {xy - z, 1.0 - xx - zz, yz + x}, column), put(1);
    rotate(e.R_start, {xz + y, yz - x, 1.0 - xx - yy}, column), put(2);
  }

  static constexpr double kDecay = 0.05;
  static LIVE_STIFFNESS_INLINE double largerOf(double a, double b) { return a > b ? a : b; }

  // The highest coefficient alone may pass through zero by accident; the one below it says how large it could be.
  static LIVE_STIFFNESS_INLINE void estimateTruncation(ElementState& e, const GaussLegendre& t) {
    double top = 0.0, below = 0.0;
    for (int i = 0; i < 3; ++i) {
      double a = 0.0, b = 0.0;
      for (int j = 0; j < kStages; ++j) {
        a += t.legendre[kStages - 1][j] * e.g_rate[i][j];
        b += t.legendre[kStages - 2][j] * e.g_rate[i][j];
      }
      top += a * a;
      below += b * b;
    }
    e.truncation = __builtin_fabs(e.length) * __builtin_sqrt(largerOf(top, kDecay * kDecay * below));
    // Between the nodes the first coefficient left out shows, once integrated; it goes on shrinking as the last ones.
    double shrink = below > 0.0 ? __builtin_sqrt(top / below) : 0.0;
    shrink = shrink < kDecay ? kDecay : shrink > 1.0 ? 1.0 : shrink;
    e.interior_error = e.truncation * shrink / kStages;
  }

  static void finish(ElementState& e) { pass<true>(e); }

  // sin(t) / t, (1 - cos(t)) / t^2 and (t - sin(t)) / t^3 in x = t^2, good to rounding up to kMaxUnloadedBending.
  static constexpr int kTerms = 10;
  static constexpr double kSine[kTerms] = {
      1.0, -0.16666666666666666, 0.008333333333333333, -0.0001984126984126984, 2.7557319223985893e-06,
      -2.505210838544172e-08, 1.6059043836821613e-10, -7.647163731819816e-13, 2.8114572543455206e-15,
      -8.22063524662433e-18};
  static constexpr double kCosine[kTerms] = {
      0.5, -0.041666666666666664, 0.001388888888888889, -2.48015873015873e-05, 2.755731922398589e-07,
      -2.08767569878681e-09, 1.1470745597729725e-11, -4.779477332387385e-14, 1.5619206968586225e-16,
      -4.110317623312165e-19};
  static constexpr double kThird[kTerms] = {
      0.16666666666666666, -0.008333333333333333, 0.0001984126984126984, -2.7557319223985893e-06,
      2.505210838544172e-08, -1.6059043836821613e-10, 7.647163731819816e-13, -2.8114572543455206e-15,
      8.22063524662433e-18, -1.9572941063391263e-20};
  static LIVE_STIFFNESS_INLINE Lanes series(const double (&k)[kTerms], Lanes x) {
    Lanes value = splat(k[kTerms - 1]);
#pragma GCC unroll 10
    for (int i = kTerms - 2; i >= 0; --i) value = value * x + k[i];
    return value;
  }

  // 2 tan(|w| / 2) along w: the Cayley vector of the rotation vector w, |w| up to kMaxUnloadedBending.
  static LIVE_STIFFNESS_INLINE Lanes3 cayleyOfRotation(Lanes3 w) {
    const Lanes x = dot(w, w);
    return (2.0 * series(kSine, x) / (2.0 - x * series(kCosine, x))) * w;
  }

  static void placeUnloaded(ElementState& e) {
    const GaussLegendre& t = tables().stages;
    const Lanes3 u = splat(e.rest_curvature);
    const LanesMatrix R_start = splatMatrix(e.R_start);
    for (int v = 0; v < kVectors; ++v) {
      const Lanes s = splat(e.length) * load(t.c, v);
      const Lanes3 w = s * u, turn{w.y, -w.x, Lanes{}};  // turn: w x e3
      const Lanes3 g = cayleyOfRotation(w);
      store(e.g, v, g);
      store(e.g_rate, v, cayleyRate(g, u));
      const Lanes x = dot(w, w);
      const Lanes3 bend = series(kCosine, x) * turn + series(kThird, x) * cross(w, turn);
      store(e.offset, v, s * (R_start * Lanes3{bend.x, bend.y, 1.0 + bend.z}));
    }
    endRotation(e);
    for (int i = 0; i < 3; ++i) {
      e.offset_end[i] = e.offset[i][kStages];
      e.n_end[i] = e.m_end[i] = 0.0;
    }
    e.change = e.truncation = 0.0;
    // First Legendre coefficient that the dense nodes miss of what turns twice as fast as the rod.
    const double* k = e.rest_curvature;
    const double half = e.length * e.length * (k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
    e.interior_error = 1.0;
    for (int i = 1; i <= kDense; ++i) e.interior_error /= 2 * i + 1;
    for (int i = 0; i < kDense; i += 2) e.interior_error *= half;
  }

  // R c R^T of both densities, using that R^T R = I: bend = yy I + (xx - yy) x x^T + ... + (torsion - yy) z z^T.
  static LIVE_STIFFNESS_INLINE LanesMatrix bendOf(const ElementState& e, const LanesMatrix& R) {
    const Lanes3 a = splat(e.bend_xx - e.bend_yy) * R.x + splat(e.bend_xy) * R.y, b = splat(e.bend_xy) * R.x,
                 c = splat(e.torsion - e.bend_yy) * R.z;
    LanesMatrix B{R.x.x * a + R.y.x * b + R.z.x * c, R.x.y * a + R.y.y * b + R.z.y * c,
                  R.x.z * a + R.y.z * b + R.z.z * c};
    B.x.x += e.bend_yy, B.y.y += e.bend_yy, B.z.z += e.bend_yy;
    return B;
  }
  static LIVE_STIFFNESS_INLINE LanesMatrix stretchOf(const ElementState& e, Lanes3 z) {
    const Lanes3 c = splat(e.elongation - e.shear) * z;
    LanesMatrix S{z.x * c, z.y * c, z.z * c};
    S.x.x += e.shear, S.y.y += e.shear, S.z.z += e.shear;
    return S;
  }

  static void linearise(ElementState& e) {
    const Lanes h = splat(e.length);
    Lanes stretch[6] = {};
    for (int v = 0; v < kVectors; ++v) {
      const LanesMatrix R = loadMatrix(e.R, v), B = bendOf(e, R), S = stretchOf(e, R.z);
      const Lanes b = load(tables().stages.b, v) * h;
      stretch[0] += b * S.x.x, stretch[1] += b * S.y.x, stretch[2] += b * S.z.x;
      stretch[3] += b * S.y.y, stretch[4] += b * S.z.y, stretch[5] += b * S.z.z;
      const Lanes3 n = load(e.n, v), tangent = load(e.tangent, v), m = load(e.m, v);
      storeSymmetric(e.bend, v, LanesMatrix{h * B.x, h * B.y, h * B.z});
      storeMatrix(e.phi_of_phi, v, timesHat(B, h * m));
      // P = S hat(n) - hat(tangent) = hat(shear n - tangent) + (elongation - shear) z (z x n)^T
      const Lanes3 z = h * R.z, a = h * (splat(e.shear) * n - tangent), k = splat(e.elongation - e.shear) * cross(R.z, n);
      const LanesMatrix P{{k.x * z.x, a.z + k.x * z.y, k.x * z.z - a.y},
                          {k.y * z.x - a.z, k.y * z.y, a.x + k.y * z.z},
                          {a.y + k.z * z.x, k.z * z.y - a.x, k.z * z.z}};
      storeMatrix(e.p_of_phi, v, P);
      storeMatrix(e.m_of_phi, v, LanesMatrix{cross(n, P.x), cross(n, P.y), cross(n, P.z)});
    }
    for (int i = 0; i < 6; ++i) e.stretch[i] = sum(stretch[i]);
  }

  // m' = M phi - P^T dn, dn the unit forces of columns 3 to 5.
  static LIVE_STIFFNESS_INLINE void updateMoments(ElementState& e, const ElementColumns& start, int k) {
    StageRow rate[3];
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) {
      Lanes3 m_rate = loadMatrix(e.m_of_phi, v) * load(e.phi[k], v);
      if (k >= 3) {
        const StageRow* row = e.p_of_phi + 3 * (k - 3);
        m_rate = m_rate - Lanes3{load(row[0], v), load(row[1], v), load(row[2], v)};
      }
      store(rate, v, m_rate);
    }
    const Rows moment = integral(tables().stages, rate);
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) store(e.dm[k], v, splat(start.m[k]) + moment.at[v]);
  }

  // Moments, then phi' = B dm + D phi. In this order the change of phi shows whatever is not yet right.
  static void columnPass(ElementState& e, const ElementColumns& start) {
    Lanes change[2] = {}, size[2] = {};  // base moment and tip force have their own units
    for (int k = 0; k < 6; ++k) {
      updateMoments(e, start, k);
      StageRow rate[3];
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v)
        store(rate, v, loadSymmetric(e.bend, v) * load(e.dm[k], v) + loadMatrix(e.phi_of_phi, v) * load(e.phi[k], v));
      const Rows turn = integral(tables().stages, rate);
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) {
        const Lanes3 next = splat(start.phi[k]) + turn.at[v], step = next - load(e.phi[k], v);
        change[k / 3] += dot(step, step);
        size[k / 3] += dot(next, next);
        store(e.phi[k], v, next);
      }
    }
    const double a = sum(change[0]) / (sum(size[0]) + 1e-300), b = sum(change[1]) / (sum(size[1]) + 1e-300);
    e.column_change = __builtin_sqrt(a + b);
  }

  // A turn phi of a section in space, R -> exp(hat(phi)) R, turns g at the rate phi - g x phi / 2 + g (g . phi) / 4.
  static void follow(ElementState& e, const double (&change)[3]) {
    double turn_start[3] = {};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) turn_start[i] += change[k] * e.phi_start[k][i];
    const LanesMatrix R_start = splatMatrix(e.R_start);
    for (int v = 0; v < kVectors; ++v) {
      Lanes3 turn = Lanes3{} - splat(turn_start);
      for (int k = 0; k < 3; ++k) turn = turn + splat(change[k]) * load(e.phi[k], v);
      const Lanes3 g = load(e.g, v), phi = transposedTimes(R_start, turn);
      store(e.g, v, g + phi - splat(0.5) * (cross(g, phi) - (0.5 * dot(g, phi)) * g));
    }
  }

  static void columnEnd(ElementState& e, const ElementColumns& start, ElementColumns& end) {
    static constexpr int kSymmetric[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    const GaussLegendre& t = tables().stages;
    for (int k = 0; k < 6; ++k) {
      updateMoments(e, start, k);
      Lanes3 p{};
      for (int v = 0; v < kVectors; ++v) p = p + load(t.b, v) * (loadMatrix(e.p_of_phi, v) * load(e.phi[k], v));
      const double moved[3] = {sum(p.x), sum(p.y), sum(p.z)};
      for (int i = 0; i < 3; ++i) {
        end.p[k][i] = start.p[k][i] + moved[i] + (k >= 3 ? e.stretch[kSymmetric[i][k - 3]] : 0.0);
        end.phi[k][i] = e.phi[k][i][kStages];
        end.m[k][i] = e.dm[k][i][kStages];
      }
    }
    // As estimateTruncation() of the shape, which says nothing of a straight rod under load.
    Lanes top_row[kVectors], below_row[kVectors];
    for (int v = 0; v < kVectors; ++v) top_row[v] = load(t.legendre[kStages - 1], v), below_row[v] = load(t.legendre[kStages - 2], v);
    double top = 0.0, below = 0.0, size = 1e-300;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) {
        Lanes a{}, b{};
        for (int v = 0; v < kVectors; ++v) {
          const Lanes dm = load(e.dm[k][i], v);
          a += top_row[v] * dm;
          b += below_row[v] * dm;
        }
        const double x = sum(a), y = sum(b);
        top += x * x, below += y * y, size += end.phi[k][i] * end.phi[k][i];
      }
    const double turn = e.length * largerOf(e.bend_xx, e.bend_yy);  // by the unit moment
    e.column_truncation = turn * turn * largerOf(top, kDecay * kDecay * below) / size;
  }

  static LIVE_STIFFNESS_INLINE Lanes3 denseIntegral(const GaussLegendre& t, const NodeRow (&f)[3], int v) {
    Lanes3 sum{};
#pragma GCC unroll 12
    for (int j = 0; j < kDense; ++j) {
      const Lanes a = load(t.a[j], v);
      sum.x += a * f[0][j], sum.y += a * f[1][j], sum.z += a * f[2][j];
    }
    return sum;
  }

  // Cayley vectors at the dense nodes: closed, or from collocation, by its polynomial and, if `improve`, by one more
  // pass on the dense nodes. Leaves the Legendre series of their rate.
  static LIVE_STIFFNESS_INLINE void denseVectors(ElementState& e, bool unloaded, bool improve, Lanes3 (&g)[kDenseVectors]) {
    const Tables& tables = Passes::tables();
    const GaussLegendre& t = tables.dense;
    const Lanes h = splat(e.length);
    if (unloaded) {
      for (int v = 0; v < kDenseVectors; ++v) g[v] = cayleyOfRotation((h * load(t.c, v)) * splat(e.rest_curvature));
      return;
    }
    for (int v = 0; v < kDenseVectors; ++v) {
      g[v] = Lanes3{};
      for (int j = 0; j < kStages; ++j) {
        const Lanes a = h * load(tables.to_dense.integral[j], v);
        g[v].x += a * e.g_rate[0][j], g[v].y += a * e.g_rate[1][j], g[v].z += a * e.g_rate[2][j];
      }
    }
    if (improve) {
      double n_start[3], m_start[3], line_load[3];
      rotateBack(e.R_start, e.n_start, n_start);
      rotateBack(e.R_start, e.m_start, m_start);
      rotateBack(e.R_start, e.line_load, line_load);
      NodeRow rate[3];
      LanesMatrix R[kDenseVectors];
      for (int v = 0; v < kDenseVectors; ++v) {
        R[v] = cayley(g[v]);
        const Lanes3 n = splat(n_start) - (h * load(t.c, v)) * splat(line_load);
        store(rate, v, cross(n, tangentOf(e, R[v].z, n)));
      }
      Lanes3 u[kDenseVectors];
      for (int v = 0; v < kDenseVectors; ++v)
        u[v] = curvatureOf(e, R[v], splat(m_start) + h * denseIntegral(t, rate, v));
      for (int v = 0; v < kDenseVectors; ++v) store(rate, v, cayleyRate(g[v], u[v]));
      for (int v = 0; v < kDenseVectors; ++v) g[v] = h * denseIntegral(t, rate, v);
      fillSeries(e, t, kDense, rate);
    } else {
      fillSeries(e, tables.stages, kStages, e.g_rate);
    }
  }

  template <class Row>
  static LIVE_STIFFNESS_INLINE void fillSeries(ElementState& e, const GaussLegendre& t, int nodes, const Row (&rate)[3]) {
    for (int k = 0; k < nodes; ++k)
      for (int i = 0; i < 3; ++i) {
        double coefficient = 0.0;
        for (int j = 0; j < nodes; ++j) coefficient += t.legendre[k][j] * rate[i][j];
        e.g_rate_series[k][i] = e.length * coefficient;
      }
    for (int k = nodes; k < kDense; ++k) e.g_rate_series[k][0] = e.g_rate_series[k][1] = e.g_rate_series[k][2] = 0.0;
  }

  // On the dense nodes: with r from the start to the node, [S - K hat(r), K; K^T, B], K = hat(r) B, integrand of (10).
  // What is made of g varies faster than g itself, hence the finer grid.
  static void material(ElementState& e, bool unloaded, bool improve) {
    const GaussLegendre& t = tables().dense;
    const Lanes h = splat(e.length);
    e.unloaded = unloaded;
    Lanes3 g[kDenseVectors];
    denseVectors(e, unloaded, improve, g);
    const LanesMatrix R_start = splatMatrix(e.R_start);
    const Lanes3 n_start = splat(e.n_start), reach = h * splat(e.line_load);
    LanesMatrix R[kDenseVectors];
    for (int v = 0; v < kDenseVectors; ++v) {
      R[v] = R_start * cayley(g[v]);
      store(e.dense_tangent, v, tangentOf(e, R[v].z, n_start - load(t.c, v) * reach));
    }
    // Collocation is more accurate at the end than on the way; a constant takes the difference out.
    Lanes3 missing{};
    for (int v = 0; v < kDenseVectors; ++v) missing = missing - load(t.b, v) * load(e.dense_tangent, v);
    const double per_length = 1.0 / e.length;
    const Lanes3 constant{splat(sum(missing.x) + per_length * e.offset_end[0]),
                          splat(sum(missing.y) + per_length * e.offset_end[1]),
                          splat(sum(missing.z) + per_length * e.offset_end[2])};
    for (int v = 0; v < kDenseVectors; ++v) store(e.dense_tangent, v, load(e.dense_tangent, v) + constant);
    Lanes total[kPackedSize] = {};
    for (int v = 0; v < kDenseVectors; ++v) {
      const Lanes3 r = h * denseIntegral(t, e.dense_tangent, v);
      const LanesMatrix B = bendOf(e, R[v]), S = stretchOf(e, R[v].z);
      const LanesMatrix K{cross(r, B.x), cross(r, B.y), cross(r, B.z)}, Kr = timesHat(K, r);
      storeSymmetric(e.density, v, LanesMatrix{S.x - Kr.x, S.y - Kr.y, S.z - Kr.z});
      storeMatrix(e.density + 6, v, K);
      storeSymmetric(e.density + 15, v, B);
      const Lanes b = h * load(t.b, v);
      for (int i = 0; i < kPackedSize; ++i) total[i] += b * load(e.density[i], v);
    }
    for (int i = 0; i < kPackedSize; ++i) e.compliance[i] = sum(total[i]);
  }

  // Everything as Legendre series in x, integrated from 0 to x, which is exactly nothing at x = 0:
  //   int P_k(xi) dx = (xi^2 - 1) P_k'(xi) / (2 k (k + 1)),  P_{k+1}' = P_{k-1}' + (2 k + 1) P_k,  xi = 2 x - 1.
  static void stations(const ElementState& e, StationBatch& s) {
    const GaussLegendre& t = tables().dense;
    for (int v = 0; v < kStationBatch / kLanes; ++v) {
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
      else for (int k = 0; k < kDense; ++k) g = g + integral[k] * splat(e.g_rate_series[k]);
      storeMatrix(s.R, v, splatMatrix(e.R_start) * cayley(g));

      Lanes weight[kDense];
      for (int j = 0; j < kDense; ++j) {
        weight[j] = integral[0] * t.legendre[0][j];
        for (int k = 1; k < kDense; ++k) weight[j] += integral[k] * t.legendre[k][j];
        weight[j] *= e.length;
      }
      const auto upTo = [&](const NodeRow& row) {
        Lanes total = weight[0] * row[0];
        for (int j = 1; j < kDense; ++j) total += weight[j] * row[j];
        return total;
      };
      const Lanes3 r{upTo(e.dense_tangent[0]), upTo(e.dense_tangent[1]), upTo(e.dense_tangent[2])};
      store(s.offset, v, r);
      for (int i = 0; i < kPackedSize; ++i) store(s.compliance[i], v, s.start_compliance[i] + upTo(e.density[i]));
      // From the element's start to the section: K -> K - hat(r) W, P -> P - hat(r) K^T + K_new hat(r).
      const LanesMatrix P = loadSymmetric(s.compliance, v), W = loadSymmetric(s.compliance + 15, v),
                        K = loadMatrix(s.compliance + 6, v);
      const LanesMatrix K_new{K.x - cross(r, W.x), K.y - cross(r, W.y), K.z - cross(r, W.z)};
      const LanesMatrix a{cross(r, Lanes3{K.x.x, K.y.x, K.z.x}), cross(r, Lanes3{K.x.y, K.y.y, K.z.y}),
                          cross(r, Lanes3{K.x.z, K.y.z, K.z.z})};
      const LanesMatrix b = timesHat(K_new, r);
      storeSymmetric(s.compliance, v, LanesMatrix{P.x - a.x + b.x, P.y - a.y + b.y, P.z - a.z + b.z});
      storeMatrix(s.compliance + 6, v, K_new);
    }
  }

  static constexpr ElementPasses functions() {
    return {kStages, pass<false>, finish, placeUnloaded, linearise, columnPass, follow, columnEnd, material, stations};
  }
};

}  // namespace
}  // namespace live_stiffness

#define LIVE_STIFFNESS_PASSES                                                                        \
  {Passes<2>::functions(), Passes<3>::functions(), Passes<4>::functions(), Passes<5>::functions(),   \
   Passes<6>::functions(), Passes<7>::functions()}
