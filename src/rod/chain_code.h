#pragma once
// Elements and rigid links one after the other, from base to tip. See docs/derivation.md, section 2 and 5.

#include "rod/element_sensitivities_code.h"
#include "rod/element_shape_code.h"
#include "rod/material_choice_code.h"
#include "rod/section_state_code.h"

namespace live_stiffness {
namespace {

// Derivatives across a rigid part, base axes; n: the force that acts on its lever.
LIVE_STIFFNESS_INLINE void carrySensitivities(const double (&along)[3], const double (&n)[3], ElementSensitivities& at) {
  for (int k = 0; k < 6; ++k) {
    double moved[3], moment[3];
    crossInto(at.phi[k], along[0], along[1], along[2], moved);
    crossInto(n, moved[0], moved[1], moved[2], moment);
    for (int i = 0; i < 3; ++i) at.p[k][i] += moved[i], at.m[k][i] += moment[i];
  }
  at.m[3][1] -= along[2], at.m[3][2] += along[1];
  at.m[4][2] -= along[0], at.m[4][0] += along[2];
  at.m[5][0] -= along[1], at.m[5][1] += along[0];
}

template <int kStages>
struct ChainKernel {
  using S = Shape<kStages>;
  using C = Sensitivities<kStages>;
  using M = MaterialChoice<kStages>;

  // Calls on_link(link's length, weight) and on_element(element, it is the last body), base to tip.
  template <class OnLink, class OnElement>
  static LIVE_STIFFNESS_INLINE void walk(const ChainState& chain, OnLink on_link, OnElement on_element) {
    ElementState* e = chain.elements;
    for (int i = 0; i < chain.part_count; ++i) {
      const ChainPart& part = chain.parts[i];
      if (part.segment < 0) {
        const double* g = chain.gravity;
        on_link({0.0, 0.0, part.length}, {part.mass * g[0], part.mass * g[1], part.mass * g[2]});
      } else {
        const bool last_part = i + 1 == chain.part_count;
        for (int k = chain.element_count[part.segment]; k > 0; --k, ++e) on_element(*e, last_part && k == 1);
      }
    }
  }
  static LIVE_STIFFNESS_INLINE bool hasOffset(const ChainState& chain) {
    return chain.tip_offset[0] != 0.0 || chain.tip_offset[1] != 0.0 || chain.tip_offset[2] != 0.0;
  }
  static LIVE_STIFFNESS_INLINE int countElements(const ChainState& chain) {
    int count = 0;
    for (int i = 0; i < chain.part_count; ++i)
      if (chain.parts[i].segment >= 0) count += chain.element_count[chain.parts[i].segment];
    return count;
  }
  typedef double Vector[3];

  static void sweep(const ChainState& chain, SweepMode kind, SweepResult& result) {
    const bool has_offset = hasOffset(chain);
    SectionState at(chain.base_force, chain.base_moment);
    double change = 0.0;
    bool is_admissible = true;
    walk(
        chain, [&](const Vector& piece, const Vector& weight) { at.cross(piece, weight); },
        [&](ElementState& e, bool last) {
          at.enter(e);
          switch (kind) {
            case SweepMode::kFinish: S::iterate(e); [[fallthrough]];
            case SweepMode::kShape: S::evaluate(e); break;
            case SweepMode::kOnce:
              S::iterate(e);
              if (!last || has_offset) S::endRotation(e);
              break;
            case SweepMode::kUnloaded: S::placeUnloaded(e); break;
            case SweepMode::kCold:
              S::resetGuess(e);
              is_admissible = S::integrate(e) && is_admissible;
          }
          at.leave(e);
          change = largerOf(e.change, change);
          is_admissible = is_admissible && S::isAdmissible(e);
        });
    if (has_offset) at.cross(chain.tip_offset, kZero);
    if (kind != SweepMode::kOnce) {
      copy(*at.R, result.R_tip);
      copy(at.p, result.p_tip);
    }
    double finite = 0.0;
    for (int i = 0; i < 3; ++i) finite += result.residual[i] = (*at.m)[i] - chain.tip_moment[i];
    result.change = change;
    result.is_admissible = is_admissible && __builtin_isfinite(finite);
  }

  static void followAll(const ChainState& chain, const double (&base_moment_change)[3]) {
    walk(
        chain, [](const Vector&, const Vector&) {},
        [&](ElementState& e, bool) { S::follow(e, base_moment_change); });
  }

