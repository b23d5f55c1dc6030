// Four lanes. Compiled for AVX2 and FMA; called only where the processor has both.
#define LIVE_STIFFNESS_LANES 4
#include "rod/element_passes_code.h"

namespace live_stiffness {

const ElementPasses kAvx2Passes[kMaxStages - kMinStages + 1] = LIVE_STIFFNESS_PASSES;

}  // namespace live_stiffness
