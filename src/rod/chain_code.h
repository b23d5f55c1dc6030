#pragma once
// Elements and rigid links one after the other, from base to tip. See docs/derivation.md, section 2 and 5.

#include "rod/element_sensitivities_code.h"
#include "rod/element_shape_code.h"
#include "rod/joints_code.h"
#include "rod/section_state_code.h"

namespace live_stiffness {
namespace {

// Derivatives across a rigid part, base axes; n: the force that acts on its lever.
inline void carrySensitivities(const Vector& along, const Vector& n, ElementTransfer& at) {
  for (int k = 0; k < kColumns; ++k) {
    const Vector moved = cross(get(at.phi[k]), along);
    put(get(at.p[k]) + moved, at.p[k]);
    put(get(at.m[k]) + cross(n, moved), at.m[k]);
  }
  const Vector by_unit_force[3] = {{0.0, -along.z, along.y}, {along.z, 0.0, -along.x}, {-along.y, along.x, 0.0}};
  for (int i = 0; i < 3; ++i) put(get(at.m[kOfForce + i]) + by_unit_force[i], at.m[kOfForce + i]);
}

// Moments relative to a section that carries the moment m, from those in base axes.
inline void turnMoments(const Vector& m, ElementTransfer& at) {
  for (int k = 0; k < kColumns; ++k) put(get(at.m[k]) - cross(get(at.phi[k]), m), at.m[k]);
}

template <int kStages>
struct ChainKernel {
  using S = Shape<kStages>;
  using C = Sensitivities<kStages>;

  // One fixed-point iteration of every element from its own start; then the gaps at the joints.
  static void iterate(const ChainState& chain, IterationResult& result) {
    const bool has_offset = hasOffset(chain);
    SectionState at{};
    at.n = get(chain.base_force);
    double change = 0.0, turn = 0.0, moment = 0.0;
    bool is_admissible = true, first = true;
    walk(
        chain, [&](const Vector& piece, const Vector& weight) { at.pass(piece, weight); },
        [&](ElementState& e, bool last) {
          if (!first) {
            const Vector gap = turnBetween(get(e.R_start), at.R), m = get(e.m_start), gap_moment = at.m - m - cross(gap, m);
            put(gap, e.gap_turn);
            put(gap_moment, e.gap_moment);
            turn = largerOf(dot(gap, gap), turn);
            moment = largerOf(dot(gap_moment, gap_moment), moment);
          }
          first = false;
          put(at.n, e.n_start);
          S::iterate(e);
          if (!last || has_offset) S::endRotation(e);
          at.leave(e);
          change += e.change;
          is_admissible = is_admissible && S::isAdmissible(e);
        });
    if (has_offset) at.pass(get(chain.tip_offset), {});
    put(get(chain.tip_moment) - at.m, result.lacking);
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
      Vector m = get(e->m_start);
      if (e != chain.elements) {
        const Matrix turn = cayley(get(e->step_turn));
        put(turn * get(e->R_start), e->R_start);
        m = turn * m;
      }
      put(m + get(e->step_moment), e->m_start);
    }
    return largest;
  }

  // Walks from base to tip; every element starts where the one before ends.
  static void march(const ChainState& chain, MarchMode mode, MarchResult& result) {
    SectionState at{};
    at.n = get(chain.base_force);
    at.m = get(chain.base_moment);
    double change = 0.0, gap = 0.0;
    bool is_admissible = true;
    walk(
        chain, [&](const Vector& piece, const Vector& weight) { at.pass(piece, weight); },
        [&](ElementState& e, bool) {
          at.enter(e, mode != MarchMode::kClose);
          if (mode == MarchMode::kClose && &e != chain.elements) {
            const Vector moment = at.m - get(e.m_start);
            gap = largerOf(dot(moment, moment), gap);
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
    if (hasOffset(chain)) at.pass(get(chain.tip_offset), {});
    put(at.R, result.R_tip);
    put(at.p, result.p_tip);
    const Vector residual = at.m - get(chain.tip_moment);
    put(residual, result.residual);
    result.gap = __builtin_sqrt(largerOf(dot(residual, residual), gap));
    result.change = change;
    result.is_admissible = is_admissible && __builtin_isfinite(residual.x + residual.y + residual.z);
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
    SectionState at{};
    at.n = get(chain.base_force);
    ElementState* before = nullptr;
    const auto pass = [&](const Vector& piece, const Vector& weight) {
      const SectionState::Rigid rigid = at.pass(piece, weight);
      if (before) carrySensitivities(rigid.along, rigid.force, before->transfer);
    };
    walk(chain, pass, [&](ElementState& e, bool) {
      if (before) turnMoments(at.m, before->transfer);
      const double left = C::propagate(e, how.cold, how.with_force, before != nullptr, how.goal, how.with_adjoint);
      result.left = largerOf(left, result.left);
      before = &e;
      at.leave(e);
    });
    if (hasOffset(chain)) pass(get(chain.tip_offset), {});
    if (__builtin_isfinite(result.left))
      result.unstable = Joints::factorise(chain.elements, countElements(chain), how.clamped);
    return result;
  }
};

}  // namespace
}  // namespace live_stiffness
