#include "rod/shooting.h"

#include <cmath>

namespace live_stiffness {

ChainState stateOf(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, Backbone& backbone) {
  ChainState state;
  state.parts = chain.parts.data();
  state.part_count = static_cast<int>(chain.parts.size());
  state.element_count = backbone.element_count.data();
  state.elements = &backbone.elements.data()->state;
  for (int i = 0; i < 3; ++i) {
    state.gravity[i] = loads.gravity[i];
    state.base_force[i] = loads.tip[i] + chain.mass * loads.gravity[i];
    state.base_moment[i] = base_moment[i];
    state.tip_offset[i] = chain.tip_offset[i];
    state.tip_moment[i] = loads.tip[3 + i];
  }
  return state;
}

namespace {

// Change of an element's rest curvature, from what it has to `rest`, as an angle between its ends, rad.
Vector3 turnOf(const ElementState& e, double length, const RestState& rest) {
  return length * rest.curvature - e.length * Vector3(e.rest_curvature);
}

// The multiple of the last change that is nearest to this one; 0 if it is not near.
double extrapolationOf(const Chain& chain, const Backbone& backbone) {
  constexpr double kNear = 0.1, kMost = 2.0;
  double along = 0.0, last = 0.0, now = 0.0;
  auto element = backbone.elements.begin();
  for (const Chain::Part& part : chain.parts) {
    if (part.segment < 0) continue;
    const RestState& rest = backbone.rest[part.segment];
    const int count = backbone.element_count[part.segment];
    for (int k = 0; k < count; ++k, ++element) {
      const ElementState& e = element->state;
      const Vector3 turn = turnOf(e, rest.stretch * part.length / count, rest), before(e.turn);
      along += turn.dot(before);
      last += before.squaredNorm();
      now += turn.squaredNorm();
    }
  }
  const double extrapolation = along / last;
  const bool can_extrapolate =  // false if NaN
      now - extrapolation * along <= kNear * kNear * now && std::abs(extrapolation) <= kMost;
  return can_extrapolate ? extrapolation : 0.0;
}

}  // namespace

void prepare(const Chain& chain, const DeadLoads& loads, Backbone& backbone, History keep, bool extrapolate) {
  const double extrapolation = extrapolate ? extrapolationOf(chain, backbone) : 0.0;
  auto element = backbone.elements.begin();
  for (const Chain::Part& part : chain.parts) {
    if (part.segment < 0) continue;
    const RestState& rest = backbone.rest[part.segment];
    const int count = backbone.element_count[part.segment];
    const double length = rest.stretch * part.length, density = part.mass / length;
    const double own_length = count == 1 ? length : length / count;  // a division is slow, and all below depends on it
    for (int k = 0; k < count; ++k, ++element) {
      ElementState& e = element->state;
      if (keep != History::kNone) {
        const Vector3 turn = turnOf(e, own_length, rest);
        const bool first = element == backbone.elements.begin();  // its start does not turn
        const int columns = keep != History::kSensitivities ? 0 : first ? kOfRotation : kColumns;
        backbone.kernel->predict(e, {turn.x(), turn.y(), turn.z()}, extrapolation, columns);
      }
      e.length = own_length;
      e.start = k * own_length;
      element->setSection(rest);
      element->setLoad(density * loads.gravity);
    }
  }
}

MarchResult march(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, MarchMode mode, Backbone& backbone) {
  MarchResult result;
  backbone.kernel->march(stateOf(chain, loads, base_moment, backbone), mode, result);
  backbone.setTip(result.R_tip, result.p_tip);
  return result;
}

bool shoot(const Chain& chain, const DeadLoads& loads, const Vector3& base_moment, bool nodes_hold_guess,
           Backbone& backbone, Vector3& residual) {
  constexpr int kMaxIterations = 100;
  constexpr double kConverged = 2e-16, kWobble = 1e-13;  // rad
  double last_change = kInfinity;
  for (int i = 0; i < kMaxIterations; ++i) {
    const bool cold = i == 0 && !nodes_hold_guess;
    const MarchResult s = march(chain, loads, base_moment, cold ? MarchMode::kCold : MarchMode::kIterate, backbone);
    residual = Vector3(s.residual);
    if (!s.is_admissible) return false;
    // Rounding can keep the change just above the bound; then stop when it no longer shrinks.
    if (s.change <= kConverged || (s.change <= kWobble && s.change >= last_change)) return true;
    last_change = s.change;
  }
  return false;
}

}  // namespace live_stiffness
