#pragma once
// Material compliance along a chain: docs/derivation.md, section 7.

#include "rod/element_shape_code.h"
#include "rod/material_choice_code.h"
#include "rod/section_state_code.h"

namespace live_stiffness {
namespace {

template <int kStages>
struct ChainCompliance {
  using S = Shape<kStages>;
  using M = MaterialChoice<kStages>;

  static LIVE_STIFFNESS_INLINE void addCompliance(ElementState& e) {
    copy(e.start_compliance, e.end_compliance);
    if (!e.is_arc) add(e.compliance, e.end_compliance);
    if (!isZero(e.end_compliance)) shiftOne(get(e.offset_end), e.end_compliance);
    if (e.is_arc) add(e.compliance, e.end_compliance);  // about its end as it is
  }

  // Material compliance of everything up to here, about this section.
  class Passed {
   public:
    LIVE_STIFFNESS_INLINE void pass(ElementState& e) {
      if (before_) before_ = moved(get(e.p_start), e.start_compliance);
      else copy(kNoCompliance, e.start_compliance);
      addCompliance(e);
      before_ = &e.end_compliance;
      about_ = get(e.p_start) + get(e.offset_end);
    }
    // About p.
    LIVE_STIFFNESS_INLINE void finish(const Vector& p, PackedRow& out) const {
      if (before_) moved(p, out);
      else copy(kNoCompliance, out);
    }

   private:
    static constexpr PackedRow kNoCompliance = {};
    LIVE_STIFFNESS_INLINE const PackedRow* moved(const Vector& p, PackedRow& to) const {
      const Vector d = p - about_;
      copy(*before_, to);
      if (d.x != 0.0 || d.y != 0.0 || d.z != 0.0) shiftOne(d, to);
      return &to;
    }

    const PackedRow* before_ = nullptr;
    Vector about_{};
  };

  static void accumulate(const ChainState& chain, double accuracy, const double (&p_tip)[3], PackedRow& compliance) {
    Passed passed;
    walk(
        chain, [](const Vector&, const Vector&) {},
        [&](ElementState& e, bool) {
          M::material(e, false, accuracy);
          passed.pass(e);
        });
    passed.finish(get(p_tip), compliance);
  }

  static int placeChain(const ChainState& chain, double accuracy, MarchResult& result, PackedRow& compliance) {
    SectionState at{};
    Passed passed;
    int beyond = 0;
    walk(
        chain, [&](const Vector& piece, const Vector&) { at.pass(piece, {}); },
        [&](ElementState& e, bool) {
          at.enter(e, true);
          const double bending = e.length * e.length * squaredNorm(e.rest_curvature);
          beyond += !(bending <= kMaxUnloadedBending * kMaxUnloadedBending);
          if (bendsAsArc(e)) {
            placeArc(e);
          } else {
            S::placeUnloaded(e);
            M::material(e, true, accuracy);
          }
          passed.pass(e);
          at.leave(e);
        });
    if (hasOffset(chain)) at.pass(get(chain.tip_offset), {});
    put(at.R, result.R_tip);
    put(at.p, result.p_tip);
    passed.finish(at.p, compliance);
    return beyond;
  }
};

}  // namespace
}  // namespace live_stiffness
