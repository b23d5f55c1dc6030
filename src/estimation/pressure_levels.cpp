#include "estimation/pressure_levels.h"

#include <algorithm>
#include <cmath>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

constexpr double kNear = 0.08;  // relative, of the lowest pressures to that of the atmosphere
constexpr long kEnough = 20;    // messages for that
constexpr long kMoving = 100;   // messages for a judgement of the range
constexpr double kDrift = 20.0;  // times the mean step: what moves, and is not noise

}  // namespace

double fullRange(const Scene& scene) {
  double range = 0.0;
  walk(scene,
       [&](int, const Segment& segment) {
         const Chambers& chambers = segment.section.chambers;
         if (chambers.count() == 0) return;
         const double pressure =
             segment.section.youngs_modulus * segment.section.area(1.0) / (chambers.count() * chambers.area());
         range = range == 0.0 ? pressure : std::min(range, pressure);
       },
       [](const Link&) {});
  return range;
}

void PressureLevels::add(PressuresRef gauge) {
  if (gauge.size() == 0) return;
  if (last_.size() != gauge.size()) {
    last_ = lowest_ = highest_ = gauge;
    steps_ = 0.0;
    count_ = 0;
  }
  steps_ += (gauge - last_).cwiseAbs().maxCoeff();
  last_ = gauge;
  lowest_ = lowest_.cwiseMin(gauge);
  highest_ = highest_.cwiseMax(gauge);
  ++count_;
}

std::string PressureLevels::doubt() const {
  if (count_ == 0) return "";
  const double level = lowest_[0] < 0.0 ? -kAtmospherePa : kAtmospherePa;
  if (count_ >= kEnough && ((lowest_.array() - level).abs() < kNear * kAtmospherePa).all())
    return numberText(1e-3 * lowest_.mean()) + " kPa in all channels: " +
           (level > 0.0 ? "told gauge, sent absolute? (pressure_reference: absolute)"
                        : "told absolute, sent gauge? (pressure_reference: gauge)") + ", or another pressure_unit";
  const double largest = std::max(highest_.maxCoeff(), -lowest_.minCoeff());
  const bool is_moving = count_ >= kMoving && (highest_ - lowest_).maxCoeff() > kDrift * steps_ / static_cast<double>(count_);
  if (is_moving && largest < 1e-3 * full_range_)
    return "pressures never exceed " + numberText(largest) + " Pa, while the robot is made for some " +
           numberText(1e-3 * full_range_) + " kPa: in another unit? (pressure_unit)";
  return "";
}

}  // namespace live_stiffness
