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

  // Makes choose() limit the bending of an element further, for more reliable convergence.
  void shorten() { most_ = kShort; }

  // Estimated relative error of a converged shape and its sensitivities. cancellation: the size of the sensitivities divided
  // by that of the compliance, which is computed as their difference.
  double truncation(double cancellation, const Backbone& backbone);

  // Refines a segment (more stages or elements) if its estimated error times `buckling_factor`, the buckling factor of
  // StaticsReport, is above the accuracy and above `tolerated`, or if its elements bend too far for one Cayley vector. False
  // if nothing had to, or could, be refined.
  bool refine(double buckling_factor, Backbone& backbone, double tolerated = 0.0);

  // Undoes the effect of refine() and shorten().
  void reset() {
    std::fill(safety_factor_.begin(), safety_factor_.end(), 1.0);
    most_ = kLong;
  }

 private:
  static constexpr double kLong = 1.8, kShort = 1.5;  // rad an element

  bool chooseForDemand(Backbone& backbone);
  double demandOf(size_t segment) const { return demand_[segment] * safety_factor_[segment]; }

  const Chain& chain_;
  double accuracy_;
  double most_ = kLong;  // limit on the bending of an element at any accuracy, rad
  struct Choice {
    int stages;
    double cost;     // of an element, relative
    double bending;  // that one element can have at this accuracy, rad
  };
  double bendingOf(const Choice& choice) const { return std::min(most_, choice.bending); }
  std::vector<Choice> choices_;
  std::vector<double> demand_;   // bending of each segment that decides its number of elements, rad; without safety_factor_
  double cancellation_ = 1.0;    // last argument of truncation()
  std::vector<double> safety_factor_;  // safety factor on each demand, from refine()
  std::vector<double> seen_safety_factor_;  // safety factors that the last solution would have needed
  int hysteresis_count_ = 1;                  // solves until smaller safety factors are tried
};

}  // namespace live_stiffness
