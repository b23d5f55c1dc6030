// chain_report FOLDER [--quick]: the cost of an update against the number of segments, of the library and of two others, into
// FOLDER/chains.csv. Under two minutes of processor time.
//
// Chains of paper_one_segment.yaml without links, with its tip mass.
//   hanging   any number of them is stable. Pressures to 0.6 bar.
//   standing  with as much of gravity as is half of what buckles the straight chain, at most all of it. Pressures to 0.2 bar.
// warm: a slow closed path of pressures, each pair on a sine of its own phase, reached from none in 50 steps; cold: random
// pressures, nothing known.
// Every update is timed by itself, by the processor's time less that of reading the clock. Of several rounds each update counts
// with its median: what the solver needs, without what the machine is at besides.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>

#include "benchmark/csv_file.h"
#include "benchmark/methods/common_practice.h"
#include "benchmark/methods/energy_minimum.h"
#include "benchmark/methods/library_method.h"
#include "benchmark/scene_paths.h"
#include "benchmark/timing.h"
#include "programs/progress_bar.h"
#include "support/random_source.h"

namespace live_stiffness {
namespace {

constexpr int kCounts[] = {1, 2, 4, 8, 16, 32};
constexpr double kAccuracy = 1e-6, kExact = 1e-11;
constexpr double kSolved = 0.02;  // error up to which a result is the equilibrium and not another one

struct Posture {
  const char* name;
  double up;        // direction of gravity along z
  double pressure;  // largest, Pa
};
constexpr Posture kPostures[] = {{"hanging", 1.0, 0.6e5}, {"standing", -1.0, 0.2e5}};

struct Effort {
  int updates = 256, rounds = 5;
  double seconds = 1.0;  // processor time of a method on a chain, at most
};

// Gravity under which weight and tip mass, each over what buckles the chain alone, add up to a half (Dunkerley).
double standingGravity(const Scene& scene) {
  const CrossSection& section = std::get<Segment>(scene.chain.front()).section;
  const RestState rest = LoadStepper(section).restState(Pressures::Zero(section.chambers.count()), Stepping::kLinear, 1);
  const double c = rest.c.bending_torsion(0, 0), L = scene.length();
  return 0.5 / (c * L * L * (section.linearDensity() * L / 7.837 + 4.0 * scene.tip_mass / (kPi * kPi)));
}

Scene chainOf(int segments, const Posture& posture) {
  Scene scene = paperScene(1);
  scene.chain.assign(segments, scene.chain.front());
  const double g = posture.up > 0.0 ? kStandardGravity : std::min(kStandardGravity, standingGravity(scene));
  scene.gravity = posture.up * g * Vector3::UnitZ();
  return scene;
}

std::vector<Pressures> pressuresOf(int segments, const Posture& posture, bool cold, int updates) {
  RandomSource random(28);
  std::vector<Pressures> rows;
  const Pressures phases = random.pairs(6 * segments, 0.0, 2.0 * kPi);
  for (int i = 0; i < updates; ++i) {
    const double turn = 2.0 * kPi * i / updates;
    rows.push_back(cold ? random.pairs(6 * segments, 0.0, posture.pressure)
                        : Pressures(0.5 * posture.pressure * (1.0 + (phases.array() + turn).sin())));
  }
  return rows;
}

// The least time between two readings, s.
double clockCost() {
  double least = 1.0;
  for (int i = 0; i < 1000; ++i) {
    const double before = processorSeconds();
    least = std::min(least, processorSeconds() - before);
  }
  return least;
}

struct Measured {
  std::vector<float> us, errors;  // of the updates that are solved
  int tried = 0;
};

Measured measure(StiffnessMethod& method, const std::vector<Pressures>& rows, const std::vector<StiffnessSolution>& exact,
                 double length, bool cold, const Effort& effort) {
  static const double clock = clockCost();
  Measured result;
  std::vector<std::vector<float>> times(rows.size());
  std::vector<double> errors(rows.size(), 1e300);
  // Step by step to the path, for those who find nothing from far away.
  constexpr int kSteps = 50;
  for (int step = 0; step <= kSteps && !cold; ++step)
    if (!method.solve(static_cast<double>(step) / kSteps * rows.back()).status.ok()) break;
  const double start = processorSeconds();
  const auto is_over = [&] { return processorSeconds() - start > effort.seconds; };  // the update that runs is the last
  for (int round = 0; round < effort.rounds && !(round > 0 && is_over()); ++round) {
    for (size_t i = 0; i < rows.size() && !(i > 0 && is_over()); ++i) {
      if (cold) method.reset();
      const double before = processorSeconds();
      const StiffnessSolution solution = method.solve(rows[i]);
      times[i].push_back(static_cast<float>(1e6 * (processorSeconds() - before - clock)));
      const SolutionErrors error = errorsOf(solution, exact[i], length);
      errors[i] = solution.status.ok() ? std::max(error.pose, error.tangent) : 1e300;
    }
  }
  for (size_t i = 0; i < rows.size() && !times[i].empty(); ++i) {
    ++result.tried;
    if (!(errors[i] < kSolved)) continue;
    result.us.push_back(static_cast<float>(quantile(times[i], 0.5)));
    result.errors.push_back(static_cast<float>(errors[i]));
  }
  return result;
}

struct Entry {
  const char* name;
  std::function<std::unique_ptr<StiffnessMethod>(const Scene&)> make;
};

std::vector<Entry> entries() {
  return {{"library",
           [](const Scene& s) { return std::make_unique<LibraryMethod>("library", s, accurateTo(kAccuracy)); }},
          {"energy minimiser", [](const Scene& s) { return std::make_unique<EnergyMinimum>(s, 8); }},
          {"optimised (Till)", [](const Scene& s) {
             return std::make_unique<CommonPractice>(s, CommonPractice::Jacobians::kDamped, 20);
           }}};
}

void run(const std::string& folder, const Effort& effort) {
  CsvFile csv(folder, "chains.csv",
              "posture,start,segments,gravity,method,tried,solved,accurate,median_us,p99_us,max_us,"
              "error_max");
  ProgressBar progress("chains", 2 * 2 * std::size(kCounts) * entries().size());
  long done = 0;
  for (const Posture& posture : kPostures)
    for (const int segments : kCounts)
      for (const bool cold : {false, true}) {
        const Scene scene = chainOf(segments, posture);
        const std::vector<Pressures> rows = pressuresOf(segments, posture, cold, effort.updates);
        const std::vector<StiffnessSolution> exact = exactSolutions(scene, rows, kExact);
        for (const Entry& entry : entries()) {
          Measured m = measure(*entry.make(scene), rows, exact, scene.length(), cold, effort);
          const auto accurate = std::count_if(m.errors.begin(), m.errors.end(), [](float e) { return e <= kAccuracy; });
          csv.row(posture.name, cold ? "cold" : "warm", segments, scene.gravity->norm(), entry.name, m.tried, m.us.size(),
                  accurate, quantile(m.us, 0.5), quantile(m.us, 0.99), quantile(m.us, 1.0), quantile(m.errors, 1.0));
          progress.update(++done);
        }
      }
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  const bool quick = argc == 3 && std::strcmp(argv[2], "--quick") == 0;
  if (argc != 2 && !quick) {
    std::fprintf(stderr, "usage: chain_report FOLDER [--quick]\n");
    return 2;
  }
  live_stiffness::Effort effort;
  if (quick) effort = {64, 3, 0.05};
  try {
    live_stiffness::run(argv[1], effort);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "chain_report: %s\n", error.what());
    return 1;
  }
  return 0;
}
