#pragma once
// Shape of one element:
//   p' = R v,  R' = R hat(u),  n' = -w,  m' = -p' x n                                    (8)
// collocated at the Gauss nodes; one lane is one node, the last one the end.

#include "rod/element_collocation_code.h"
#include "rod/element_section_code.h"

namespace live_stiffness {
namespace {

template <int kStages>
struct Shape : Collocation<kStages> {
  using Base = Collocation<kStages>;
  using typename Base::Rows;
  using Base::integral, Base::table, Base::kVectors;

  // What follows from the orientations of the sections, in the axes of the element's start.
  struct Section {
    PackMatrix R;
    Lanes3 n, tangent;
  };
  struct Sections {
    Section at[kVectors];
    Rows moment;
  };
  static LIVE_STIFFNESS_INLINE Sections sections(const GaussLegendre& t, const ElementState& e) {
    const Pack h = splat(e.length);
    const Matrix R_start = get(e.R_start);
    const Lanes3 n_start = splat(transposedTimes(R_start, get(e.n_start)));
    const Lanes3 m_start = splat(transposedTimes(R_start, get(e.m_start)));
    const Lanes3 reach = h * splat(transposedTimes(R_start, get(e.line_load)));
    Sections all;
    StageRow m_rate[3];
    for (int v = 0; v < kVectors; ++v) {
      Section& section = all.at[v];
      section.R = cayley(load(e.g, v));
      section.n = n_start - load(t.c, v) * reach;
      section.tangent = tangentOf(e, section.R.z, section.n);
      store(m_rate, v, cross(section.n, section.tangent));
    }
    const Rows moment = integral(t, m_rate);
    for (int v = 0; v < kVectors; ++v) all.moment.at[v] = m_start + h * moment.at[v];
    return all;
  }

  static void iterate(ElementState& e) {
    const GaussLegendre& t = table();
    const Pack h = splat(e.length);
    const Sections all = sections(t, e);
    for (int v = 0; v < kVectors; ++v)
      store(e.g_rate, v, cayleyRate(load(e.g, v), curvatureOf(e, transposedTimes(all.at[v].R, all.moment.at[v]))));
    const Rows next = integral(t, e.g_rate);
    Pack change{}, size{};
    for (int v = 0; v < kVectors; ++v) {
      const Lanes3 before = load(e.g, v), after = h * next.at[v], step = after - before;
      change += dot(step, step);
      size += dot(before, before);
      store(e.g, v, after);
    }
    e.change = __builtin_sqrt(sum(change));
    e.size = __builtin_sqrt(sum(size));
    endLoads(e, all.at[kVectors - 1].n, all.moment.at[kVectors - 1]);
  }

  // The shape at the nodes and the end, evaluated from g.
  static void evaluate(ElementState& e) {
    const GaussLegendre& t = table();
    const Pack h = splat(e.length);
    const Sections all = sections(t, e);
    const PackMatrix R_start = splat(get(e.R_start));
    for (int v = 0; v < kVectors; ++v) {
      storeMatrix(e.R, v, R_start * all.at[v].R);
      store(e.tangent, v, R_start * all.at[v].tangent);
      store(e.n, v, R_start * all.at[v].n);
      store(e.m, v, R_start * all.moment.at[v]);
    }
    const Rows offset = integral(t, e.tangent);
    for (int v = 0; v < kVectors; ++v) store(e.offset, v, h * offset.at[v]);
    for (int i = 0; i < 3; ++i) e.offset_end[i] = e.offset[i][kStages];
    endLoads(e, all.at[kVectors - 1].n, all.moment.at[kVectors - 1]);
    endRotation(e);
    estimateTruncation(e, t);
  }

  // n, m: of the vector that holds the end.
  static LIVE_STIFFNESS_INLINE void endLoads(ElementState& e, const Lanes3& n, const Lanes3& m) {
    constexpr int kPackIndex = kStages - kPackSize * (kVectors - 1);
    const Matrix R = get(e.R_start);
    put(R * Vector{n.x[kPackIndex], n.y[kPackIndex], n.z[kPackIndex]}, e.n_end);
    put(R * Vector{m.x[kPackIndex], m.y[kPackIndex], m.z[kPackIndex]}, e.m_end);
  }

  static LIVE_STIFFNESS_INLINE void endRotation(ElementState& e) {
    put(get(e.R_start) * cayley(Vector{e.g[0][kStages], e.g[1][kStages], e.g[2][kStages]}), e.R_end);
  }

  // The highest coefficient may be zero by accident; the one below it shows how large it could be.
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
    // Between the nodes the error is the integral of the first coefficient left out, extrapolated from the last ones.
    double shrink = below > 0.0 ? __builtin_sqrt(top / below) : 0.0;
    shrink = shrink < kDecay ? kDecay : shrink > 1.0 ? 1.0 : shrink;
    e.interior_error = e.truncation * shrink / kStages;
  }

