#pragma once
// For messages from the network: roscpp makes room for as many numbers as a message claims before it looks whether
// they are there, and a damaged one may claim four thousand million.

#include <cstddef>
#include <memory>

namespace live_stiffness {

// As std::allocator, but vectors with it throw std::length_error when they would grow beyond kMostElements.
template <class T>
struct ShortAllocator : std::allocator<T> {
  static constexpr std::size_t kMostElements = 65536;  // more than 64 chambers on each of 256 bodies

  template <class Other>
  struct rebind {
    using other = ShortAllocator<Other>;
  };
  ShortAllocator() = default;
  template <class Other>
  ShortAllocator(const ShortAllocator<Other>&) {}

  std::size_t max_size() const { return kMostElements; }
};

}  // namespace live_stiffness
