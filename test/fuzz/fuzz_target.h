#pragma once
// A fuzz target is one function that reads bytes as the product would read them from elsewhere, and says what must hold
// whatever they are. libFuzzer calls it millions of times (scripts/fuzz); corpus_main.cpp calls it with the committed
// corpus, as a test with any compiler.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size);

namespace live_stiffness {

inline std::string textOf(const std::uint8_t* data, size_t size) {
  return std::string(reinterpret_cast<const char*>(data), size);
}

// Ends the process with the message unless `holds`; not assert, which Release drops.
inline void require(bool holds, const char* message) {
  if (holds) return;
  std::fprintf(stderr, "required: %s\n", message);
  std::abort();
}

}  // namespace live_stiffness
