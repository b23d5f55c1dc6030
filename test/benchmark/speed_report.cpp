// speed_report FOLDER [--quick]: measures speed against error of the library and its opponents, and writes the figures
// to CSV files in FOLDER, which must exist. scripts/report makes docs/speed_against_error.md of them.
//
//   methods.csv        every method, one and two segments, with and without gravity, cold and warm
//   stations.csv       the library with 5 and 25 stations of material compliance
//   distribution.csv   histograms of single warm updates (accuracy 1e-6) and of one again and again;
//                      distribution_summary.csv: quantiles
//   estimates.csv      error estimate against true error over random scenes; estimate_summary.csv: shares
//   build.csv          compiler and flags

#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>

#include "benchmark/csv_file.h"
#include "benchmark/estimate_check.h"
#include "benchmark/methods/library_method.h"
#include "benchmark/methods/method_list.h"
#include "benchmark/scene_paths.h"
#include "benchmark/timing.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

struct Effort {
  int rounds = 10;
  double slice = 0.04;  // s per method and round
  int distribution_updates = 1000000;
  int random_scenes = 10000;
};

void progress(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }

// Errors over a path: median and maximum of each.
struct PathErrors {
  SolutionErrors median, maximum;
};

PathErrors errorsAlong(TimedMethod& timed, const std::vector<StiffnessSolution>& exact, double length) {
  std::vector<float> pose, tangent, material;
  for (const StiffnessSolution& expected : exact) {
    const SolutionErrors errors = errorsOf(timed.update(), expected, length);
    pose.push_back(errors.pose);
    tangent.push_back(errors.tangent);
    material.push_back(errors.material);
  }
  const auto at = [&](double share) {
    return SolutionErrors{quantile(pose, share), quantile(tangent, share), quantile(material, share)};
  };
  return {at(0.5), at(1.0)};
}

void measureInTurns(std::vector<TimedMethod>& methods, const Effort& effort) {
  for (int round = 0; round < effort.rounds; ++round)
    for (TimedMethod& timed : methods) timed.measure(effort.slice);
}

void reportMethods(const std::string& folder, const Effort& effort) {
  CsvFile csv(folder, "methods.csv",
              "family,variant,resolution,segments,gravity,start,converged,median_us,p90_us,p99_us,samples,batch,"
              "pose_max,tangent_max,material_max,pose_median,tangent_median,material_median,times_common_practice");
  const std::vector<MethodEntry> entries = methodList();
  for (int segments : {1, 2})
    for (bool gravity : {true, false})
      for (bool cold : {false, true}) {
        const Scene scene = gravity ? paperScene(segments) : weightlessPaperScene(segments);
        progress("methods: " + std::to_string(segments) + (segments == 1 ? " segment" : " segments") +
                 (gravity ? " with gravity, " : " without gravity, ") + (cold ? "cold" : "warm"));
        const std::vector<Pressures> path = pressurePath(segments);
        const std::vector<StiffnessSolution> exact = exactSolutions(scene, path);
        std::vector<TimedMethod> methods;
        std::vector<PathErrors> errors;
        for (const MethodEntry& entry : entries) {
          methods.emplace_back(entry.make(scene), path, cold);
          errors.push_back(errorsAlong(methods.back(), exact, scene.length()));
        }
        measureInTurns(methods, effort);
        double common_practice_us = std::nan("");
        for (size_t k = 0; k < entries.size(); ++k)
          if (entries[k].family == "common practice") common_practice_us = quantile(methods[k].samplesUs(), 0.5);
        for (size_t k = 0; k < entries.size(); ++k) {
          std::vector<float>& us = methods[k].samplesUs();
          const auto& [median, maximum] = errors[k];
          csv.row(entries[k].family, entries[k].variant, entries[k].resolution, segments, int(gravity),
                  cold ? "cold" : "warm", int(methods[k].converged()), quantile(us, 0.5), quantile(us, 0.9),
                  quantile(us, 0.99), us.size(), methods[k].batch(), maximum.pose, maximum.tangent, maximum.material,
                  median.pose, median.tangent, median.material, common_practice_us / quantile(us, 0.5));
        }
      }
}

void reportStations(const std::string& folder, const Effort& effort) {
  progress("stations");
  CsvFile csv(folder, "stations.csv", "accuracy,stations,median_us");
  const Scene scene = paperScene(1);
  const std::vector<Pressures> path = pressurePath(1);
  std::vector<std::pair<double, int>> variants;
  std::vector<TimedMethod> methods;
  for (double accuracy : {1e-3, 1e-6, 1e-9})
    for (int stations : {5, 25}) {
      variants.emplace_back(accuracy, stations);
      methods.emplace_back(std::make_unique<LibraryMethod>("library", scene, accurateTo(accuracy), stations), path,
                           false);
    }
  measureInTurns(methods, effort);
  for (size_t k = 0; k < methods.size(); ++k)
    csv.row(variants[k].first, variants[k].second, quantile(methods[k].samplesUs(), 0.5));
}

void writeQuantiles(CsvFile& csv, const std::string& which, std::vector<float>& us, long preempted) {
  const double median = quantile(us, 0.5), p99 = quantile(us, 0.99), p999 = quantile(us, 0.999);
  csv.row(which, us.size(), preempted, median, quantile(us, 0.9), p99, p999, quantile(us, 1.0), p99 / median,
          p999 / median);
}

// Times of single calls, us. They come in blocks of 50; blocks in which the kernel took the processor away are left out
// of `undisturbed`.
struct SingleTimes {
  std::vector<float> all, undisturbed;
  long preempted = 0;
};

