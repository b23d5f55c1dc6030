#include "rod/discretisation.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {
namespace {

constexpr double kLeastDemand = 1e-3;

// Stages to choose from, and what an element costs with them, relative (docs/speed_against_error.md). One element of S
// stages that bends by x rad leaves an error of about (x / reach)^(2 S).
constexpr struct {
  int stages;
  double reach, cost;
} kChoices[] = {{5, 5.0, 0.85}, {7, 5.8, 1.0}};

// Bending of an element that the accuracy allows, rad.
double bendingOfAnElement(int stages, double accuracy) {
  for (const auto& choice : kChoices)
    if (choice.stages == stages) return choice.reach * std::pow(accuracy, 0.5 / stages);
  return 0.0;
}

int countOf(double demand, double bending) {
  const double elements = demand / bending;
  constexpr int kMost = Backbone::kMaxElements;
  if (!(elements < kMost)) return kMost;  // also for NaN, with which no solve succeeds
  const int whole = static_cast<int>(elements);  // without SSE4.1 std::ceil is a function call
  return std::max(1, whole + (elements > whole));
}

// The error of Gauss collocation is the product of two truncation errors: of the solution and of its Green's function, which
// are similar. With this factor the error of 99.9 % of random cases is below ten times the estimate
// (docs/speed_against_error.md).
double truncationOf(const RodElement& element) {
  return 16.0 * element.state.truncation * element.state.truncation + element.state.sensitivity_truncation;
}

}  // namespace

Discretisation::Discretisation(const Chain& chain, double accuracy, int stages)
    : chain_(chain), accuracy_(accuracy) {
  for (const Chain::Part& part : chain.parts)
    if (part.segment >= 0) demand_.push_back(0.0);
  count_.assign(demand_.size(), 1);
  safety_factor_ = seen_safety_factor_ = std::vector<double>(demand_.size(), 1.0);
  // For a nearly straight rod the estimate is unreliable and too small for few stages, so these are not used at high accuracy.
  const int least = accuracy >= 1e-10 ? 5 : 7;
  for (const auto& choice : kChoices)
    if (stages == choice.stages || (stages == 0 && choice.stages >= least))
      choices_.push_back({choice.stages, choice.cost, bendingOfAnElement(choice.stages, accuracy)});
}

// The shape is exact with any number of stages; they only decide from how many nodes stations are interpolated.
bool Discretisation::chooseUnloaded(const Backbone& backbone) {
  constexpr double kFewNodesAccuracy = 1e-7;
  for (const Chain::Part& part : chain_.parts) {
    if (part.segment < 0) continue;
    const RestState& rest = backbone.rest[part.segment];
    const double length = rest.stretch * part.length, bending_squared = length * length * rest.curvature.squaredNorm();
    // One element is enough most often; this test needs no root and no division.
    const bool one = bending_squared <= kShort * kShort;
    count_[part.segment] = one ? 1 : countOf(std::sqrt(bending_squared), kShort);
  }
  const int cheapest = accuracy_ >= kFewNodesAccuracy ? kChoices[0].stages : kMaxStages;
  stages_ = choices_.size() == 1 ? choices_[0].stages : cheapest;
  return differs(backbone);
}

bool Discretisation::differs(const Backbone& backbone) const {
  return stages_ != backbone.kernel->stages || backbone.elements.empty() || count_ != backbone.element_count;
}

bool Discretisation::choose(const DeadLoads& loads, const Backbone& backbone) {
  constexpr double kBendingOfNormalisedLoad = 1.25;  // rad of bending for each unit of L sqrt(|n| c_bt)
  const double moment = angular(loads.tip).norm();
  Vector3 n = loads.baseForce(chain_);
  for (const Chain::Part& part : chain_.parts) {
    const double n_start = n.norm();
    n -= part.mass * loads.gravity;
    if (part.segment < 0) continue;
    const double force = std::max(n_start, n.norm());
    const RestState& rest = backbone.rest[part.segment];
    const double length = rest.stretch * part.length;
    const double bending_compliance = rest.c.bending_torsion.diagonal().maxCoeff();
    const double bending = length * (rest.curvature.norm() + bending_compliance * moment);
    const double normalised_load = length * std::sqrt(bending_compliance * force);
    demand_[part.segment] = std::max({bending, kBendingOfNormalisedLoad * normalised_load, kLeastDemand});
  }
  return chooseForDemand(backbone);
}

