#pragma once
// Commanded channel pressures of the simulated rig over time.

#include <cstdint>
#include <string>
#include <vector>

#include "rig/parameters.h"

namespace live_stiffness {

struct ProgramOptions {
  // triangle: each channel up to the amplitude and down again once a period, one after the other by 1/channels.
  // staircase: one channel at a time: thirds of the amplitude, each held for a period, then one period of rest.
  // random_walk: each channel on its own: a new level every period, at most half the amplitude from the last one.
  std::string kind = kProgram.standard;
  double amplitude = kAmplitude.standard;  // highest commanded pressure, Pa gauge
  double period = kPeriod.standard;        // s

  template <class Options, class Visit>
  static void forEachParameter(Options& options, Visit&& visit) {
    visit(kProgram, options.kind);
    visit(kAmplitude, options.amplitude);
    visit(kPeriod, options.period);
  }
};

// A pure function of time: the same options give the same pressures, whatever the order of the questions. Every
// channel is zero up to time 0 and stays within 0 and the amplitude. Levels are joined by quintic blends (continuous up
// to acceleration), over 20 % of the period for the staircase and all of it for the random walk; the triangle has
// corners.
class PressureProgram {
 public:
  // channels: 1 to 1024; seed: of the random walk. Throws ConfigurationError with every fault.
  PressureProgram(int channels, const ProgramOptions& options, std::uint64_t seed);

  // Commanded gauge pressures (Pa, one per channel) at a time (s, finite).
  Pressures at(double time) const;

 private:
  double level(int channel, double time) const;  // 0 to 1

  int channels_;
  ProgramOptions options_;
  // Levels of the random walk, one vector per channel, first one zero. The walk runs through them and back again, so
  // that it has no end: with 1024 levels of 5 s it repeats after 2.8 h.
  std::vector<std::vector<double>> walk_;
};

}  // namespace live_stiffness
