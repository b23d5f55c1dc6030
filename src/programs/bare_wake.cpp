#include "bare_wake.h"

#include <ros/ros.h>

#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "latencies.h"
#include "progress_bar.h"
#include "stolen_time.h"

namespace live_stiffness {

void measureBareWake(double rate, double seconds) {
  std::mutex mutex;
  std::condition_variable changed;
  bool is_called = false, is_over = false;
  ros::WallTime called;
  std::vector<double> taken;  // s
  std::thread waiting([&] {
    std::unique_lock<std::mutex> lock(mutex);
    while (true) {
      changed.wait(lock, [&] { return is_called || is_over; });
      if (is_over) return;
      taken.push_back((ros::WallTime::now() - called).toSec());
      is_called = false;
    }
  });
  ProgressBar bar("bare wake, " + std::to_string(int(rate)) + " Hz", static_cast<long>(seconds));
  const StolenTime stolen;
  const long count = static_cast<long>(rate * seconds);
  ros::WallTime next = ros::WallTime::now();
  for (long i = 0; ros::ok() && i <= count; ++i) {
    bar.update(static_cast<long>(i / rate));
    next += ros::WallDuration(1.0 / rate);
    ros::WallTime::sleepUntil(next);
    {
      const std::lock_guard<std::mutex> lock(mutex);
      called = ros::WallTime::now();
      (i < count ? is_called : is_over) = true;
    }
    changed.notify_one();
  }
  {
    const std::lock_guard<std::mutex> lock(mutex);
    is_over = true;
  }
  changed.notify_one();
  waiting.join();
  const Latencies wake(std::move(taken));
  std::printf("bare wake,%g,%.1f,%.1f,%.1f,%.1f\n", rate, wake.at(0.5), wake.at(0.99), wake.at(0.999), stolen.rate());
  std::fflush(stdout);
}

}  // namespace live_stiffness
