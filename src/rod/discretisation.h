#pragma once
// How many stages and elements a chain needs for an accuracy, and what error they leave.

#include <algorithm>

#include "rod/nodal_rotations.h"

namespace live_stiffness {

class Discretisation {
 public:
  // accuracy: relative, of pose and compliance. stages: of every element; 0: whatever is cheapest.
  Discretisation(const Chain& chain, double accuracy, int stages);

  // Chooses stages and elements for the rest states in the backbone, and loads if any act. True if the backbone has others:
  // then apply() gives it these. Its elements then hold no guess.
  bool choose(const DeadLoads& loads, const Backbone& backbone);
  // The same for a shape that may bend more than the loads let expect. Call choose() before.
  bool chooseFor(const NodalRotations& shape, const Backbone& backbone);
  bool chooseUnloaded(const Backbone& backbone);
  void apply(Backbone& backbone) const { backbone.resize(count_, stages_); }

  // Bending that the rest states and loads of the last choose() let expect of each segment, rad, whatever the accuracy.
  const std::vector<double>& demand() const { return demand_; }

  // Makes choose() limit the bending of an element further, for more reliable convergence.
  void shorten() { most_ = kShort; }

  // Estimated relative error of a converged shape and its sensitivities.
  double truncation(const Backbone& backbone) const;

  // Refines a segment (more stages or elements) if its estimated error times `buckling_factor`, the buckling factor of
  // StaticsReport, is above the accuracy, or if its elements bend too far for one Cayley vector. False if nothing had to, or
  // could, be refined; else call apply().
  bool refine(double buckling_factor, const Backbone& backbone);

  // Undoes the effect of refine() and shorten().
  void reset() {
    std::fill(safety_factor_.begin(), safety_factor_.end(), 1.0);
    most_ = kLong;
  }

 private:
  static constexpr double kLong = 1.8, kShort = 1.5;  // rad an element

  bool chooseForDemand(const Backbone& backbone);
  bool differs(const Backbone& backbone) const;
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
  std::vector<int> count_;       // chosen, of each segment
  int stages_ = kMaxStages;      // chosen
  std::vector<double> safety_factor_;  // safety factor on each demand, from refine()
  std::vector<double> seen_safety_factor_;  // safety factors that the last solution would have needed
  int hysteresis_count_ = 1;                  // solves until smaller safety factors are tried
};

}  // namespace live_stiffness
