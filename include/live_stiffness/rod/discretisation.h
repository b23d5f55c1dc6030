#pragma once
// How many stages and elements a chain needs for an accuracy, and what error they leave.

#include <algorithm>

#include "live_stiffness/rod/backbone.h"

namespace live_stiffness {

class Discretisation {
 public:
  // accuracy: relative, of pose and compliance. stages: of every element; 0: whatever is cheapest.
  Discretisation(const Chain& chain, double accuracy, int stages);

  // Chooses stages and elements for the rest states in the backbone, and loads if any act. True if that changed
  // anything: the backbone then holds no guess.
  bool choose(const DeadLoads& loads, Backbone& backbone);
  bool chooseUnloaded(Backbone& backbone);

  // Estimated relative error of a finished shape and its columns. cancellation: how much larger these are than the
  // compliance made of them.
  double truncation(double cancellation, const Backbone& backbone);

  // Doubles the elements of every segment whose estimated error, times `amplification`, is above the accuracy, or that
  // bend too far for one Cayley vector. False if there is none to double.
  bool refine(double amplification, Backbone& backbone);

  // Forgets what refine() has learnt.
  void reset() { std::fill(caution_.begin(), caution_.end(), 1.0); }

 private:
  const Chain& chain_;
  double accuracy_;
  struct Choice {
    int stages;
    double cost;     // of an element, relative
    double bending;  // that an element carries at the accuracy, rad
  };
  std::vector<Choice> choices_;
  std::vector<double> demand_;   // bending that counts for the number of elements, of each segment, rad
  double cancellation_ = 1.0;    // the last given
  std::vector<double> caution_;  // what refine() has learnt: a factor on the number of elements of each segment
};

}  // namespace live_stiffness
