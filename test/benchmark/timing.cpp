#include "benchmark/timing.h"

#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace live_stiffness {

double clockSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

long preemptions() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_nivcsw;
}

double quantile(std::vector<float>& samples, double share) {
  if (samples.empty()) return std::nan("");
  std::sort(samples.begin(), samples.end());
  return samples[std::min(samples.size() - 1, static_cast<size_t>(share * samples.size()))];
}

TimedMethod::TimedMethod(std::unique_ptr<StiffnessMethod> method, const std::vector<Pressures>& path, bool cold)
    : method_(std::move(method)), path_(path), cold_(cold) {}

StiffnessSolution TimedMethod::update() {
  if (cold_) method_->reset();
  StiffnessSolution solution = method_->solve(path_[at_]);
  at_ = at_ + 1 < path_.size() ? at_ + 1 : 0;
  converged_ = converged_ && solution.status.ok();
  return solution;
}

void TimedMethod::measure(double seconds) {
  const double start = processorSeconds();
  if (batch_ == 0) {
    int count = 0;
    for (; count < 4 || (count < 1000 && processorSeconds() - start < 1e-3); ++count) update();
    batch_ = std::clamp(static_cast<int>(std::ceil(kBatchSeconds * count / (processorSeconds() - start))), 1, 128);
  }
  if (batch_ > 1)
    for (int i = 0; i < batch_; ++i) update();  // another method had the caches
  double before = processorSeconds(), after = before;
  do {
    for (int i = 0; i < batch_; ++i) update();
    after = processorSeconds();
    samples_us_.push_back(static_cast<float>(1e6 * (after - before) / batch_));
    before = after;
  } while (after - start < seconds);
}

}  // namespace live_stiffness
