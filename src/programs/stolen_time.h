#pragma once
// Processor time that a virtual machine wanted and its host gave to others: their part in the tails of latencies.

#include <unistd.h>

#include <chrono>
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
    return 1e3 * (now.stolen - start_.stolen) / std::chrono::duration<double>(now.time - start_.time).count();
  }

 private:
  struct Moment {
    // The first line of /proc/stat: cpu, then ticks since the machine started of user, nice, system, idle, iowait, irq,
    // softirq, steal.
    Moment() {
      std::ifstream file("/proc/stat");
      std::string name;
      double ticks = NAN;
      file >> name;
      for (int column = 0; column < 8; ++column) file >> ticks;
      if (file) stolen = ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
    }
    std::chrono::steady_clock::time_point time = std::chrono::steady_clock::now();
    double stolen = NAN;  // s
  };
  Moment start_;
};

}  // namespace live_stiffness