// One clock reading a call: its 45 ns are part of every time.
template <class Work>
SingleTimes timeOneByOne(const std::string& what, int count, Work work) {
  constexpr int kBlock = 50;
  SingleTimes times;
  times.all.reserve(count);
  times.undisturbed.reserve(count);
  const int blocks = count / kBlock;
  for (int block = 0; block < blocks; ++block) {
    if (block % (blocks / 5) == 0) progress(what + ": " + std::to_string(block * kBlock));
    const long preempted = preemptions();
    double before = clockSeconds();
    for (int i = 0; i < kBlock; ++i) {
      work();
      const double after = clockSeconds();
      times.all.push_back(static_cast<float>(1e6 * (after - before)));
      before = after;
    }
    const long taken_away = preemptions() - preempted;
    times.preempted += taken_away;
    if (taken_away == 0)
      times.undisturbed.insert(times.undisturbed.end(), times.all.end() - kBlock, times.all.end());
  }
  return times;
}

void writeBins(CsvFile& csv, const std::string& which, const std::vector<float>& us) {
  constexpr double kBinsPerDecade = 50.0;
  std::map<int, long> bins;
  for (float time : us) ++bins[static_cast<int>(std::floor(kBinsPerDecade * std::log10(time)))];
  for (const auto& [bin, count] : bins)
    csv.row(which, std::pow(10.0, bin / kBinsPerDecade), std::pow(10.0, (bin + 1) / kBinsPerDecade), count);
}

// Of each update of a closed path, its median over the rounds: what it takes without what the machine is at besides.
std::vector<float> mediansOfRounds(const std::vector<float>& times, size_t updates) {
  std::vector<float> medians;
  for (size_t i = 0; i < updates; ++i) {
    std::vector<float> rounds;
    for (size_t k = i; k < times.size(); k += updates) rounds.push_back(times[k]);
    medians.push_back(static_cast<float>(quantile(rounds, 0.5)));
  }
  return medians;
}

// Beside the updates the step between two pressures, to and fro: always the same work, so that its tail is the machine's
// and not the solver's. (A loop that waits for itself would not do: it hardly feels what else the processor's core is at.)
void reportDistribution(const std::string& folder, const Effort& effort) {
  const std::vector<Pressures> walk = pressureWalk(), path = pressurePath(1), step = {path[20], path[21]};
  const auto timesAlong = [&](const std::string& what, const std::vector<Pressures>& pressures) {
    TimedMethod timed(std::make_unique<LibraryMethod>("library", paperScene(1), accurateTo(1e-6)), pressures, false);
    for (size_t i = 0; i < walk.size(); ++i) timed.update();
    return timeOneByOne(what, effort.distribution_updates, [&] { timed.update(); });
  };
  SingleTimes updates = timesAlong("single updates", walk), repeats = timesAlong("the same update", step);
  std::vector<float> medians = mediansOfRounds(updates.all, walk.size());

  CsvFile csv(folder, "distribution.csv", "which,from_us,to_us,count");
  writeBins(csv, "updates", updates.all);
  writeBins(csv, "repeats", repeats.all);
  CsvFile summary(folder, "distribution_summary.csv",
                  "which,updates,preemptions,median_us,p90_us,p99_us,p999_us,max_us,p99_over_median,p999_over_median");
  writeQuantiles(summary, "updates", updates.all, updates.preempted);
  writeQuantiles(summary, "updates not preempted", updates.undisturbed, 0);
  writeQuantiles(summary, "updates by their medians", medians, 0);
  writeQuantiles(summary, "repeats", repeats.all, repeats.preempted);
  writeQuantiles(summary, "repeats not preempted", repeats.undisturbed, 0);
}

void reportEstimates(const std::string& folder, const Effort& effort) {
  CsvFile csv(folder, "estimates.csv", "segments,loaded,requested,estimate,error,status,reference_status");
  int done = 0;
  const EstimateShares shares = checkEstimates(1, effort.random_scenes, [&](const EstimateCase& one) {
    if (done++ % (effort.random_scenes / 5) == 0) progress("random scenes: " + std::to_string(done - 1));
    csv.row(one.segments, int(one.loaded), one.requested, one.estimate, one.error, codeName(one.code),
            codeName(one.reference));
  });
  CsvFile summary(folder, "estimate_summary.csv",
                  "cases,solved,loaded,out_of_range,not_converged,unstable,status_differs,within_ten_estimates_share,"
                  "within_requested_share,worst_ratio,reference");
  summary.row(shares.cases, shares.solved, shares.loaded, shares.of_code[2], shares.of_code[3], shares.of_code[4],
              shares.status_differs, shares.tenEstimatesShare(), shares.requestedShare(), shares.worst_ratio,
              EstimateCase::kReference);
}

void run(const std::string& folder, const Effort& effort) {
  CsvFile(folder, "build.csv", "compiler;flags").row("g++ " __VERSION__ ";" CXX_FLAGS);
  reportDistribution(folder, effort);
  reportMethods(folder, effort);
  reportStations(folder, effort);
  reportEstimates(folder, effort);
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  const bool quick = argc == 3 && std::strcmp(argv[2], "--quick") == 0;
  if (argc < 2 || (argc > 2 && !quick)) {
    std::fprintf(stderr, "usage: speed_report FOLDER [--quick]\n");
    return 2;
  }
  live_stiffness::Effort effort;
  if (quick) effort = {2, 0.008, 50000, 1000};
  try {
    live_stiffness::run(argv[1], effort);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "speed_report: %s\n", error.what());
    return 1;
  }
  return 0;
}
