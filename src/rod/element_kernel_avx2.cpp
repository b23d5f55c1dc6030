// Four lanes. Compiled for AVX2 and FMA; called only where the processor has both.
#define LIVE_STIFFNESS_PACK 4
#include "rod/element_kernel_code.h"

namespace live_stiffness {

const ElementKernel kAvx2Kernels[std::size(kStageCounts)] = LIVE_STIFFNESS_KERNELS;

}  // namespace live_stiffness
