#pragma once
// How many stages and elements a chain needs for an accuracy, and what error they leave.

#include <algorithm>

#include "rod/backbone.h"

namespace live_stiffness {

class Discretisation {
 public:
  // accuracy: relative, of pose and compliance. stages: of every element; 0: whatever is cheapest.
  Discretisation(const Chain& chain, double accuracy, int stages);

  // Chooses stages and elements for the rest states in the backbone, and loads if any act. True if that changed
  // anything: the backbone then holds no guess.
  bool choose(const DeadLoads& loads, Backbone& backbone);
  bool chooseUnloaded(Backbone& backbone);

  // Lets choose() take elements that bend less, if accuracy lets them bend so far: sweeps converge more surely on them.
  void shorten() { most_ = kShort; }

  // Estimated relative error of a finished shape and its columns. cancellation: how much larger these are than the
  // compliance made of them.
  double truncation(double cancellation, const Backbone& backbone);

  // Takes more stages or elements if the estimated error of a segment, times `amplification`, is above the accuracy (and
  // what is tolerated), or if its elements bend too far for one Cayley vector. False if all is well or there are no more
  // to take.
  bool refine(double amplification, Backbone& backbone, double tolerated = 0.0);

  // Forgets what refine() and shorten() have told.
  void reset() {
    std::fill(caution_.begin(), caution_.end(), 1.0);
    most_ = kLong;
  }

 private:
  static constexpr double kLong = 1.8, kShort = 1.5;  // rad an element

  bool chooseForDemand(Backbone& backbone);
  double demandOf(size_t segment) const { return demand_[segment] * caution_[segment]; }

  const Chain& chain_;
  double accuracy_;
  double most_ = kLong;  // bending of an element, rad, whatever the accuracy
  struct Choice {
    int stages;
    double cost;     // of an element, relative
    double bending;  // that an element carries at the accuracy, rad
  };
  double bendingOf(const Choice& choice) const { return std::min(most_, choice.bending); }
  std::vector<Choice> choices_;
  std::vector<double> demand_;   // bending that counts for the number of elements, of each segment, rad; before caution
  double cancellation_ = 1.0;    // the last given
  std::vector<double> caution_;  // what refine() has learnt: a factor on each demand
  std::vector<double> seen_caution_;  // what the last solution would have needed
  int patience_ = 1;                  // solves until less caution is tried
};

}  // namespace live_stiffness
