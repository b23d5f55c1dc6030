// The hard cases of the tests as tables: FOLDER/hard_cases.csv has a row for each named case, FOLDER/random_draws.csv
// one for each class of random draws.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "hard_cases/hard_case.h"
#include "programs/progress_bar.h"
#include "support/hard_draws.h"

namespace live_stiffness {
namespace {

std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  return '"' + text + '"';
}

bool writeHardCases(std::ostream& out) {
  out << "case,class,status,error,estimate,iterations,time_us,ok,note\n";
  const std::vector<HardTheme> themes = hardThemes();
  long total = 0, done = 0;
  for (const HardTheme& theme : themes) total += static_cast<long>(theme.cases.size());
  ProgressBar progress("hard cases", total);
  for (const HardTheme& theme : themes)
    for (const HardCase& c : theme.cases) {
      HardOutcome outcome;
      c.run(outcome);
      out << c.name << "," << theme.name << "," << codeName(outcome.worstCode()) << "," << outcome.worstError() << ","
          << outcome.largestEstimate() << "," << outcome.mostIterations() << "," << outcome.longestTimeUs() << ","
          << outcome.ok() << "," << quoted(outcome.ok() ? c.truth : outcome.faults()) << "\n";
      progress.update(++done);
    }
  return static_cast<bool>(out.flush());
}

struct DrawRow {
  long draws = 0, codes[5] = {}, inaccurate = 0, dishonest = 0;
  double max_error = 0.0;
  int max_iterations = 0;

  void add(const DrawOutcome& outcome, double accuracy) {
    ++draws;
    ++codes[static_cast<int>(outcome.code)];
    const bool ok = outcome.code == SolveCode::kOk;
    inaccurate += ok && !outcome.isAccurate(accuracy);
    dishonest += !outcome.isHonest(accuracy);
    if (ok && !outcome.reference_failed && !outcome.other_branch) max_error = std::max(max_error, outcome.error);
    max_iterations = std::max(max_iterations, outcome.iterations);
  }
};

bool writeRandomDraws(std::ostream& out, long draws) {
  out << "class,draws,ok,out_of_range,not_converged,unstable,invalid_input,inaccurate,max_error,max_iterations\n";
  ProgressBar progress("random draws", draws);
  long done = 0, dishonest = 0;
  for (const HardDrawClass& c : hardDrawClasses()) {
    DrawRow row;
    const long share = (draws * c.weight + totalHardDrawWeight() - 1) / totalHardDrawWeight();
    for (long i = 0; i < share; ++i) {
      const HardDraw draw = hardDraw(c.name, static_cast<unsigned long>(i));
      row.add(runHardDraw(draw), draw.options.accuracy);
      progress.update(++done);
    }
    const auto count = [&](SolveCode code) { return row.codes[static_cast<int>(code)]; };
    out << c.name << "," << row.draws << "," << count(SolveCode::kOk) << "," << count(SolveCode::kOutOfRange) << ","
        << count(SolveCode::kNotConverged) << "," << count(SolveCode::kUnstable) << ","
        << count(SolveCode::kInvalidInput) << "," << row.inaccurate << "," << row.max_error << ","
        << row.max_iterations << "\n";
    dishonest += row.dishonest;
  }
  progress.update(draws);
  if (dishonest > 0) std::cerr << "draws neither accurate nor with an honest status: " << dishonest << "\n";
  return static_cast<bool>(out.flush());
}

int run(const std::string& folder, long draws) {
  std::ofstream cases(folder + "/hard_cases.csv"), random(folder + "/random_draws.csv");
  if (!cases || !random) {
    std::cerr << "hard_cases_report: cannot write to " << folder << "\n";
    return 1;
  }
  return writeHardCases(cases) && writeRandomDraws(random, draws) ? 0 : 1;
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  const bool has_draws = argc == 4 && std::string(argv[2]) == "--draws";
  const long draws = has_draws ? std::strtol(argv[3], nullptr, 10) : 1000000;
  if ((argc != 2 && !has_draws) || draws < 0) {
    std::cerr << "usage: hard_cases_report FOLDER [--draws N]   (default 1000000, which takes a quarter of an hour)\n";
    return 2;
  }
  return live_stiffness::run(argv[1], draws);
}
