#pragma once
// Included first into every file when the compiler is clang, which lacks gcc's __builtin_shuffle that src/rod/lanes.h
// uses. Not needed any more once that file chooses __builtin_shufflevector for clang.

#if defined(__clang__) && defined(__cplusplus)
template <class Vector, class Mask>
static inline __attribute__((always_inline)) Vector liveStiffnessShuffle(Vector a, Vector b, Mask mask) {
  constexpr int kLanes = sizeof(Vector) / sizeof(a[0]);
  Vector result = a;
  for (int i = 0; i < kLanes; ++i) result[i] = mask[i] < kLanes ? a[mask[i]] : b[mask[i] - kLanes];
  return result;
}
#define __builtin_shuffle(a, b, ...) liveStiffnessShuffle(a, b, __VA_ARGS__)
#endif
