// stiffness_map SCENE.yaml [options]: stiffness over the workspace as a table, or the stiffest pressures for a point.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <limits>
#include <optional>

#include "command_line.h"
#include "csv_table.h"
#include "analysis/stiffness_finder.h"
#include "map_table.h"
#include "parameter_options.h"
#include "progress_bar.h"
#include "scene_doubts.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

struct Arguments {
  std::string scene, model, stepping, criterion = "largest_eigenstiffness", compliance = "tangent", output = "-";
  std::string channel_of_chamber, find, direction = "x", at;
  std::vector<std::string> pressures;
  double accuracy = 1e-6, max_bar = 1.0, tolerance_mm = 0.1;
  long random = 0;
  std::uint64_t seed = 1;
  int channels = 0, threads = 0, starts = 24;
};

// Of --pressures; faults are added.
std::vector<PressureRange> readRanges(const Arguments& arguments, FaultList& faults) {
  std::vector<PressureRange> ranges;
  const bool needs_count = arguments.random == 0;
  for (const std::string& text : arguments.pressures) {
    const std::vector<double> numbers = numberList(text, ':').value_or(std::vector<double>());
    const double count = numbers.size() == 3 ? numbers[2] : 1.0;
    if ((numbers.size() == 3 || (numbers.size() == 2 && !needs_count)) && count >= 1.0 && count <= 1e9 &&
        count == std::floor(count))
      ranges.push_back({numbers[0], numbers[1], static_cast<long>(count)});
    else
      faults.add("pressures = " + text + ": must be FROM:TO:COUNT, gauge pressures in Pa and a whole number from 1 to 1e9" +
                 (needs_count ? "" : "; with --random FROM:TO will do") + ", for example 0:1e5:21");
  }
  return ranges;
}

// Of --channel-of-chamber or --channels. Throws ConfigurationError.
ChannelMap readChannels(const Arguments& arguments, int chambers) {
  if (arguments.channel_of_chamber.empty())
    return ChannelMap::even(arguments.channels > 0 ? arguments.channels : chambers, chambers);
  std::vector<int> channels;
  for (double number : numberList(arguments.channel_of_chamber, ',').value_or(std::vector<double>{-1.0})) {
    if (!(number >= 0.0 && number < kMaxChannels && number == std::floor(number)))
      throw ConfigurationError("options", {"channel-of-chamber = " + arguments.channel_of_chamber +
                                           ": must be the channel of each chamber from 0, for example 0,0,1,1,2,2"});
    channels.push_back(static_cast<int>(number));
  }
  return ChannelMap(channels);
}

int sweep(const StiffnessModel& model, const ChannelMap& channels, const Arguments& arguments) {
  FaultList faults("options");
  const std::vector<PressureRange> ranges = readRanges(arguments, faults);
  const StiffnessCriterion criterion = criterionNamed(arguments.criterion, faults);
  if (arguments.compliance != "tangent" && arguments.compliance != "material")
    faults.add("compliance = " + arguments.compliance + ": must be tangent or material");
  faults.throwIfAny();
  const PressurePlan plan = arguments.random > 0
                                ? PressurePlan::sample(ranges, channels, arguments.random, arguments.seed)
                                : PressurePlan::grid(ranges, channels);
  MapTable table(arguments.output, plan, criterion);
  ProgressBar bar("stiffness_map", plan.rows());
  long failed = 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::clock_t writing = 0;
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const std::clock_t start_cpu = std::clock();
  const ComplianceKind kind = arguments.compliance == "tangent" ? ComplianceKind::kTangent : ComplianceKind::kMaterial;
  sweepStiffness(
      model, plan, criterion, kind,
      [&](long first, const std::vector<SweepRow>& rows) {
        for (const SweepRow& row : rows) {
          if (row.code != SolveCode::kOk) {
            ++failed;
            continue;
          }
          least = std::min(least, row.tau);
          most = std::max(most, row.tau);
        }
        const std::clock_t before = std::clock();
        table.write(first, rows);
        writing += std::clock() - before;
        bar.update(first + static_cast<long>(rows.size()));
      },
      arguments.threads);
  table.close();
  const double total_s = std::chrono::duration<double>(Clock::now() - start).count();
  // Processor time, all threads together: it does not count what else the machine does.
  const double us_per_row = 1e6 / CLOCKS_PER_SEC / static_cast<double>(plan.rows());
  std::fprintf(stderr,
               "%ld configurations, %ld without result, in %.2f s; on one core %.2f us each to solve and analyse and "
               "%.2f us to write\n",
               plan.rows(), failed, total_s, us_per_row * static_cast<double>(std::clock() - start_cpu - writing),
               us_per_row * static_cast<double>(writing));
  if (failed < plan.rows())
    std::fprintf(stderr, "%s from %.6g to %.6g %s\n", criterion.name().c_str(), least, most, criterion.unit());
  return kExitOk;
}

