#pragma once
// All that is done to elements and chains, for one instruction set.

#include "rod/chain_code.h"
#include "rod/element_passes_tables.h"
#include "rod/tangent_code.h"

namespace live_stiffness {
namespace {

template <int kStages>
constexpr ElementPasses passesOf() {
  using S = Shape<kStages>;
  using C = Columns<kStages>;
  using M = MaterialChoice<kStages>;
  using All = ChainPasses<kStages>;
  return {kStages,   S::resetGuess, S::predict,  S::pass, S::integrate,    S::placeUnloaded,
          S::follow, C::propagate,  M::material, All::addCompliance, M::stations, All::sweep,      All::followAll,
          All::columns, tangent, All::accumulate, All::placeChain};
}

}  // namespace
}  // namespace live_stiffness

#define LIVE_STIFFNESS_PASSES {passesOf<2>(), passesOf<3>(), passesOf<4>(), passesOf<5>(), passesOf<6>(), passesOf<7>()}