  static double columns(const ChainState& chain, bool cold, SensitivitySet set, double goal, bool with_adjoint,
                        ElementSensitivities& tip) {
    // At the base: the moment changes, and nothing moves.
    static constexpr ElementSensitivities kBase = {{}, {}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, {}};
    const bool has_offset = hasOffset(chain);
    ElementSensitivities room[2];
    const ElementSensitivities* start = &kBase;
    // The adjoint-weighted residual is a sum over elements; each adds its own part.
    const double part_goal = with_adjoint ? goal / countElements(chain) : goal;
    double left = 0.0;
    SectionState at(chain.base_force, kZero);
    const auto other = [&]() -> ElementSensitivities& { return start == &room[0] ? room[1] : room[0]; };
    const auto carry = [&](const Vector& piece, const Vector& weight, ElementSensitivities& end) {
      const SectionState::Rigid rigid = at.cross(piece, weight);
      end = *start;
      carrySensitivities(rigid.along, rigid.force, end);
      start = &end;
    };
    walk(
        chain, [&](const Vector& piece, const Vector& weight) { carry(piece, weight, other()); },
        [&](ElementState& e, bool last) {
          ElementSensitivities& end = last && !has_offset ? tip : other();
          const double own = C::propagate(e, cold, *start, set, part_goal, with_adjoint, end);
          left = with_adjoint ? left + own : largerOf(own, left);
          start = &end;
          at.leave(e);
        });
    if (has_offset) carry(chain.tip_offset, kZero, tip);
    if (start != &tip) tip = *start;
    return left;
  }

  static LIVE_STIFFNESS_INLINE void addCompliance(ElementState& e) {
    copy(e.start_compliance, e.end_compliance);
    if (!e.is_arc) add(e.compliance, e.end_compliance);
    if (!isZero(e.end_compliance)) shiftOne(e.offset_end, e.end_compliance);
    if (e.is_arc) add(e.compliance, e.end_compliance);  // about its end as it is
  }

  // Material compliance of everything up to here, about this section.
  class Passed {
   public:
    LIVE_STIFFNESS_INLINE void pass(ElementState& e) {
      if (before_) before_ = moved(e.p_start, e.start_compliance);
      else copy(kNoCompliance, e.start_compliance);
      addCompliance(e);
      before_ = &e.end_compliance;
      for (int i = 0; i < 3; ++i) about_[i] = e.p_start[i] + e.offset_end[i];
    }
    // About p.
    LIVE_STIFFNESS_INLINE void finish(const double (&p)[3], PackedRow& out) const {
      if (before_) moved(p, out);
      else copy(kNoCompliance, out);
    }

   private:
    static constexpr PackedRow kNoCompliance = {};
    LIVE_STIFFNESS_INLINE const PackedRow* moved(const double (&p)[3], PackedRow& to) const {
      const double d[3] = {p[0] - about_[0], p[1] - about_[1], p[2] - about_[2]};
      copy(*before_, to);
      if (d[0] != 0.0 || d[1] != 0.0 || d[2] != 0.0) shiftOne(d, to);
      return &to;
    }

    const PackedRow* before_ = nullptr;
    double about_[3] = {};
  };

  static double accumulate(const ChainState& chain, double accuracy, const double (&p_tip)[3], PackedRow& compliance) {
    Passed passed;
    double error = 0.0;
    walk(
        chain, [](const Vector&, const Vector&) {},
        [&](ElementState& e, bool) {
          M::material(e, false, accuracy);
          passed.pass(e);
          error += e.compliance_error;
        });
    passed.finish(p_tip, compliance);
    return error;
  }

  static double placeChain(const ChainState& chain, double accuracy, SweepResult& result, PackedRow& compliance) {
    SectionState at(kZero, kZero);
    Passed passed;
    double error = 0.0;
    walk(
        chain, [&](const Vector& piece, const Vector&) { at.cross(piece, kZero); },
        [&](ElementState& e, bool) {
          at.enter(e);
          const double bending = e.length * e.length * squaredNorm(e.rest_curvature);
          if (!(bending <= kMaxUnloadedBending * kMaxUnloadedBending)) error += 1.0;  // beyond the range of the series
          if (bendsAsArc(e)) {
            placeArc(e);
          } else {
            S::placeUnloaded(e);
            M::material(e, true, accuracy);
          }
          passed.pass(e);
          error += e.compliance_error;
          at.leave(e);
        });
    if (hasOffset(chain)) at.cross(chain.tip_offset, kZero);
    copy(*at.R, result.R_tip);
    copy(at.p, result.p_tip);
    passed.finish(at.p, compliance);
    return error;
  }
};

}  // namespace
}  // namespace live_stiffness