void printFound(const char* title, const FoundPressures& found) {
  std::printf("%s:\n  pressures_pa:", title);
  for (int k = 0; k < found.channels.size(); ++k) std::printf("%s%.6g", k == 0 ? " [" : ", ", found.channels[k]);
  const Vector3& p = found.X_BT.p;
  std::printf("]\n  reached_m: [%.9g, %.9g, %.9g]\n  miss_mm: %.3g\n  stiffness_n_per_m: %.6g\n", p.x(), p.y(), p.z(),
              1e3 * found.miss, found.stiffness);
}

int find(const StiffnessModel& model, const ChannelMap& channels, const Arguments& arguments) {
  FaultList faults("options");
  if (arguments.find != "stiffest" && arguments.find != "softest")
    faults.add("find = " + arguments.find + ": must be stiffest or softest");
  const Vector3 direction = directionNamed("direction", arguments.direction, faults);
  const std::optional<std::vector<double>> at = numberList(arguments.at, ',');
  if (!at || at->size() != 3)
    faults.add("at = " + (arguments.at.empty() ? "(missing)" : arguments.at) +
               ": must be a point x,y,z in m, base axes");
  faults.throwIfAny();
  FinderOptions options;
  options.max_pressure = 1e5 * arguments.max_bar;
  options.tolerance = 1e-3 * arguments.tolerance_mm;
  options.starts = arguments.starts;
  options.seed = arguments.seed;
  const FinderResult result = findPressures(model, channels, Eigen::Map<const Vector3>(at->data()), direction, options);
  if (!result.solvable) {
    std::puts("reached: false  # no configuration within the pressures has a stable equilibrium");
    return kExitPartly;
  }
  if (!result.reached) {
    std::printf("reached: false  # out of reach within 0 to %g bar, as far as %d starts tell; nearest found below\n",
                arguments.max_bar, options.starts + 1);
    printFound("nearest", result.nearest);
    return kExitPartly;
  }
  const bool stiffest = arguments.find == "stiffest";
  std::printf("reached: true\n");
  printFound(stiffest ? "stiffest" : "softest", stiffest ? result.stiffest : result.softest);
  printFound(stiffest ? "softest" : "stiffest", stiffest ? result.softest : result.stiffest);
  std::printf("stiffest_over_softest: %.6g\nsolves: %ld\n", result.stiffest.stiffness / result.softest.stiffness,
              result.solves);
  return kExitOk;
}

