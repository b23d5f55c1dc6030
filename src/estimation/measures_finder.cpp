#include "estimation/measures_finder.h"

#include <algorithm>
#include <cmath>

#include "live_stiffness/estimation/error_summary.h"

namespace live_stiffness {
namespace {

constexpr long kEnough = 60, kMost = 600;      // poses
constexpr double kFar = 5e-3;                  // m that a tip moves only if it also turns
constexpr double kStill = 0.02 * kDegree;       // below the resolution of any tracker
constexpr double kJump = 15.0 * kDegree;        // from pose to pose, far beyond any motion
constexpr double kSteady = 2.0 * kDegree;       // from pose to pose

}  // namespace

void MeasuresFinder::add(const Pose& X_AS) {
  if (found_ || count_ >= kMost) return;
  if (count_ == 0) first_ = last_ = X_AS;
  largest_turn_ = std::max(largest_turn_, logSo3(first_.R.transpose() * X_AS.R).norm());
  farthest_ = std::max(farthest_, (X_AS.p - first_.p).norm());
  if (count_ > 0) {
    const Matrix3 untilted = completedPose(X_AS, last_, TrackerMeasures::kPositionAndAxis).R;  // the last roll, the new axis
    moves_.push_back((X_AS.p - last_.p).norm());
    tilts_.push_back(std::acos(std::clamp(last_.R.col(2).dot(X_AS.R.col(2)), -1.0, 1.0)));
    rolls_.push_back(logSo3(untilted.transpose() * X_AS.R).norm());
  }
  last_ = X_AS;
  if (++count_ >= kEnough) found_ = judge();
}

std::optional<TrackerMeasures> MeasuresFinder::judge() const {
  const double tilt = quantile(tilts_, 0.5), roll = quantile(rolls_, 0.5);
  if (largest_turn_ < kStill) return farthest_ > kFar ? std::optional(TrackerMeasures::kPosition) : std::nullopt;
  if (quantile(moves_, 0.5) > kFar) return std::nullopt;  // too fast to judge
  if (tilt > kJump) return TrackerMeasures::kPosition;
  if (tilt < kSteady && roll > kJump) return TrackerMeasures::kPositionAndAxis;
  return std::nullopt;
}

}  // namespace live_stiffness