bool Discretisation::chooseFor(const NodalRotations& shape, const Backbone& backbone) {
  for (size_t k = 0; k < demand_.size(); ++k) demand_[k] = std::max(demand_[k], shape.bending(static_cast<int>(k)));
  return chooseForDemand(backbone);
}

bool Discretisation::chooseForDemand(const Backbone& backbone) {
  // The cheapest choice, one element with the fewest stages for each segment, is enough most often.
  bool one_each = true;
  for (size_t k = 0; k < demand_.size(); ++k) one_each = one_each && demandOf(k) <= bendingOf(choices_.front());
  const Choice* best = &choices_.front();
  double cheapest = kInfinity;
  for (const Choice& choice : choices_) {
    if (one_each) break;
    double cost = 0.0;
    for (size_t k = 0; k < demand_.size(); ++k) cost += choice.cost * countOf(demandOf(k), bendingOf(choice));
    if (cost < cheapest) {
      cheapest = cost;
      best = &choice;
    }
  }
  for (size_t k = 0; k < demand_.size(); ++k)
    count_[k] = one_each ? 1 : countOf(demandOf(k), bendingOf(*best));
  stages_ = best->stages;
  return differs(backbone);
}

double Discretisation::truncation(const Backbone& backbone) const {
  double sum = 0.0;
  for (const RodElement& element : backbone.elements) sum += truncationOf(element);
  return sum;
}

bool Discretisation::refine(double buckling_factor, const Backbone& backbone) {
  constexpr double kMargin = 1.05, kRefined = 1.25, kMostGrowth = 2.0, kEasierBy = 0.8;
  constexpr int kHysteresisCount = 50;  // solves; an attempt with too few elements costs a second solve
  const int stages = backbone.kernel->stages;
  static const double kLongest = std::pow(2.0 * std::tan(1.05), 2);  // |g|^2 of 2.1 rad
  bool wanting = false, easier = true;
  auto element = backbone.elements.begin();
  for (size_t segment = 0; segment < demand_.size(); ++segment) {
    const int count = backbone.element_count[segment];
    double error = 0.0, longest = 0.0;
    for (int k = 0; k < count; ++k, ++element) {
      error += truncationOf(*element);
      longest = std::max(longest, element->g_end(stages).squaredNorm());
    }
    error *= buckling_factor;
    const bool too_long = longest > kLongest, fine = error <= accuracy_ && !too_long;
    easier = easier && !too_long && safety_factor_[segment] > 1.0;
    if (fine && !easier) continue;
    const double capacity = count * std::min(most_, bendingOfAnElement(stages, accuracy_));
    // Bending at which elements with this number of stages would have this error.
    const double seen = std::pow(error / accuracy_, 0.5 / stages) * capacity;
    seen_safety_factor_[segment] = std::max(1.0, kMargin * seen / demand_[segment]);
    easier = easier && seen_safety_factor_[segment] <= kEasierBy * safety_factor_[segment];
    if (fine) {
      seen_safety_factor_[segment] = std::min(seen_safety_factor_[segment], safety_factor_[segment]);
      continue;
    }
    wanting = true;
    const double growth = too_long ? kMostGrowth : seen / demandOf(segment);
    safety_factor_[segment] *= std::clamp(kRefined * growth, kRefined, kMostGrowth);  // NaN: unchanged
    // Ask for more than the present choice was made for.
    safety_factor_[segment] = std::max(safety_factor_[segment], kMargin * capacity / demand_[segment]);
  }
  hysteresis_count_ = wanting || !easier ? kHysteresisCount : hysteresis_count_ - 1;
  if (hysteresis_count_ == 0) {
    safety_factor_ = seen_safety_factor_;
    hysteresis_count_ = kHysteresisCount;
  }
  return wanting && chooseForDemand(backbone);
}

}  // namespace live_stiffness
