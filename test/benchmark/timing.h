#pragma once
// Times of updates along a path of pressures.

#include <memory>
#include <vector>

#include "benchmark/methods/stiffness_method.h"

namespace live_stiffness {

// Monotonic clock, s. A call takes about 45 ns, which nothing here subtracts.
double clockSeconds();

// How often the kernel has taken the processor away from this process so far.
long preemptions();

// The value below which the given share (0 to 1) of the samples lies; sorts them.
double quantile(std::vector<float>& samples, double share);

// One method on one closed path of pressures, measured in slices so that several can take turns and a disturbance of
// the machine hits all alike.
class TimedMethod {
 public:
  // cold: reset before every update. path must outlive this.
  TimedMethod(std::unique_ptr<StiffnessMethod> method, const std::vector<Pressures>& path, bool cold);

  StiffnessMethod& method() { return *method_; }
  // Solves the next pressure of the path.
  MethodSolution update();
  // Measures for the given time, s. Updates are timed in batches of about kBatchSeconds, and a sample is the mean over a
  // batch, so that the clock costs a method of 0.5 us less than 2 %.
  void measure(double seconds);

  int batch() const { return batch_; }
  bool converged() const { return converged_; }  // in every update so far
  std::vector<float>& samplesUs() { return samples_us_; }

 private:
  static constexpr double kBatchSeconds = 5e-6;

  std::unique_ptr<StiffnessMethod> method_;
  const std::vector<Pressures>& path_;
  bool cold_, converged_ = true;
  size_t at_ = 0;
  int batch_ = 0;  // updates; 0: not chosen yet
  std::vector<float> samples_us_;
};

}  // namespace live_stiffness
