// Two lanes: SSE2 on x86-64, NEON on ARM.
#define LIVE_STIFFNESS_PACK 2
#include "rod/element_kernel_code.h"

namespace live_stiffness {

const ElementKernel kBaselineKernels[std::size(kStageCounts)] = LIVE_STIFFNESS_KERNELS;

}  // namespace live_stiffness
