#pragma once
// The shape of the robot: what kinematics (unloaded) and statics (loaded) both produce, and compliance reads.

#include <vector>

#include "rod/chain.h"
#include "rod/rod_element.h"

namespace live_stiffness {

// Mutable result of a solve; built once for a scene, then reused without allocation.
struct Backbone {
  const ElementKernel* kernel;         // functions that compute the elements; the same for all
  std::vector<RestState> rest;         // one per segment
  std::vector<int> element_count;      // one per segment
  std::vector<RodElement> elements;    // base to tip, element_count[k] of segment k; inside `capacity`
  Pose X_BT;                           // tip point

  static constexpr int kMaxElements = 512;  // per segment
  explicit Backbone(const Scene& scene, Simd simd = Simd::kBest);

  Simd simd() const { return simd_; }
  // First element of a segment in `elements`.
  int firstElement(int segment) const;
  // Stretched length of a segment, m.
  double length(int segment) const { return element_count[segment] * elements[firstElement(segment)].state.length; }
  // Makes these elements of each segment, with this number of stages. They hold no guess.
  void resize(const std::vector<int>& count, int stages);
  // X_BT from numbers, R row-major.
  void setTip(const double (&R)[9], const double (&p)[3]);

 private:
  Simd simd_;
};

}  // namespace live_stiffness
