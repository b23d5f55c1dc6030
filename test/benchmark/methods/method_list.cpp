#include "benchmark/methods/method_list.h"

#include "benchmark/methods/common_practice.h"
#include "benchmark/methods/library_method.h"
#include "benchmark/methods/magnus.h"
#include "benchmark/methods/rk4_sensitivities.h"
#include "benchmark/methods/textbook.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

template <class Method>
auto maker(int resolution) {
  return [=](const Scene& scene) -> std::unique_ptr<StiffnessMethod> {
    return std::make_unique<Method>(scene, resolution);
  };
}

MethodEntry library(const std::string& family, const std::string& variant, double resolution,
                    double accuracy, int stages, Simd simd) {
  ModelOptions options;
  options.accuracy = accuracy;
  return {family, variant, resolution, [=](const Scene& scene) -> std::unique_ptr<StiffnessMethod> {
            return std::make_unique<LibraryMethod>(family + ", " + variant, scene, options, LibraryMethod::kStations,
                                                   stages, simd);
          }};
}

}  // namespace

double accuracyOfStages(int stages) {
  return stages == 5 ? 1e-6 : 1e-10;
}

std::vector<MethodEntry> methodList() {
  std::vector<MethodEntry> list;
  list.push_back({"textbook (Till)", "N=100", 100, maker<Textbook>(100)});
  const auto common_practice = [](CommonPractice::Jacobians jacobians, int steps = CommonPractice::kSteps) {
    return [=](const Scene& scene) -> std::unique_ptr<StiffnessMethod> {
      return std::make_unique<CommonPractice>(scene, jacobians, steps);
    };
  };
  list.push_back({"optimised (Till)", "N=20", 20, common_practice(CommonPractice::Jacobians::kDamped, 20)});
  list.push_back({"common practice", "N=50", 50, common_practice(CommonPractice::Jacobians::kFresh)});
  list.push_back({"common practice (tuned)", "N=50", 50, common_practice(CommonPractice::Jacobians::kReused)});
  for (int steps : {10, 20, 50, 100})
    list.push_back({"RK4 with sensitivities", "N=" + std::to_string(steps), double(steps),
                    maker<Rk4Sensitivities>(steps)});
  for (int elements : {1, 2, 4, 8, 16})
    list.push_back({"Magnus 4", std::to_string(elements) + " el.", double(elements), maker<Magnus<2>>(elements)});
  for (int elements : {1, 2, 4, 8})
    list.push_back({"Magnus 6", std::to_string(elements) + " el.", double(elements), maker<Magnus<3>>(elements)});
  for (int stages : kStageCounts)
    list.push_back(library("library by stages", std::to_string(stages) + " stages", stages, accuracyOfStages(stages),
                           stages, Simd::kBest));
  for (const auto simd : {Simd::kBest, Simd::kBaseline})
    for (double accuracy : {1e-3, 1e-6, 1e-9})
      list.push_back(library(simd == Simd::kBest ? "library" : "library (plain x86-64)",
                             "accuracy " + numberText(accuracy), accuracy, accuracy, 0, simd));
  return list;
}

}  // namespace live_stiffness
