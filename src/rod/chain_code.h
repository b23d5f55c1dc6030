#pragma once
// Elements and rigid links one after the other, from base to tip. See docs/derivation.md, section 2 and 5.

#include "rod/element_sensitivities_code.h"
#include "rod/element_shape_code.h"
#include "rod/joints_code.h"
#include "rod/section_state_code.h"

namespace live_stiffness {
namespace {

// Derivatives across a rigid part, base axes; n: the force that acts on its lever.
inline void carrySensitivities(const double (&along)[3], const double (&n)[3], ElementTransfer& at) {
  for (int k = 0; k < kColumns; ++k) {
    double moved[3], moment[3];
    crossInto(at.phi[k], along[0], along[1], along[2], moved);
    crossInto(n, moved[0], moved[1], moved[2], moment);
    for (int i = 0; i < 3; ++i) at.p[k][i] += moved[i], at.m[k][i] += moment[i];
  }
  at.m[3][1] -= along[2], at.m[3][2] += along[1];
  at.m[4][2] -= along[0], at.m[4][0] += along[2];
  at.m[5][0] -= along[1], at.m[5][1] += along[0];
}

// Moments relative to a section that carries the moment m, from those in base axes.
inline void turnMoments(const double (&m)[3], ElementTransfer& at) {
  for (int k = 0; k < kColumns; ++k) {
    double turned[3];
    crossInto(at.phi[k], m[0], m[1], m[2], turned);
    for (int i = 0; i < 3; ++i) at.m[k][i] -= turned[i];
  }
}

template <int kStages>
struct ChainKernel {
  using S = Shape<kStages>;
  using C = Sensitivities<kStages>;

  // One fixed-point iteration of every element from its own start; then the gaps at the joints.
  static void iterate(const ChainState& chain, IterationResult& result) {
    const bool has_offset = hasOffset(chain);
    SectionState at(chain.base_force, kZero);
    double change = 0.0, turn = 0.0, moment = 0.0;
    bool is_admissible = true, first = true;
    walk(
        chain, [&](const Vector3d& piece, const Vector3d& weight) { at.cross(piece, weight); },
        [&](ElementState& e, bool last) {
          if (!first) {
            turnBetween(e.R_start, *at.R, e.gap_turn);
            const double(&r)[3] = e.gap_turn;
            double turned[3];
            crossInto(r, e.m_start[0], e.m_start[1], e.m_start[2], turned);
            for (int i = 0; i < 3; ++i) e.gap_moment[i] = (*at.m)[i] - e.m_start[i] - turned[i];
            turn = largerOf(squaredNorm(r), turn);
            moment = largerOf(squaredNorm(e.gap_moment), moment);
          }
          first = false;
          copy(*at.n, e.n_start);
          S::iterate(e);
          if (!last || has_offset) S::endRotation(e);
          at.leave(e);
          change += e.change;
          is_admissible = is_admissible && S::isAdmissible(e);
        });
    if (has_offset) at.cross(chain.tip_offset, kZero);
    for (int i = 0; i < 3; ++i) result.lacking[i] = chain.tip_moment[i] - (*at.m)[i];
    result.change = change;
    result.turn = __builtin_sqrt(turn);
    result.moment = __builtin_sqrt(largerOf(squaredNorm(result.lacking), moment));
    result.is_admissible = is_admissible && __builtin_isfinite(turn + result.moment);
  }

  // Newton's step, with the nodes.
  static double correct(const ChainState& chain, const IterationResult& result, double most) {
    const int count = countElements(chain);
    const double largest = Joints::correct(chain.elements, count, result.lacking, most);
    for (ElementState* e = chain.elements; e != chain.elements + count; ++e) {
      const double change[kColumns] = {e->step_moment[0], e->step_moment[1], e->step_moment[2], 0.0, 0.0, 0.0,
                                       e->step_turn[0],   e->step_turn[1],   e->step_turn[2]};
      S::follow(*e, change);
      if (e != chain.elements) {
        turnBy(e->step_turn, e->R_start);
        turnVector(e->step_turn, e->m_start);
      }
      for (int i = 0; i < 3; ++i) e->m_start[i] += e->step_moment[i];
    }
    return largest;
  }

  // Walks from base to tip; every element starts where the one before ends.
  static void march(const ChainState& chain, MarchMode mode, MarchResult& result) {
    SectionState at(chain.base_force, chain.base_moment);
    double change = 0.0, gap = 0.0;
    bool is_admissible = true;
    walk(
        chain, [&](const Vector3d& piece, const Vector3d& weight) { at.cross(piece, weight); },
        [&](ElementState& e, bool) {
          at.enter(e, mode != MarchMode::kClose);
          if (mode == MarchMode::kClose && &e != chain.elements) {
            const double moment[3] = {(*at.m)[0] - e.m_start[0], (*at.m)[1] - e.m_start[1], (*at.m)[2] - e.m_start[2]};
            gap = largerOf(squaredNorm(moment), gap);
          }
          switch (mode) {
            case MarchMode::kIterate: S::iterate(e); [[fallthrough]];
            case MarchMode::kShape:
            case MarchMode::kClose: S::evaluate(e); break;
            case MarchMode::kUnloaded: S::placeUnloaded(e); break;
            case MarchMode::kCold:
              S::resetGuess(e);
              is_admissible = S::integrate(e) && is_admissible;
          }
          at.leave(e);
          change = largerOf(e.change, change);
          is_admissible = is_admissible && S::isAdmissible(e);
        });
    if (hasOffset(chain)) at.cross(chain.tip_offset, kZero);
    copy(*at.R, result.R_tip);
    copy(at.p, result.p_tip);
    double finite = 0.0;
    for (int i = 0; i < 3; ++i) finite += result.residual[i] = (*at.m)[i] - chain.tip_moment[i];
    result.gap = __builtin_sqrt(largerOf(squaredNorm(result.residual), gap));
    result.change = change;
    result.is_admissible = is_admissible && __builtin_isfinite(finite);
  }

  // Shape of every element from its own start, as it is.
  static void evaluate(const ChainState& chain) {
    const int count = countElements(chain);
    for (ElementState* e = chain.elements; e != chain.elements + count; ++e) S::evaluate(*e);
  }

  // Sensitivities of every element, with those of the rigid parts that follow it, and the factors of the joints. See
  // ElementKernel.
  static LinearisationResult linearise(const ChainState& chain, const Linearisation& how) {
    LinearisationResult result{0.0, 0};
    SectionState at(chain.base_force, kZero);
    ElementState* before = nullptr;
    const auto cross = [&](const Vector3d& piece, const Vector3d& weight) {
      const SectionState::Rigid rigid = at.cross(piece, weight);
      if (before) carrySensitivities(rigid.along, rigid.force, before->transfer);
    };
    walk(chain, cross, [&](ElementState& e, bool) {
      if (before) turnMoments(*at.m, before->transfer);
      const double left = C::propagate(e, how.cold, how.with_force, before != nullptr, how.goal, how.with_adjoint);
      result.left = largerOf(left, result.left);
      before = &e;
      at.leave(e);
    });
    if (hasOffset(chain)) cross(chain.tip_offset, kZero);
    if (__builtin_isfinite(result.left))
      result.unstable = Joints::factorise(chain.elements, countElements(chain), how.clamped);
    return result;
  }
};

}  // namespace
}  // namespace live_stiffness