const char kHelp[] =
    "stiffness_map SCENE.yaml --pressures FROM:TO:COUNT [options] > map.csv\n"
    "stiffness_map SCENE.yaml --pressures FROM:TO --random N [--seed S] [options] > map.csv\n"
    "stiffness_map SCENE.yaml --find stiffest|softest --direction x|y|z|dx,dy,dz --at x,y,z [options]\n\n"
    "The first two solve every configuration on all cores, without wrench at the tip, and write\n"
    "  p_1_pa..p_N_pa  gauge pressure of every chamber, base to tip, as stiffness_solve takes them\n"
    "  status          ok, or why there is no result (the columns after it are then empty)\n"
    "  x_m..qz         tip pose in the base\n"
    "  eta_1_n..6      eigenstiffnesses (21): the positive ones, largest first, then the negative ones\n"
    "  tau_n           the criterion (22); tau_n_per_m where that is its unit\n"
    "The third prints, as YAML, the channel pressures that reach a point with the largest and with the smallest\n"
    "stiffness along a direction (force over displacement, everything else free, tangent).\n"
    "--find steps continuously unless told otherwise, since the number of fixed steps jumps with pressure, and with an\n"
    "accuracy of 1e-10 or better.\n"
    "Exit status: 0 done, 1 the point is out of reach, 2 nothing could be done.\n\n";

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  po::options_description options = helpOption();
  options.add_options()
    ("pressures", po::value(&a.pressures)->composing(),
     "FROM:TO:COUNT, gauge Pa, both ends included; once for all channels, or again for each")
    ("random", po::value(&a.random), "this number of random configurations within the ranges of --pressures, instead of a grid")
    ("seed", po::value(&a.seed)->default_value(a.seed), "of the random numbers")
    ("channels", po::value(&a.channels),
     "channels that feed neighbouring chambers, 3 for the paper's pairs; default: one for each chamber")
    ("channel-of-chamber", po::value(&a.channel_of_chamber), "the channel of each chamber from 0, such as 0,0,1,1,2,2")
    ("criterion", po::value(&a.criterion)->default_value(a.criterion),
     "tau: largest_eigenstiffness, smallest_eigenstiffness, trace, largest_stiffness, smallest_stiffness, "
     "directional:D (all else free) or constrained:D (all else held), D = x, y, z or dx,dy,dz")
    ("compliance", po::value(&a.compliance)->default_value(a.compliance), "tangent (felt by a hand) or material (the "
                                                                          "paper's integral)")
    ("output,o", po::value(&a.output)->default_value(a.output), "CSV file; - is standard output")
    ("threads", po::value(&a.threads)->default_value(a.threads), "0: all cores")
    ("find", po::value(&a.find), "stiffest or softest")
    ("direction", po::value(&a.direction)->default_value(a.direction), "of --find, base axes")
    ("at", po::value(&a.at), "tip position of --find, m, base axes")
    ("max-bar", po::value(&a.max_bar)->default_value(a.max_bar), "largest pressure of --find; the smallest is 0")
    ("tolerance-mm", po::value(&a.tolerance_mm)->default_value(a.tolerance_mm, "0.1"), "largest miss of --find")
    ("starts", po::value(&a.starts)->default_value(a.starts), "random starts of --find")
    ("scene", po::value(&a.scene)->required(), "scene file");
  addOption(options, kModel, a.model);
  addOption(options, kStepping, a.stepping);
  addOption(options, kAccuracy, a.accuracy);
  return runProgram({argv, argv + argc}, kHelp, options, {{"scene", 1}}, [&](const po::variables_map& values) {
    FaultList faults("options");
    const bool finds = values.count("find") > 0;
    if (finds == (values.count("pressures") > 0)) faults.add("give either --pressures or --find");
    if (values.count("random")) faults.check("random", static_cast<double>(a.random), {1.0, 1e9});
    if (values.count("channels")) faults.check("channels", a.channels, {1, kMaxChannels});
    if (values.count("channels") && values.count("channel-of-chamber"))
      faults.add("give either --channels or --channel-of-chamber");
    faults.check("threads", a.threads, {0.0, 1024.0});
    faults.check("max-bar", a.max_bar, {0.0, 100.0, true});
    if (finds && a.stepping.empty() && a.model != "lcm" && a.model != "lpcc") a.stepping = "continuous";
    ModelOptions model_options = namedModelOptions(a.model, a.stepping, faults);
    faults.throwIfAny();
    model_options.accuracy = finds ? std::min(a.accuracy, 1e-10) : a.accuracy;
    const StiffnessModel model(loadSceneWithDoubts(a.scene), model_options);
    const ChannelMap channels = readChannels(a, model.scene().chamberCount());
    return finds ? find(model, channels, a) : sweep(model, channels, a);
  });
}
