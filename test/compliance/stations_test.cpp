#include "live_stiffness/compliance/stations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "live_stiffness/compliance/stiffness_model.h"
#include "rod/backbone.h"
#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

// Neither sorted nor a multiple of a batch; with both ends, some in the middle, one twice.
const std::vector<double> kFractions{0.3, 1.0, 0.0, 0.95, 0.5, 0.5, 0.71, 0.02, 1.0, 0.49, 0.66};

// The same polynomials at the same places, in other lanes: no more than rounding differs.
void expectAlike(const Station& a, const Station& b, double compliance, double length) {
  EXPECT_LT(poseError(a.X_BQ, b.X_BQ, length), 1e-14);
  EXPECT_TRUE(matrixNear(a.compliance, b.compliance, 1e-14 * compliance));
  EXPECT_EQ(a.stretch, b.stretch);
}

// One plan, kept while pressures, accuracy and so the numbers of elements and nodes change.
TEST(StationPlan, ReadsTheSameAsOneStationAtATime) {
  for (const Scene& scene : {paperScene(2), weightlessPaperScene(2)}) {
    std::vector<StationPlan> plans(2, StationPlan(kFractions));
    std::vector<Station> stations(kFractions.size());
    std::set<int> element_counts, node_counts;
    for (double accuracy : {1e-3, 1e-12, 1e-6, 1e-9})
      for (double bar : {0.0, 0.3, 1.2}) {
        const StiffnessModel model(scene, accurateTo(accuracy));
        StiffnessWorkspace workspace = model.makeWorkspace();
        const Pressures pressures = bars(bar, {1, 1, 0.2, 0.2, 0, 0, 0.3, 0.3, 1, 1, 0, 0});
        const StiffnessSolution solution = model.solve(pressures, Wrench::Zero(), workspace);
        ASSERT_TRUE(solution.status.ok());
        for (int segment : {0, 1}) {
          model.stations(workspace, segment, plans[segment], stations.data());
          const Backbone& backbone = workspace.backbone();
          element_counts.insert(backbone.element_count[segment]);
          node_counts.insert(backbone.elements[backbone.firstElement(segment)].state.dense_nodes);
          for (size_t i = 0; i < kFractions.size(); ++i) {
            SCOPED_TRACE(kFractions[i]);
            expectAlike(stations[i], model.station(workspace, segment, kFractions[i]), solution.compliance.norm(),
                        scene.length());
          }
        }
      }
    if (scene.hasWeight()) {
      EXPECT_GT(element_counts.size(), 1u);
      EXPECT_GT(node_counts.size(), 1u);
    }
  }
}

TEST(StationPlan, MovesFractionsBeyondToTheEnds) {
  const StiffnessModel model(paperScene(1), accurateTo(1e-9));
  StiffnessWorkspace workspace = model.makeWorkspace();
  const StiffnessSolution solution = model.solve(Pressures::Constant(6, 3e4), Wrench::Zero(), workspace);
  ASSERT_TRUE(solution.status.ok());
  StationPlan plan({-0.1, std::nan(""), 1.5});
  Station stations[3];
  model.stations(workspace, 0, plan, stations);
  const double size = solution.compliance.norm(), length = model.scene().length();
  expectAlike(stations[0], model.station(workspace, 0, 0.0), size, length);
  expectAlike(stations[1], model.station(workspace, 0, 0.0), size, length);
  expectAlike(stations[2], model.station(workspace, 0, 1.0), size, length);
  EXPECT_EQ(stations[0].compliance, Matrix6::Zero());
}

TEST(StationPlan, MayBeEmpty) {
  const StiffnessModel model(paperScene(1), {});
  StiffnessWorkspace workspace = model.makeWorkspace();
  ASSERT_TRUE(model.solve(Pressures::Zero(6), Wrench::Zero(), workspace).status.ok());
  StationPlan plan({});
  EXPECT_EQ(plan.size(), 0);
  model.stations(workspace, 0, plan, nullptr);
}

}  // namespace
}  // namespace live_stiffness
