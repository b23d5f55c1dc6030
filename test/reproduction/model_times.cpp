// model_times SCENE MODEL SECONDS < pressures.csv: time and error of single cold solves, for Table 7 of the paper.
// MODEL: lpcc, npcc, lcm or ncm. Columns: method, row (of the input, from 0), us (median), error.
//   library          this library as it comes (accuracy 1e-9), with compliance at tip and five stations
//   common_practice  the paper's way in C++, for ncm alone: RK4 with 50 steps, shooting on the base wrench
// Both start from nothing, as the paper's do. Processor time, SECONDS for every method and row, the methods in turn.
// Errors: the largest of pose, tangent and material compliance, relative, against a boundary value problem at 1e-12,
// which for the two piecewise constant curvature models means against another way than the closed form.

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

#include "benchmark/methods/common_practice.h"
#include "benchmark/methods/library_method.h"
#include "benchmark/scene_paths.h"
#include "benchmark/timing.h"
#include "live_stiffness/rod/scene_file.h"
#include "programs/solve_table.h"

namespace {

using namespace live_stiffness;

std::vector<Pressures> readPressures(int chambers) {
  InputTable table(std::cin, numberedColumns("p_", "_pa", chambers));
  std::vector<Pressures> rows;
  for (InputRow row; table.next(row);) {
    if (!row.fault.empty()) throw std::runtime_error("line " + std::to_string(row.line) + ": " + row.fault);
    rows.push_back(row.values);
  }
  return rows;
}

StiffnessSolution exactSolution(const Scene& scene, ModelOptions options, const Pressures& pressures) {
  // Too small to matter; only there so that something external acts.
  const bool weightless = !options.external_loads || !scene.hasWeight();
  Scene loaded = scene;
  if (weightless) loaded.gravity.reset();
  options.external_loads = true;
  options.accuracy = 1e-12;
  const StiffnessModel model(loaded, options);
  const StiffnessSolution solution =
      solveCold(model, pressures, weightless ? Wrench(Wrench::Constant(1e-16)) : Wrench(Wrench::Zero()));
  if (!solution.status.ok()) throw std::runtime_error("reference: " + model.describe(solution.status));
  return solution;
}

void measure(const std::string& scene_path, const std::string& model_name, double seconds) {
  const Scene scene = loadSceneFile(scene_path);
  FaultList faults("options");
  const ModelOptions options = namedModelOptions(model_name, "", faults);
  faults.throwIfAny();
  const std::vector<Pressures> rows = readPressures(scene.chamberCount());
  std::puts("method,row,us,error");
  for (size_t i = 0; i < rows.size(); ++i) {
    const StiffnessSolution exact = exactSolution(scene, options, rows[i]);
    const std::vector<Pressures> path{rows[i]};
    std::vector<TimedMethod> methods;
    methods.emplace_back(std::make_unique<LibraryMethod>("library", scene, options), path, true);
    if (modelName(options) == "NCM")
      methods.emplace_back(std::make_unique<CommonPractice>(scene, CommonPractice::Jacobians::kFresh), path, true);
    for (int turn = 0; turn < 3; ++turn)
      for (TimedMethod& method : methods) method.measure(seconds / 3.0);
    for (size_t k = 0; k < methods.size(); ++k) {
      const StiffnessSolution solution = methods[k].update();
      if (!solution.status.ok()) {  // the row stays, empty
        std::printf("%s,%zu,,\n", k == 0 ? "library" : "common_practice", i);
        continue;
      }
      std::printf("%s,%zu,%.4g,%.2e\n", k == 0 ? "library" : "common_practice", i,
                  quantile(methods[k].samplesUs(), 0.5), errorsOf(solution, exact, scene.length()).largest());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc == 4 ? std::atof(argv[3]) : 0.0;
  if (!(seconds > 0.0)) {
    std::cerr << "usage: model_times SCENE MODEL SECONDS < pressures.csv\n";
    return 2;
  }
  try {
    measure(argv[1], argv[2], seconds);
  } catch (const std::exception& error) {
    std::cerr << "model_times: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
