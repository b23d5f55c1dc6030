// Speed against error of one update: load stepping, statics, tip pose and tangent compliance, at pressures that move by
// 1 % from update to update. Each row reports, beside its time, the largest relative error of pose and compliance over
// the whole path, against a solution with accuracy 1e-13. Opponent in the same run: common practice.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>

#include "benchmark/common_practice.h"
#include "support/errors.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

constexpr int kUpdates = 128;

// Up and down between 0.4 and 0.75 bar in steps of 1 %, one pair (of each segment) at 60 % of the first.
std::vector<Pressures> pressurePath(int segments) {
  std::vector<Pressures> path;
  for (int i = 0; i < kUpdates; ++i) {
    const double bar = 0.4 * std::pow(1.01, std::min(i, kUpdates - i));
    path.push_back(bars(bar, {1.0, 1.0, 0.6, 0.6, 0.0, 0.0}).replicate(segments, 1));
  }
  return path;
}

struct Errors {
  double pose = 0.0, compliance = 0.0;

  void include(const Pose& X_BT, const Matrix6& C, const StiffnessSolution& exact, double length) {
    pose = std::max(pose, poseError(X_BT, exact.X_BT, length));
    compliance = std::max(compliance, complianceError(C, exact.compliance, length));
  }
  void report(benchmark::State& state) const {
    state.counters["pose_error"] = pose;
    state.counters["compliance_error"] = compliance;
  }
};

// The wrench is too small to matter, but it keeps scenes without weight out of the closed form, which would else be
// compared with itself.
std::vector<StiffnessSolution> exactSolutions(const Scene& scene, const std::vector<Pressures>& path) {
  const StiffnessModel model(scene, accurateTo(1e-13));
  std::vector<StiffnessSolution> solutions;
  for (const Pressures& pressures : path) solutions.push_back(solveCold(model, pressures, Wrench::Constant(1e-16)));
  return solutions;
}

void runModel(benchmark::State& state, const Scene& scene, double accuracy, bool warm) {
  const std::vector<Pressures> path = pressurePath(scene.segmentCount());
  const StiffnessModel model(scene, accurateTo(accuracy));
  StiffnessWorkspace workspace = model.makeWorkspace();
  const auto update = [&](int i) {
    if (!warm) workspace.reset();
    return model.solve(path[i], Wrench::Zero(), workspace);
  };
  Errors errors;
  const std::vector<StiffnessSolution> exact = exactSolutions(scene, path);
  double passes = 0.0;
  for (int i = 0; i < kUpdates; ++i) {
    const StiffnessSolution solution = update(i);
    if (!solution.status.ok()) return state.SkipWithError(model.describe(solution.status).c_str());
    errors.include(solution.X_BT, solution.compliance, exact[i], scene.length());
    passes += solution.iterations;
  }
  int i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(update(i));
    i = (i + 1) % kUpdates;
  }
  errors.report(state);
  state.counters["passes"] = passes / kUpdates;
}

void runCommonPractice(benchmark::State& state, const Scene& scene, bool warm) {
  const std::vector<Pressures> path = pressurePath(1);
  const ModelOptions options;
  CommonPractice opponent(scene);
  const auto update = [&](int i) {
    if (!warm) opponent.reset();
    const int steps = stepCount(path[i].cwiseAbs().maxCoeff(), options.pressure_step);
    const CrossSection& section = std::get<Segment>(scene.chain[0]).section;
    return opponent.solve(restState(section, path[i], options.stepping, steps));
  };
  Errors errors;
  const std::vector<StiffnessSolution> exact = exactSolutions(scene, path);
  for (int i = 0; i < kUpdates; ++i) {
    const CommonPractice::Solution solution = update(i);
    if (!solution.converged) return state.SkipWithError("common practice did not converge");
    errors.include(solution.X_BT, solution.compliance, exact[i], scene.length());
  }
  int i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(update(i));
    i = (i + 1) % kUpdates;
  }
  errors.report(state);
}

void registerAll() {
  const auto add = [](const std::string& name, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMicrosecond);
  };
  for (int segments : {1, 2}) {
    const std::string count = segments == 1 ? "one_segment" : "two_segments";
    add("closed_form/" + count, [=](benchmark::State& state) {
      runModel(state, weightlessPaperScene(segments), 1e-9, true);
    });
    for (double accuracy : {1e-6, 1e-9})
      for (bool warm : {true, false})
        add("ncm/" + count + (accuracy == 1e-6 ? "/1e-6" : "/1e-9") + (warm ? "/warm" : "/cold"),
            [=](benchmark::State& state) { runModel(state, paperScene(segments), accuracy, warm); });
  }
  for (bool warm : {true, false})
    add(std::string("common_practice/one_segment") + (warm ? "/warm" : "/cold"),
        [=](benchmark::State& state) { runCommonPractice(state, paperScene(1), warm); });
}

}  // namespace
}  // namespace live_stiffness

int main(int argc, char** argv) {
  live_stiffness::registerAll();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
  benchmark::RunSpecifiedBenchmarks();
  return EXIT_SUCCESS;
}
