#pragma once
// All that is done to elements and chains, for one instruction set.

#include "rod/chain_code.h"
#include "rod/element_kernel_tables.h"
#include "rod/tangent_code.h"

namespace live_stiffness {
namespace {

template <int kStages>
constexpr ElementKernel kernelOf() {
  using S = Shape<kStages>;
  using C = Sensitivities<kStages>;
  using M = MaterialChoice<kStages>;
  using All = ChainKernel<kStages>;
  return {kStages,   S::resetGuess, S::predict,  S::iterate, S::integrate,    S::placeUnloaded,
          S::follow, C::propagate,  M::material, All::addCompliance, M::stations, All::sweep,      All::followAll,
          All::columns, tangent, All::accumulate, All::placeChain};
}

}  // namespace
}  // namespace live_stiffness

#define LIVE_STIFFNESS_KERNELS {kernelOf<3>(), kernelOf<5>(), kernelOf<7>()}
