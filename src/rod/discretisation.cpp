#include "live_stiffness/rod/discretisation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace live_stiffness {
namespace {

// One element of S stages that bends by x rad leaves an error of about (x / kReach[S])^(2 S).
constexpr double kReach[kMaxStages + 1] = {0, 0, 3.0, 4.0, 5.0, 6.0, 6.75, 7.2};
constexpr double kMaxBending = 1.5;  // rad an element, whatever the accuracy

// Stages to choose from, and what an element costs with them, relative (docs/speed_against_error.md).
constexpr struct {
  int stages;
  double cost;
} kChoices[] = {{3, 0.5}, {5, 0.85}, {7, 1.0}};

double bendingOfAnElement(int stages, double accuracy) {
  return std::min(kMaxBending, kReach[stages] * std::pow(accuracy, 0.5 / stages));
}

}  // namespace

Discretisation::Discretisation(const Chain& chain, double accuracy, int stages)
    : chain_(chain), accuracy_(accuracy) {
  for (const Chain::Part& part : chain.parts)
    if (part.segment >= 0) demand_.push_back(0.0);
  caution_.assign(demand_.size(), 1.0);
  for (const auto& choice : kChoices)
    if (stages == 0 || stages == choice.stages)
      choices_.push_back({choice.stages, choice.cost, bendingOfAnElement(choice.stages, accuracy)});
  if (choices_.empty()) choices_.push_back({stages, 1.0, bendingOfAnElement(stages, accuracy)});
}

bool Discretisation::choose(const DeadLoads* loads, Backbone& backbone) {
  constexpr double kBendingOfLoadNumber = 1.25;  // L sqrt(|n| c_bt) counts as so much bending
  const double force = loads ? loads->baseForce(chain_).norm() : 0.0;
  const double moment = loads ? angular(loads->tip).norm() : 0.0;
  for (const Chain::Part& part : chain_.parts) {
    if (part.segment < 0) continue;
    const RestState& rest = backbone.rest[part.segment];
    const double length = rest.stretch * part.length;
    const double softness = rest.c.bending_torsion.diagonal().maxCoeff();
    const double bending = length * (rest.curvature.norm() + softness * moment);
    const double load_number = length * std::sqrt(softness * force);
    demand_[part.segment] = std::max(bending, kBendingOfLoadNumber * load_number) * caution_[part.segment];
  }
  const auto count = [&](int segment, double bending) {
    return static_cast<int>(std::clamp(std::ceil(demand_[segment] / bending), 1.0, Backbone::kMaxElements / 2.0));
  };
  const Choice* best = nullptr;
  double cheapest = std::numeric_limits<double>::infinity();
  for (const Choice& choice : choices_) {
    double cost = 0.0;
    for (size_t k = 0; k < demand_.size(); ++k) cost += choice.cost * count(static_cast<int>(k), choice.bending);
    if (cost < cheapest) {
      cheapest = cost;
      best = &choice;
    }
  }
  for (size_t k = 0; k < demand_.size(); ++k)
    backbone.element_count[k] = count(static_cast<int>(k), best->bending);
  return backbone.resize(best->stages);
}

double Discretisation::truncation(const Backbone& backbone) const {
  double sum = 0.0;
  for (const RodElement& element : backbone.elements) sum += 4.0 * element.state.truncation * element.state.truncation;
  return sum;
}

bool Discretisation::refine(Backbone& backbone) {
  bool refined = false;
  auto element = backbone.elements.begin();
  for (size_t segment = 0; segment < demand_.size(); ++segment) {
    int& count = backbone.element_count[segment];
    double error = 0.0, bending = 0.0;
    for (int k = 0; k < count; ++k, ++element) {
      error += 4.0 * element->state.truncation * element->state.truncation;
      bending = std::max(bending, element->bending(backbone.passes->stages));
    }
    if ((error > accuracy_ || bending > 1.4 * kMaxBending) && 2 * count <= Backbone::kMaxElements) {
      count *= 2;
      caution_[segment] *= 2.0;
      refined = true;
    } else if (caution_[segment] > 1.0 && error < 1e-3 * accuracy_ && bending < 0.4 * kMaxBending) {
      caution_[segment] = 1.0;
    }
  }
  if (refined) backbone.resize(backbone.passes->stages);
  return refined;
}

}  // namespace live_stiffness
