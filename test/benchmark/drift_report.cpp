// Drift over 1e5 random pressure cycles that end at zero: the product's load stepping, which starts every path at zero
// pressure, against the accumulating policy (13), for three increments. Writes FOLDER/drift.csv.

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "support/accumulated_rest_state.h"
#include "programs/progress_bar.h"
#include "support/pressure_cycles.h"
#include "support/scenes.h"
#include "support/rest_state.h"

namespace live_stiffness {
namespace {

constexpr long kCycles = 100000;
constexpr double kThresholds[] = {1e3, 5e3, 15e3};  // Pa
constexpr double kHighest = 1.2e5;                  // Pa

// How far a rest state is from the straight, unstretched segment: tip by closed form, no external load.
struct Drift {
  double tip, curvature;

  Drift(const RestState& state, double length)
      : tip((expSe3(Vector3::UnitZ(), state.curvature, state.stretch * length).p - length * Vector3::UnitZ()).norm()),
        curvature(state.curvature.norm()) {}
};

// The next of 1, 2, 5, 10, 20, ...
long nextSample(long cycle) {
  long decade = 1;
  while (10 * decade <= cycle) decade *= 10;
  return cycle < 2 * decade ? 2 * decade : cycle < 5 * decade ? 5 * decade : 10 * decade;
}

int run(const std::string& folder) {
  std::ofstream file(folder + "/drift.csv");
  if (!file) {
    std::cerr << "drift_report: cannot write " << folder << "/drift.csv\n";
    return 1;
  }
  file << "policy,threshold_pa,cycle,tip_drift_m,curvature_drift_per_m\n";
  Scene scene = paperScene(1);
  const Segment& segment = segmentOf(scene, 0);
  const int chambers = segment.section.chambers.count();
  ProgressBar progress("drift", kCycles * 3);
  long done = 0, refused = 0;
  for (double threshold : kThresholds) {
    AccumulatedRestState accumulated(segment.section);
    RandomSource random(90);
    long sample = 1;
    for (long cycle = 1; cycle <= kCycles; ++cycle) {
      Pressures last;
      pressureCycle(random, chambers, kHighest, threshold, [&](const Pressures& pressures) {
        refused += !accumulated.advanceTo(pressures);
        last = pressures;
      });
      if (cycle == sample) {
        const auto write = [&](const char* policy, const RestState& state) {
          const Drift drift(state, segment.length);
          file << policy << "," << threshold << "," << cycle << "," << drift.tip << "," << drift.curvature << "\n";
        };
        const int steps = stepCount(last.cwiseAbs().maxCoeff(), threshold);
        write("fixed_step", restState(segment.section, last, Stepping::kFixedStep, steps));
        write("continuous", restState(segment.section, last, Stepping::kContinuous, 0));
        write("accumulated", accumulated.state());
        sample = nextSample(sample);
      }
      progress.update(++done);
    }
  }
  if (refused > 0) std::cerr << "increments refused, out of the section's range: " << refused << "\n";
  return file.flush() ? 0 : 1;
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: drift_report FOLDER\n";
    return 2;
  }
  return live_stiffness::run(argv[1]);
}
