#pragma once
// Times of updates along a path of pressures.

#include <memory>
#include <vector>

#include "benchmark/methods/stiffness_method.h"

namespace live_stiffness {

// Monotonic clock, s. A call takes about 45 ns, which nothing here subtracts.
double clockSeconds();

// Processor time of this thread, s: other processes on the same core do not count. A call takes about 350 ns.
double processorSeconds();

// How often the kernel has taken the processor away from this process so far.
long preemptions();

// The value below which the given share (0 to 1) of the samples lies; sorts them.
double quantile(std::vector<float>& samples, double share);

// One method on one closed path of pressures, measured in slices so that several can take turns and what slows the
// machine hits all alike.
class TimedMethod {
 public:
  // cold: reset before every update. path must outlive this.
  TimedMethod(std::unique_ptr<StiffnessMethod> method, const std::vector<Pressures>& path, bool cold);

  StiffnessMethod& method() { return *method_; }
  // Solves the next pressure of the path.
  StiffnessSolution update();
  // Measures for the given processor time, s. Updates are timed in batches of about kBatchSeconds, so that reading the
  // clock adds less than 1 %; a sample is the mean over a batch.
  void measure(double seconds);

  int batch() const { return batch_; }
  bool converged() const { return converged_; }  // in every update so far
  std::vector<float>& samplesUs() { return samples_us_; }

 private:
  static constexpr double kBatchSeconds = 4e-5;

  std::unique_ptr<StiffnessMethod> method_;
  const std::vector<Pressures>& path_;
  bool cold_, converged_ = true;
  size_t at_ = 0;
  int batch_ = 0;  // updates; 0: not chosen yet
  std::vector<float> samples_us_;
};

}  // namespace live_stiffness
