#pragma once
// One table for each of kStageCounts. Each instruction set has a translation unit of its own.

#include <iterator>

#include "rod/element_kernel.h"

namespace live_stiffness {

extern const ElementKernel kBaselineKernels[std::size(kStageCounts)];
extern const ElementKernel kAvx2Kernels[std::size(kStageCounts)];  // where the compiler can make it

}  // namespace live_stiffness
