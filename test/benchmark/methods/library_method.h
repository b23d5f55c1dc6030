#pragma once
// The library's own solver, with material compliance at stations spread evenly over the soft segments.

#include "benchmark/methods/stiffness_method.h"
#include "compliance/stiffness_workspace.h"

namespace live_stiffness {

class LibraryMethod : public StiffnessMethod {
 public:
  static constexpr int kStations = 5;

  // stages and simd: as of StiffnessWorkspace::State.
  LibraryMethod(std::string name, const Scene& scene, const ModelOptions& options, int stations = kStations,
                int stages = 0, Simd simd = Simd::kBest);

  StiffnessSolution solve(PressuresRef pressures) override;
  void reset() override { workspace_.reset(); }
  // Of each segment, base to tip.
  const std::vector<std::vector<Station>>& stations() const { return stations_; }

 private:
  StiffnessModel model_;
  StiffnessWorkspace workspace_;
  std::vector<StationPlan> plans_;  // one per segment
  std::vector<std::vector<Station>> stations_;
};

}  // namespace live_stiffness
