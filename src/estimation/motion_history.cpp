#include "estimation/motion_history.h"

#include <algorithm>
#include <iterator>

namespace live_stiffness {

void MotionHistory::add(const Moment& moment) {
  constexpr double kClockSet = 1.0;  // s
  if (!moments_.empty() && moment.time < moments_.back().time - kClockSet) clear();
  if (!moments_.empty() && moment.pressures.size() != moments_.back().pressures.size()) clear();
  if (!moments_.empty() && moment.time <= moments_.back().time) {
    if (moment.time == moments_.back().time) moments_.back() = moment;
    return;
  }
  moments_.push_back(moment);
  while (moments_.size() > kMost || moment.time - moments_.front().time > kCapacity) moments_.pop_front();
}

Moment MotionHistory::at(double time) const {
  const auto after = std::upper_bound(moments_.begin(), moments_.end(), time,
                                      [](double t, const Moment& moment) { return t < moment.time; });
  if (after == moments_.begin()) return moments_.front();
  if (after == moments_.end()) return moments_.back();
  const Moment& a = *std::prev(after);
  const Moment& b = *after;
  const double share = (time - a.time) / (b.time - a.time);
  return {time, a.pressures + share * (b.pressures - a.pressures),
          {a.X_BT.R * expSo3(share * logSo3(a.X_BT.R.transpose() * b.X_BT.R)),
           a.X_BT.p + share * (b.X_BT.p - a.X_BT.p)}};
}

}  // namespace live_stiffness
