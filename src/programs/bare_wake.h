#pragma once
// What the system needs to wake a thread that waits, with nothing else to do: what latencies of a node are to be seen against.

namespace live_stiffness {

// So many times a second (Hz), for so long (s). Prints, as CSV, "bare wake", the rate, median, 99th and 99.9th percentile in
// microseconds, and processor time stolen, in milliseconds a second.
void measureBareWake(double rate, double seconds);

}  // namespace live_stiffness
