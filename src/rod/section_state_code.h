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

constexpr double kIdentity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, kZero[3] = {};

// The present position of a loop along a chain: pose of the section, and loads there (base axes).
class SectionState {
 public:
  LIVE_STIFFNESS_INLINE SectionState(const double (&force)[3], const double (&moment)[3]) : n(&force), m(&moment) {}

  LIVE_STIFFNESS_INLINE void enter(ElementState& e, bool with_moment) const {
    copy(*R, e.R_start);
    copy(p, e.p_start);
    copy(*n, e.n_start);
    if (with_moment) copy(*m, e.m_start);
  }
  LIVE_STIFFNESS_INLINE void leave(const ElementState& e) {
    R = &e.R_end, n = &e.n_end, m = &e.m_end;
    for (int i = 0; i < 3; ++i) p[i] = e.p_start[i] + e.offset_end[i];
  }
  // Across a rigid part (axes of the section); weight: its own, at its middle, N. Returns the part in base axes and the
  // force that acts on its lever.
  struct Rigid {
    double along[3], force[3];
  };
  LIVE_STIFFNESS_INLINE Rigid cross(const double (&piece)[3], const double (&weight)[3]) {
    Rigid rigid;
    double moment[3];
    rotate(*R, piece, rigid.along);
    for (int i = 0; i < 3; ++i) rigid.force[i] = (*n)[i] - 0.5 * weight[i];  // the weight has half the lever
    crossInto(rigid.along, rigid.force[0], rigid.force[1], rigid.force[2], moment);
    for (int i = 0; i < 3; ++i)
      p[i] += rigid.along[i], own_n_[i] = (*n)[i] - weight[i], own_m_[i] = (*m)[i] - moment[i];
    n = &own_n_, m = &own_m_;
    return rigid;
  }

  const double (*R)[9] = &kIdentity;
  double p[3] = {};
  const double (*n)[3];
  const double (*m)[3];

 private:
  double own_n_[3], own_m_[3];
};

typedef double Vector3d[3];

// Calls on_link(link's length, weight) and on_element(element, it is the last body), base to tip.
template <class OnLink, class OnElement>
LIVE_STIFFNESS_INLINE void walk(const ChainState& chain, OnLink on_link, OnElement on_element) {
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
