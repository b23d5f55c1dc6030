#pragma once
// Linearised rod of one element: derivatives of its sections' rotation, position and moment by base moment and tip force
// (sensitivities; one column for each component).

#include "rod/element_collocation_code.h"
#include "rod/element_section_code.h"

namespace live_stiffness {
namespace {

template <int kStages>
struct Sensitivities : Collocation<kStages> {
  using Base = Collocation<kStages>;
  using typename Base::Rows;
  using Base::integral, Base::table, Base::kVectors;

  static void linearise(ElementState& e) {
    const Pack h = splat(e.length);
    Pack stretch[6] = {};
    for (int v = 0; v < kVectors; ++v) {
      const PackMatrix R = loadMatrix(e.R, v), B = bendOf(e, R), S = stretchOf(e, R.z);
      const Pack b = load(table().b, v) * h;
      stretch[0] += b * S.x.x, stretch[1] += b * S.y.x, stretch[2] += b * S.z.x;
      stretch[3] += b * S.y.y, stretch[4] += b * S.z.y, stretch[5] += b * S.z.z;
      const Lanes3 n = load(e.n, v), tangent = load(e.tangent, v);
      storeSymmetric(e.bend, v, PackMatrix{h * B.x, h * B.y, h * B.z});
      // P = S hat(n) - hat(tangent) = hat(shear n - tangent) + (elongation - shear) z (z x n)^T
      const Lanes3 z = h * R.z, a = h * (splat(e.shear) * n - tangent), k = splat(e.elongation - e.shear) * cross(R.z, n);
      const PackMatrix P{{k.x * z.x, a.z + k.x * z.y, k.x * z.z - a.y},
                          {k.y * z.x - a.z, k.y * z.y, a.x + k.y * z.z},
                          {a.y + k.z * z.x, k.z * z.y - a.x, k.z * z.z}};
      storeMatrix(e.p_of_phi, v, P);
      storeMatrix(e.m_of_phi, v, PackMatrix{cross(n, P.x), cross(n, P.y), cross(n, P.z)});
    }
    for (int i = 0; i < 6; ++i) e.stretch[i] = sum(stretch[i]);
  }

  // m' = M phi - P^T dn, dn the unit forces of columns 3 to 5.
  static LIVE_STIFFNESS_INLINE void updateMoments(const GaussLegendre& t, ElementState& e, const ElementSensitivities& start,
                                                  int k) {
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
    const Rows moment = integral(t, rate);
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) store(e.dm[k], v, splat(start.m[k]) + moment.at[v]);
  }

  // Displacement of the end in column k.
  static LIVE_STIFFNESS_INLINE void move(const GaussLegendre& t, const ElementState& e, int k, Pack (&along)[18]) {
    Lanes3 p{};
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) p = p + load(t.b, v) * (loadMatrix(e.p_of_phi, v) * load(e.phi[k], v));
    along[3 * k] = p.x, along[3 * k + 1] = p.y, along[3 * k + 2] = p.z;
  }

  // What an iteration computes from the sensitivities with which it starts.
  struct Found {
    double phi_end[6][3];
    Pack along[18];
    StageRow moment[6][3];   // change of the moment relative to the rotating section, mu of docs/derivation.md; phi' = B mu
    StageRow missing[6][3];  // weight times (phi' from the moments, minus phi' of which phi is the integral)
  };

