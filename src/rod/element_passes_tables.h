#pragma once
// One table for each number of stages, from kMinStages on. Each instruction set has a translation unit of its own.

#include "rod/element_passes.h"

namespace live_stiffness {

extern const ElementPasses kBaselinePasses[kMaxStages - kMinStages + 1];
extern const ElementPasses kAvx2Passes[kMaxStages - kMinStages + 1];  // where the compiler can make it

}  // namespace live_stiffness
