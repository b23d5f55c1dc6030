#include "rig/pressure_program.h"

#include <cmath>
#include <random>

#include "rig/quintic_blend.h"

namespace live_stiffness {
namespace {

constexpr int kWalkLevels = 1024;
constexpr double kLargestStep = 0.5;      // of the random walk, of the amplitude
constexpr double kStairBlend = 0.2;       // of a period
constexpr int kStairSlots = 4;            // periods a channel has: three stairs and a rest

double staircase(double periods, int channel, int channels) {
  const double cycle = std::fmod(periods, static_cast<double>(kStairSlots * channels));
  const double own = cycle - kStairSlots * channel;
  if (own < 0.0 || own >= kStairSlots) return 0.0;
  const int stair = static_cast<int>(own);
  const double from = stair / 3.0;
  const double to = stair == 3 ? 0.0 : (stair + 1) / 3.0;
  return from + (to - from) * quinticBlend((own - stair) / kStairBlend);
}

double triangle(double periods, int channel, int channels) {
  const double own = periods - static_cast<double>(channel) / channels;
  if (own <= 0.0) return 0.0;
  return 1.0 - std::abs(1.0 - 2.0 * (own - std::floor(own)));
}

std::vector<double> walk(std::mt19937_64& random) {
  std::uniform_real_distribution<double> step(-kLargestStep, kLargestStep);
  std::vector<double> levels(kWalkLevels, 0.0);
  for (int k = 1; k < kWalkLevels; ++k) {
    const double level = std::abs(levels[k - 1] + step(random));  // reflected at 0, and at 1 below
    levels[k] = level > 1.0 ? 2.0 - level : level;
  }
  return levels;
}

double alongWalk(const std::vector<double>& levels, double periods) {
  const int last = kWalkLevels - 1;
  const double position = std::fmod(periods, 2.0 * last);
  const int k = static_cast<int>(position);
  const auto level = [&](int i) { return levels[i <= last ? i : 2 * last - i]; };
  return level(k) + (level(k + 1) - level(k)) * quinticBlend(position - k);
}

}  // namespace

PressureProgram::PressureProgram(int channels, const ProgramOptions& options, std::uint64_t seed)
    : channels_(channels), options_(options) {
  FaultList faults("pressure program");
  faults.check("channels", channels, {1, kMaxChannels});
  faults.checkAll(options);
  faults.throwIfAny();
  if (options.kind != "random_walk") return;
  std::mt19937_64 random(seed);
  for (int channel = 0; channel < channels; ++channel) walk_.push_back(walk(random));
}

double PressureProgram::level(int channel, double time) const {
  const double periods = time / options_.period;
  if (options_.kind == "triangle") return triangle(periods, channel, channels_);
  if (options_.kind == "staircase") return staircase(periods, channel, channels_);
  return alongWalk(walk_[channel], periods);
}

Pressures PressureProgram::at(double time) const {
  Pressures pressures = Pressures::Zero(channels_);
  if (!(time > 0.0)) return pressures;
  for (int channel = 0; channel < channels_; ++channel) pressures[channel] = options_.amplitude * level(channel, time);
  return pressures;
}

}  // namespace live_stiffness
