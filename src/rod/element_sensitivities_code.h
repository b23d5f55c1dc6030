#pragma once
// Linearised rod of one element: its sensitivities, see kColumns. Docs/derivation.md, section 5.

#include <type_traits>

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

  // m' = M phi - P^T dn, dn the unit forces.
  template <int kGroup>
  static LIVE_STIFFNESS_INLINE void updateMoments(const GaussLegendre& t, ElementState& e, int i) {
    const int k = kGroup + i;
    StageRow rate[3];
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) {
      Lanes3 m_rate = loadMatrix(e.m_of_phi, v) * load(e.phi[k], v);
      if (kGroup == kOfForce) {
        const StageRow* row = e.p_of_phi + 3 * i;
        m_rate = m_rate - Lanes3{load(row[0], v), load(row[1], v), load(row[2], v)};
      }
      store(rate, v, m_rate);
    }
    const Rows moment = integral(t, rate);
    const Vector unit{double(i == 0), double(i == 1), double(i == 2)};
    const Vector start = kGroup == kOfMoment ? unit : kGroup == kOfRotation ? cross(unit, get(e.m_start)) : Vector{};
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) store(e.dm[k], v, splat(start) + moment.at[v]);
  }

  // Displacement of the end in column k.
  static LIVE_STIFFNESS_INLINE void move(const GaussLegendre& t, const ElementState& e, int k, Pack (&along)[3 * kColumns]) {
    Lanes3 p{};
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) p = p + load(t.b, v) * (loadMatrix(e.p_of_phi, v) * load(e.phi[k], v));
    along[3 * k] = p.x, along[3 * k + 1] = p.y, along[3 * k + 2] = p.z;
  }

  // What an iteration computes from the sensitivities with which it starts.
  struct Found {
    Pack along[3 * kColumns];
    StageRow moment[kColumns][3];   // change of the moment relative to the turning section, mu of section 4; phi' = B mu
    StageRow missing[kColumns][3];  // weight times (phi' from the moments, minus phi' of which phi is the integral)
  };

  // Moments, then phi' = B (dm - phi x m), of a group. In this order the change of phi shows every error that is left;
  // its relative size is returned.
  template <int kGroup>
  static double iterate(ElementState& e, Found& found) {
    const GaussLegendre& t = table();
    Pack change{}, size{};
    for (int i = 0; i < 3; ++i) {
      const int k = kGroup + i;
      updateMoments<kGroup>(t, e, i);
      move(t, e, k, found.along);
      for (int j = 0; j < 3; ++j) e.transfer.phi[k][j] = e.phi[k][j][kStages];
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) {
        const Lanes3 moment = load(e.dm[k], v) + cross(load(e.m, v), load(e.phi[k], v));
        const Lanes3 rate = loadSymmetric(e.bend, v) * moment;
        store(found.moment[k], v, moment);
        store(found.missing[k], v, load(t.b, v) * (rate - load(e.phi_rate[k], v)));
        store(e.phi_rate[k], v, rate);
      }
      const Rows turn = integral(t, e.phi_rate[k]);
      const Vector start = kGroup == kOfRotation ? Vector{double(i == 0), double(i == 1), double(i == 2)} : Vector{};
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) {
        const Lanes3 next = splat(start) + turn.at[v], step = next - load(e.phi[k], v);
        change += dot(step, step);
        size += dot(next, next);
        store(e.phi[k], v, next);
      }
    }
    return __builtin_sqrt(sum(change) / (sum(size) + 1e-300));
  }

  template <int kGroup>
  static LIVE_STIFFNESS_INLINE void reset(ElementState& e) {
    for (int k = kGroup; k < kGroup + 3; ++k)
      for (int i = 0; i < 3; ++i)
        for (int v = 0; v < kVectors; ++v) {
          store(e.phi[k][i], v, splat(kGroup == kOfRotation && k - kGroup == i ? 1.0 : 0.0));
          store(e.phi_rate[k][i], v, Pack{});
        }
  }

  static void resetAll(ElementState& e) {
    reset<kOfMoment>(e);
    reset<kOfForce>(e);
    reset<kOfRotation>(e);
  }

  // See ElementKernel. Only columns that are asked for are set. All are iterated equally often: columns of an equilibrium are
  // differences of these, in which errors of the same kind cancel.
  static double propagate(ElementState& e, bool cold, bool with_force, bool with_rotation, double goal, bool with_adjoint) {
    constexpr int kMaxIterations = 60;
    const auto forEachGroup = [&](auto&& visit) {
      visit(std::integral_constant<int, kOfMoment>());
      if (with_force) visit(std::integral_constant<int, kOfForce>());
      if (with_rotation) visit(std::integral_constant<int, kOfRotation>());
    };
    linearise(e);
    if (cold) resetAll(e);
    Found found;
    double last_change = __builtin_inf(), left = __builtin_inf();
    for (int i = 0; i < kMaxIterations; ++i) {
      double change = 0.0;
      forEachGroup([&](auto group) {
        const double own = iterate<group.value>(e, found);
        change = own <= change ? change : own;  // NaN stays
      });
      if (!__builtin_isfinite(change)) break;
      // The error after an iteration is about its change times the convergence rate.
      const double rate = i > 0 && change < 0.2 * last_change ? change / last_change : 0.2;
      left = with_adjoint ? change : change * rate;
      if (left <= goal || (change <= 1e-13 && change >= last_change)) break;
      last_change = change;
      left = __builtin_inf();
    }
    if (!__builtin_isfinite(left)) {
      resetAll(e);
      return left;
    }
    forEachGroup([&](auto group) { finish<group.value>(e, with_adjoint, found); });
    estimateTruncation(table(), e);
    if (with_adjoint && with_rotation) addAdjointResidual<9>(e, found);
    else if (with_adjoint) addAdjointResidual<6>(e, found);
    return left;
  }

  // The end, as it was when the last iteration started if its adjoint-weighted residual is wanted, else after it.
  template <int kGroup>
  static LIVE_STIFFNESS_INLINE void finish(ElementState& e, bool with_adjoint, Found& found) {
    static constexpr int kSymmetric[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    for (int i = 0; i < 3 && !with_adjoint; ++i) {
      updateMoments<kGroup>(table(), e, i);
      move(table(), e, kGroup + i, found.along);
      for (int j = 0; j < 3; ++j) e.transfer.phi[kGroup + i][j] = e.phi[kGroup + i][j][kStages];
    }
    Pack along[9];
    for (int i = 0; i < 9; ++i) along[i] = found.along[3 * kGroup + i];
    sums(along, &e.transfer.p[kGroup][0]);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) {
        if (kGroup == kOfForce) e.transfer.p[kGroup + k][i] += e.stretch[kSymmetric[i][k]];
        e.transfer.m[kGroup + k][i] = e.dm[kGroup + k][i][kStages];
      }
  }

  // For the sensitivities with which the last iteration started.
  template <int kCount>
  static LIVE_STIFFNESS_INLINE void addAdjointResidual(ElementState& e, const Found& found) {
    for (int i = 0; i < kCount; ++i) {
      Pack work[kCount];
      for (int j = 0; j < kCount; ++j) {
        work[j] = dot(load(found.moment[i], 0), load(found.missing[j], 0));
        for (int v = 1; v < kVectors; ++v) work[j] += dot(load(found.moment[i], v), load(found.missing[j], v));
      }
      double total[kCount];
      sums(work, total);
      for (int j = 0; j < kCount; ++j) e.transfer.adjoint_residual[i][j] = total[j];
    }
  }

  // Like that of the shape, which is zero for a straight rod under load.
  static LIVE_STIFFNESS_INLINE void estimateTruncation(const GaussLegendre& t, ElementState& e) {
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
    for (int k = 0; k < 9; ++k) size += e.transfer.phi[k / 3][k % 3] * e.transfer.phi[k / 3][k % 3];
    const double turn = e.length * largerOf(e.bend_xx, e.bend_yy);  // rotation by the unit moment
    e.sensitivity_truncation = turn * turn * largerOf(squaredNorm(a), kDecay * kDecay * squaredNorm(b)) / size;
  }
};

}  // namespace
}  // namespace live_stiffness
