#pragma once
// Processor time that a virtual machine wanted and its host gave to others: their part in the tails of latencies.

#include <time.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <string>

namespace live_stiffness {

// Begins to count when constructed.
class StolenTime {
 public:
  // Since then, from all processors together, in milliseconds a second; NaN where the system does not tell.
  double rate() const {
    const Moment now;
    return 1e3 * (now.stolen - start_.stolen) / (now.time - start_.time);
  }

 private:
  // Since the machine started, in seconds.
  struct Moment {
    Moment() {
      // The first line of /proc/stat: cpu, then ticks of user, nice, system, idle, iowait, irq, softirq, steal.
      std::ifstream file("/proc/stat");
      std::string name;
      double ticks = NAN;
      file >> name;
      for (int column = 0; column < 8; ++column) file >> ticks;
      if (file) stolen = ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
      timespec now{};
      clock_gettime(CLOCK_MONOTONIC, &now);
      time = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }
    double stolen = NAN, time = NAN;
  };
  Moment start_;
};

}  // namespace live_stiffness
