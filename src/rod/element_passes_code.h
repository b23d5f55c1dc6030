#pragma once
// All that is done to an element, for one instruction set.

#include "rod/element_columns_code.h"
#include "rod/element_material_code.h"
#include "rod/element_passes_tables.h"
#include "rod/element_shape_code.h"

namespace live_stiffness {
namespace {

template <int kStages>
constexpr ElementPasses passesOf() {
  using S = Shape<kStages>;
  using C = Columns<kStages>;
  using M = MaterialChoice<kStages>;
  return {kStages,      S::template pass<false>, S::finish,   S::placeUnloaded, C::linearise,
          C::columnPass, S::follow,               C::columnEnd, M::material,      M::stations};
}

}  // namespace
}  // namespace live_stiffness

#define LIVE_STIFFNESS_PASSES {passesOf<2>(), passesOf<3>(), passesOf<4>(), passesOf<5>(), passesOf<6>(), passesOf<7>()}
