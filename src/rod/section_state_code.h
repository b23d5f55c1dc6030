#pragma once
// Loops along a chain, from base to tip, and their present position.

#include "rod/chain_state.h"
#include "rod/packed_compliance_code.h"

namespace live_stiffness {
namespace {

LIVE_STIFFNESS_INLINE void copy(const PackedRow& from, PackedRow& to) {
  for (int i = 0; i < kPackedRow / kPackSize; ++i) store(to, i, load(from, i));
}
LIVE_STIFFNESS_INLINE void add(const PackedRow& more, PackedRow& to) {
  for (int i = 0; i < kPackedRow / kPackSize; ++i) store(to, i, load(to, i) + load(more, i));
}

// The present position of a loop along a chain: pose of the section, and loads there (base axes).
struct SectionState {
  Matrix R{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  Vector p{}, n, m;

  LIVE_STIFFNESS_INLINE void enter(ElementState& e, bool with_moment) const {
    put(R, e.R_start);
    put(p, e.p_start);
    put(n, e.n_start);
    if (with_moment) put(m, e.m_start);
  }
  LIVE_STIFFNESS_INLINE void leave(const ElementState& e) {
    R = get(e.R_end), n = get(e.n_end), m = get(e.m_end);
    p = get(e.p_start) + get(e.offset_end);
  }
  // Across a rigid part (axes of the section); weight: its own, at its middle, N. Returns the part in base axes and the
  // force that acts on its lever.
  struct Rigid {
    Vector along, force;
  };
  LIVE_STIFFNESS_INLINE Rigid pass(const Vector& piece, const Vector& weight) {
    const Rigid rigid{R * piece, n - 0.5 * weight};  // the weight has half the lever
    p = p + rigid.along;
    n = n - weight;
    m = m - cross(rigid.along, rigid.force);
    return rigid;
  }
};

// Calls on_link(link's length, weight) and on_element(element, it is the last body), base to tip.
template <class OnLink, class OnElement>
LIVE_STIFFNESS_INLINE void walk(const ChainState& chain, OnLink on_link, OnElement on_element) {
  ElementState* e = chain.elements;
  for (int i = 0; i < chain.part_count; ++i) {
    const ChainPart& part = chain.parts[i];
    if (part.segment < 0) {
      on_link(Vector{0.0, 0.0, part.length}, part.mass * get(chain.gravity));
    } else {
      const bool last_part = i + 1 == chain.part_count;
      for (int k = chain.element_count[part.segment]; k > 0; --k, ++e) on_element(*e, last_part && k == 1);
    }
  }
}
LIVE_STIFFNESS_INLINE bool hasOffset(const ChainState& chain) {
  return chain.tip_offset[0] != 0.0 || chain.tip_offset[1] != 0.0 || chain.tip_offset[2] != 0.0;
}
LIVE_STIFFNESS_INLINE int countElements(const ChainState& chain) {
  int count = 0;
  for (int i = 0; i < chain.part_count; ++i)
    if (chain.parts[i].segment >= 0) count += chain.element_count[chain.parts[i].segment];
  return count;
}

}  // namespace
}  // namespace live_stiffness
