#include "rod/element_kernel.h"

#include <algorithm>
#include <iterator>

#include "rod/element_kernel_tables.h"

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

const ElementKernel& elementKernel(int stages, Simd simd) {
  const int index = static_cast<int>(std::find(std::begin(kStageCounts), std::end(kStageCounts), stages) - kStageCounts);
#ifdef LIVE_STIFFNESS_HAS_AVX2
  if (simd == Simd::kBest && hasAvx2()) return kAvx2Kernels[index];
#endif
  (void)simd;
  return kBaselineKernels[index];
}

const char* bestSimdName() { return hasAvx2() ? "AVX2" : "baseline"; }

}  // namespace live_stiffness
