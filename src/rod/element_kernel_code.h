#pragma once
// All that is done to elements and chains, for one instruction set.

#include "rod/chain_code.h"
#include "rod/chain_compliance_code.h"
#include "rod/element_kernel_tables.h"

namespace live_stiffness {
namespace {

template <int kStages>
constexpr ElementKernel kernelOf() {
  using S = Shape<kStages>;
  using C = Sensitivities<kStages>;
  using M = MaterialChoice<kStages>;
  using Chain = ChainKernel<kStages>;
  using Compliance = ChainCompliance<kStages>;
  return {kStages, S::resetGuess, S::predict, S::integrate, S::placeUnloaded, S::follow, C::propagate, M::material,
          Compliance::addCompliance, M::stations, Chain::iterate, Chain::evaluate, Chain::correct, Chain::march,
          Chain::linearise, Joints::tangent, Compliance::accumulate, Compliance::placeChain};
}

}  // namespace
}  // namespace live_stiffness

#define LIVE_STIFFNESS_KERNELS {kernelOf<5>(), kernelOf<7>()}
