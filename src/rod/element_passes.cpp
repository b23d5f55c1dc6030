#include "rod/element_passes.h"

#include "rod/element_passes_tables.h"

namespace live_stiffness {
namespace {

bool hasAvx2() {
#ifdef LIVE_STIFFNESS_HAS_AVX2
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
#else
  return false;
#endif
}

}  // namespace

const ElementPasses& elementPasses(int stages, Simd simd) {
#ifdef LIVE_STIFFNESS_HAS_AVX2
  if (simd == Simd::kBest && hasAvx2()) return kAvx2Passes[stages - kMinStages];
#endif
  (void)simd;
  return kBaselinePasses[stages - kMinStages];
}

const char* bestSimdName() { return hasAvx2() ? "AVX2" : "baseline"; }

}  // namespace live_stiffness
