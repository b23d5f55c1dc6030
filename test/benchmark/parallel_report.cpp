// parallel_report [SECONDS]: updates a second of the Stewart-Gough robot, six rods with compliance, against the error
// of the same updates. One row for each configuration of Fig. 18, way of solving and accuracy; processor time.

#include <cstdio>
#include <cstdlib>

#include "benchmark/timing.h"
#include "parallel/parallel_cases.h"
#include "parallel/parallel_statics.h"
#include "support/errors.h"

using namespace live_stiffness;

namespace {

constexpr int kSamples = 600;      // on a closed path
constexpr double kSwing = 1e-3;    // of every length, m, each with its phase: 10 um an update, 0.1 m/s at 10 kHz
constexpr double kRobot = 0.4;     // m, scale of errors

enum class Way { kWarm, kCold, kInverse };

struct Sample {
  std::vector<double> lengths;
  ParallelSolution truth;
};

// The path around a configuration, solved as finely as can be.
std::vector<Sample> makePath(const ParallelScene& scene, const Pose& X_BP) {
  const ParallelModel model(scene, {1e-13});
  ParallelWorkspace workspace = model.makeWorkspace();
  model.solveForLengths(X_BP, Wrench::Zero(), workspace);
  const std::vector<double> middle = workspace.lengths();
  std::vector<Sample> path(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    path[i].lengths = middle;
    for (int k = 0; k < 6; ++k) path[i].lengths[k] += kSwing * std::sin(2.0 * kPi * i / kSamples + 1.7 * k);
    path[i].truth = model.solve(path[i].lengths, Wrench::Zero(), workspace);
    const SolveStatus& status = path[i].truth.status;
    if (!status.ok()) std::printf("no truth at %d: %s\n", i, model.describe(status).c_str());
  }
  return path;
}

ParallelSolution update(const ParallelModel& model, Way way, const Sample& sample, ParallelWorkspace& workspace) {
  if (way == Way::kInverse) return model.solveForLengths(sample.truth.X_BP, Wrench::Zero(), workspace);
  if (way == Way::kCold) workspace.reset();
  return model.solve(sample.lengths, Wrench::Zero(), workspace);
}

void measure(const ParallelScene& scene, char configuration, const std::vector<Sample>& path, Way way,
             double accuracy, Simd simd, double seconds) {
  const ParallelModel model(scene, {accuracy});
  ParallelWorkspace workspace(std::make_unique<ParallelStatics>(model.scene(), accuracy, simd));
  double error = 0.0, estimate = 0.0, iterations = 0.0;
  int failed = 0;
  for (const Sample& sample : path) {
    const ParallelSolution solution = update(model, way, sample, workspace);
    failed += !solution.status.ok();
    error = std::max({error, poseError(solution.X_BP, sample.truth.X_BP, kRobot),
                      complianceError(solution.compliance, sample.truth.compliance, kRobot),
                      complianceError(solution.material_compliance, sample.truth.material_compliance, kRobot)});
    estimate = std::max(estimate, solution.numerical_error);
    iterations += solution.iterations / static_cast<double>(path.size());
  }
  size_t elements = 0;
  for (const ClampedRod& rod : workspace.statics().rods()) elements += rod.backbone().elements.size();
  std::vector<float> times_us;
  const double end = processorSeconds() + seconds;
  for (size_t i = 0; processorSeconds() < end; ++i) {
    const double before = processorSeconds();
    update(model, way, path[i % path.size()], workspace);
    times_us.push_back(static_cast<float>(1e6 * (processorSeconds() - before)));
  }
  const double median = quantile(times_us, 0.5), slow = quantile(times_us, 0.99);
  const char* const names[] = {"warm", "cold", "inverse, warm"};
  std::printf("%-5c %-13s %-8s %8.0e %8.1f %8.1f %8.2f %9.1e %9.1e %6.1f %8zu %6d\n", configuration,
              names[static_cast<int>(way)], simd == Simd::kBest ? bestSimdName() : "baseline", accuracy, median, slow,
              1e3 / median, error, estimate, iterations, elements, failed);
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 0.3;
  const ParallelScene scene = stewartGough();
  std::printf("%-5s %-13s %-8s %8s %8s %8s %8s %9s %9s %6s %8s %6s\n", "Fig18", "way", "with", "accuracy", "us", "99 % us",
              "kHz", "error", "estimate", "iter.", "elements", "failed");
  for (char configuration : {'a', 'b', 'c'}) {
    const std::vector<Sample> path = makePath(scene, figure18Pose(configuration));
    for (double accuracy : {1e-5, 1e-7, 1e-9, 1e-11})
      measure(scene, configuration, path, Way::kWarm, accuracy, Simd::kBest, seconds);
    measure(scene, configuration, path, Way::kWarm, 1e-9, Simd::kBaseline, seconds);
    measure(scene, configuration, path, Way::kInverse, 1e-9, Simd::kBest, seconds);
    measure(scene, configuration, path, Way::kCold, 1e-9, Simd::kBest, seconds);
  }
  return 0;
}
