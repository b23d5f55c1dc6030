#pragma once
// First-order lag y' = (u - y) / tau of a vector, exact for an input that is linear between updates.

#include <cmath>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

class FirstOrderLag {
 public:
  // time_constant: tau, s; 0 lets the input through. Input and output start at zero.
  FirstOrderLag(int size, double time_constant)
      : time_constant_(time_constant), input_(Pressures::Zero(size)), output_(Pressures::Zero(size)) {}

  // Goes on by `step` (s, not negative) to an input that has moved linearly since the last update.
  const Pressures& update(const Pressures& input, double step) {
    if (time_constant_ <= 0.0) {
      output_ = input;
    } else if (step > 0.0) {
      const Pressures lead = (time_constant_ / step) * (input - input_);  // tau u', how far y trails a ramp
      output_ = input - lead + std::exp(-step / time_constant_) * (output_ - input_ + lead);
    }
    input_ = input;
    return output_;
  }

  const Pressures& output() const { return output_; }

 private:
  double time_constant_;
  Pressures input_, output_;
};

}  // namespace live_stiffness