  static void resetGuess(ElementState& e) {
    const GaussLegendre& t = table();
    const Vector u = curvatureOf(e, transposedTimes(get(e.R_start), get(e.m_start)));
    const double quarter = 0.25 * e.length * e.length * dot(u, u), third = (quarter < 1.0 ? quarter : 1.0) / 3.0;
    for (int v = 0; v < kVectors; ++v) {
      const Pack c = load(t.c, v);
      store(e.g, v, (e.length * c * (1.0 + third * c * c)) * splat(u));  // 2 tan(x / 2) from x
    }
  }

  // Extrapolates by `extrapolation` times the last change; for 0 only stores the present values for the next time.
  template <int n>
  static LIVE_STIFFNESS_INLINE void extrapolate(double extrapolation, StageRow (&now)[n], StageRow (&before)[n]) {
    for (int k = 0; k < n; ++k)
      for (int v = 0; v < kVectors; ++v) {
        const Pack x = load(now[k], v);
        if (extrapolation != 0.0) store(now[k], v, x + extrapolation * (x - load(before[k], v)));
        store(before[k], v, x);
      }
  }

  static void predict(ElementState& e, const double (&turn)[3], double extrapolation, int columns) {
    extrapolate(extrapolation, e.g, e.g_before);
    for (int i = 0; i < 3; ++i) {
      const double more = extrapolation != 0.0 ? turn[i] - extrapolation * e.turn[i] : turn[i];
      for (int v = 0; v < kVectors; ++v) store(e.g[i], v, load(e.g[i], v) + more * load(table().c, v));
      e.turn[i] = turn[i];
      const double m = e.m_start[i];
      e.m_start[i] += extrapolation * (m - e.m_before[i]);
      e.m_before[i] = m;
    }
    const Matrix R = get(e.R_start);
    if (extrapolation != 0.0) put(cayley(extrapolation * turnBetween(get(e.R_before), R)) * R, e.R_start);
    put(R, e.R_before);
    for (int k = 0; k < columns; ++k) {
      extrapolate(extrapolation, e.phi[k], e.phi_before[k]);
      extrapolate(extrapolation, e.phi_rate[k], e.phi_rate_before[k]);
    }
  }

  static bool integrate(ElementState& e) {
    constexpr int kMaxIterations = 80;
    constexpr double kConverged = 2e-15;  // rad, relative to 1 + |g|
    double last_change = __builtin_inf();
    bool converged = false;
    for (int i = 0; i < kMaxIterations && !converged; ++i) {
      iterate(e);
      const double goal = kConverged * (1.0 + e.size);
      if (!isAdmissible(e)) break;  // NaN, or near the singularity at half a turn
      // Rounding can keep the change just above the bound; then stop when it no longer shrinks.
      converged = e.change <= goal || (e.change <= 20.0 * goal && e.change >= last_change);
      last_change = e.change;
    }
    evaluate(e);
    return converged;
  }

  // An element may bend by up to about 2.4 rad between its ends: 4 (kStages + 1) is the square of `size` there.
  static LIVE_STIFFNESS_INLINE bool isAdmissible(const ElementState& e) { return e.size * e.size <= 4.0 * (kStages + 1); }

  static void placeUnloaded(ElementState& e) {
    const GaussLegendre& t = table();
    const Lanes3 u = splat(get(e.rest_curvature));
    const PackMatrix R_start = splat(get(e.R_start));
    for (int v = 0; v < kVectors; ++v) {
      const Pack s = splat(e.length) * load(t.c, v);
      const Lanes3 w = s * u, turn{w.y, -w.x, Pack{}};  // turn: w x e3
      const Lanes3 g = cayleyOfRotation(w);
      store(e.g, v, g);
      store(e.g_rate, v, cayleyRate(g, u));
      const Pack x = dot(w, w);
      const Lanes3 bend = series(kCosine, x) * turn + series(kThird, x) * cross(w, turn);
      store(e.offset, v, s * (R_start * Lanes3{bend.x, bend.y, 1.0 + bend.z}));
    }
    endRotation(e);
    for (int i = 0; i < 3; ++i) {
      e.offset_end[i] = e.offset[i][kStages];
      e.n_end[i] = e.m_end[i] = 0.0;
    }
    e.change = e.truncation = e.interior_error = 0.0;
  }

  // A rotation phi of a section in base axes, R -> exp(hat(phi)) R, changes g at the rate phi - g x phi / 2 + g (g . phi) / 4.
  static void follow(ElementState& e, const double (&change)[kColumns]) {
    const PackMatrix R_start = splat(get(e.R_start));
    const Vector own{change[kOfRotation], change[kOfRotation + 1], change[kOfRotation + 2]};
    for (int v = 0; v < kVectors; ++v) {
      Lanes3 turn = Lanes3{} - splat(own);
      for (int k = 0; k < kColumns; ++k)
        if (change[k] != 0.0) turn = turn + splat(change[k]) * load(e.phi[k], v);
      const Lanes3 g = load(e.g, v), phi = transposedTimes(R_start, turn);
      store(e.g, v, g + phi - splat(0.5) * (cross(g, phi) - (0.5 * dot(g, phi)) * g));
    }
  }
};

}  // namespace
}  // namespace live_stiffness
