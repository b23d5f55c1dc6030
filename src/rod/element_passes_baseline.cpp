// Two lanes: SSE2 on x86-64, NEON on ARM.
#define LIVE_STIFFNESS_LANES 2
#include "rod/element_passes_code.h"

namespace live_stiffness {

const ElementPasses kBaselinePasses[kMaxStages - kMinStages + 1] = LIVE_STIFFNESS_PASSES;

}  // namespace live_stiffness
