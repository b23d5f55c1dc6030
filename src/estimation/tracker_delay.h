#pragma once
// How much later the tracker's poses are than the pressures, because of its filter, its driver's buffer or different clocks.

#include <string>
#include <vector>

#include "live_stiffness/estimation/recording.h"

namespace live_stiffness {

// The recording on the tracker's clock: each sample gets the pressures and the wrench of `delay` s before it, interpolated;
// before the first sample and after the last one theirs. delay may be negative.
Recording withTrackerDelay(const Recording& recording, double delay);

struct TrackerDelay {
  static constexpr double kLargest = 0.5;            // s, in both directions: range of the search
  static constexpr double kLargestError = 0.02;      // s: a delay with a larger error is not determined
  double delay = 0.0;                                // s; positive: the tracker is late. 0 unless determined
  double standard_error = 0.0;                       // s; infinite: nothing moved
  bool determined = false;
  double rms_before = 0.0, rms = 0.0;                // distance from the prediction without and with the delay, m

  std::string text() const;  // as one line
};

// The delay at which predicted positions of the sensor (m, tracker frame; one for the pressures of each sample) are nearest
// to the measured ones, as the mean square over the samples that nothing touches (isUnloaded), of which there must be one:
//   sum_i |p_predicted(t_i - delay) - p_measured(t_i)|^2,
// with predictions interpolated in time. For the standard error, the remaining errors are assumed to last for a second, as
// model error does.
TrackerDelay fitTrackerDelay(const Recording& recording, const std::vector<Vector3>& predicted);

}  // namespace live_stiffness