  // Moments, then phi' = B (dm - phi x m), of three columns. In this order the change of phi shows every error that is left;
  // its relative size is returned.
  template <int kFirst>
  static double iterate(ElementState& e, const ElementSensitivities& start, Found& found) {
    const GaussLegendre& t = table();
    Pack change{}, size{};
    for (int k = kFirst; k < kFirst + 3; ++k) {
      updateMoments(t, e, start, k);
      move(t, e, k, found.along);
      for (int i = 0; i < 3; ++i) found.phi_end[k][i] = e.phi[k][i][kStages];
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) {
        const Lanes3 moment = load(e.dm[k], v) + cross(load(e.m, v), load(e.phi[k], v));
        const Lanes3 rate = loadSymmetric(e.bend, v) * moment;
        store(found.moment[k], v, moment);
        store(found.missing[k], v, load(t.b, v) * (rate - load(e.phi_rate[k], v)));
        store(e.phi_rate[k], v, rate);
      }
      const Rows turn = integral(t, e.phi_rate[k]);
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) {
        const Lanes3 next = splat(start.phi[k]) + turn.at[v], step = next - load(e.phi[k], v);
        change += dot(step, step);
        size += dot(next, next);
        store(e.phi[k], v, next);
      }
    }
    return __builtin_sqrt(sum(change) / (sum(size) + 1e-300));
  }

  // Iterates until the relative error is below `goal`. Returns it; infinity without convergence.
  template <int kFirst>
  static double iterateAll(ElementState& e, const ElementSensitivities& start, double goal, bool with_adjoint, Found& found) {
    constexpr int kMaxIterations = 60;
    double last_change = __builtin_inf();
    for (int i = 0; i < kMaxIterations; ++i) {
      const double change = iterate<kFirst>(e, start, found);
      // The error after an iteration is about its change times the convergence rate.
      const double rate = i > 0 && change < 0.2 * last_change ? change / last_change : 0.2;
      const double left = with_adjoint ? change : change * rate;
      if (left <= goal || (change <= 1e-13 && change >= last_change)) return left;
      if (!__builtin_isfinite(change)) break;
      last_change = change;
    }
    return __builtin_inf();
  }

  template <int kCount>
  static LIVE_STIFFNESS_INLINE void sensitivityEnd(ElementState& e, const ElementSensitivities& start, const Pack (&along)[18],
                                              const double (&phi_end)[6][3], ElementSensitivities& end) {
    static constexpr int kSymmetric[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    Pack own[3 * kCount];
    for (int i = 0; i < 3 * kCount; ++i) own[i] = along[i];
    double moved[3 * kCount];
    sums(own, moved);
    for (int k = 0; k < kCount; ++k)
      for (int i = 0; i < 3; ++i) {
        end.p[k][i] = start.p[k][i] + moved[3 * k + i] + (k >= 3 ? e.stretch[kSymmetric[i][k - 3]] : 0.0);
        end.phi[k][i] = phi_end[k][i];
        end.m[k][i] = e.dm[k][i][kStages];
      }
    for (int k = kCount; k < 6; ++k)
      for (int i = 0; i < 3; ++i) end.p[k][i] = end.phi[k][i] = end.m[k][i] = 0.0;
    estimateTruncation(table(), e, end);
  }

  // For the sensitivities with which the last iteration started.
  template <int kCount>
  static LIVE_STIFFNESS_INLINE void addAdjointResidual(const Found& found, const ElementSensitivities& start,
                                                       ElementSensitivities& end) {
    Pack work[kCount * kCount];
    for (int i = 0; i < kCount; ++i)
      for (int j = 0; j < kCount; ++j) {
        Pack total = dot(load(found.moment[i], 0), load(found.missing[j], 0));
        for (int v = 1; v < kVectors; ++v) total += dot(load(found.moment[i], v), load(found.missing[j], v));
        work[kCount * i + j] = total;
      }
    double adjoint_residual[kCount * kCount];
    sums(work, adjoint_residual);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        end.adjoint_residual[i][j] =
            i < kCount && j < kCount ? start.adjoint_residual[i][j] + adjoint_residual[kCount * i + j] : 0.0;
  }

  static void reset(ElementState& e, const ElementSensitivities& start) {
    for (int k = 0; k < 6; ++k)
      for (int v = 0; v < kVectors; ++v) {
        store(e.phi[k], v, splat(start.phi[k]));
        store(e.phi_rate[k], v, Lanes3{});
      }
    keepStart<6>(e, start);
  }

  template <int kCount>
  static LIVE_STIFFNESS_INLINE void keepStart(ElementState& e, const ElementSensitivities& start) {
    for (int k = 0; k < kCount; ++k)
      for (int i = 0; i < 3; ++i) e.phi_start[k][i] = start.phi[k][i];
  }

  // Starts the element's sensitivities from the present end of the element before it.
  template <int kCount>
  static LIVE_STIFFNESS_INLINE void moveStart(ElementState& e, const ElementSensitivities& start) {
    for (int k = 0; k < kCount; ++k) {
      const Lanes3 step = splat({start.phi[k][0] - e.phi_start[k][0], start.phi[k][1] - e.phi_start[k][1],
                                 start.phi[k][2] - e.phi_start[k][2]});
      for (int v = 0; v < kVectors; ++v) store(e.phi[k], v, load(e.phi[k], v) + step);
    }
    keepStart<kCount>(e, start);
  }

  template <int kCount>
  static double propagateFirst(ElementState& e, bool cold, const ElementSensitivities& start, double goal, bool with_adjoint,
                               ElementSensitivities& end) {
    if (cold) reset(e, start);
    else moveStart<kCount>(e, start);
    linearise(e);
    Found found;
    // Base moment and tip force have different units, so each has its own share of the goal.
    double left = iterateAll<0>(e, start, kCount == 6 ? __builtin_sqrt(0.5) * goal : goal, with_adjoint, found);
    if (kCount == 6 && __builtin_isfinite(left)) {
      const double rest = __builtin_sqrt(largerOf(goal * goal - left * left, 0.0));
      const double also = iterateAll<3>(e, start, rest, with_adjoint, found);
      left = __builtin_sqrt(left * left + also * also);
    }
    if (!__builtin_isfinite(left)) {
      reset(e, start);
      end = start;
      return left;
    }
    if (!with_adjoint)
      for (int k = 0; k < kCount; ++k) {
        updateMoments(table(), e, start, k);
        move(table(), e, k, found.along);
        for (int i = 0; i < 3; ++i) found.phi_end[k][i] = e.phi[k][i][kStages];
      }
    sensitivityEnd<kCount>(e, start, found.along, found.phi_end, end);
    if (with_adjoint) addAdjointResidual<kCount>(found, start, end);
    return left;
  }

  // See propagate() in rod_element.h.
  static double propagate(ElementState& e, bool cold, const ElementSensitivities& start, SensitivitySet set, double goal,
                          bool with_adjoint, ElementSensitivities& end) {
    return set == SensitivitySet::kAll ? propagateFirst<6>(e, cold, start, goal, with_adjoint, end)
                                  : propagateFirst<3>(e, cold, start, goal, with_adjoint, end);
  }

  // Like that of the shape, which is zero for a straight rod under load.
  static LIVE_STIFFNESS_INLINE void estimateTruncation(const GaussLegendre& t, ElementState& e,
                                                       const ElementSensitivities& end) {
    Pack top[9], below[9];
    for (int k = 0; k < 9; ++k) {
      const double* dm = e.dm[k / 3][k % 3];
      top[k] = load(t.legendre[kStages - 1], 0) * load(dm, 0);
      below[k] = load(t.legendre[kStages - 2], 0) * load(dm, 0);
      for (int v = 1; v < kVectors; ++v) {
        top[k] += load(t.legendre[kStages - 1], v) * load(dm, v);
        below[k] += load(t.legendre[kStages - 2], v) * load(dm, v);
      }
    }
    double a[9], b[9], size = 1e-300;
    sums(top, a);
    sums(below, b);
    for (int k = 0; k < 9; ++k) size += end.phi[k / 3][k % 3] * end.phi[k / 3][k % 3];
    const double turn = e.length * largerOf(e.bend_xx, e.bend_yy);  // rotation by the unit moment
    e.sensitivity_truncation = turn * turn * largerOf(squaredNorm(a), kDecay * kDecay * squaredNorm(b)) / size;
  }
};

}  // namespace
}  // namespace live_stiffness
