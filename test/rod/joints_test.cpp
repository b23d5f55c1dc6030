// (38) and (39) of Shi et al.: at every joint of segment and link the pose goes on, and what the part beyond exerts on
// the part before changes by the link's own weight alone. n, m are the external part; R F_P and R T_P of (39) cancel in
// it (docs/derivation.md, section 1).

#include <gtest/gtest.h>

#include "live_stiffness/compliance/stiffness_model.h"
#include "rod/backbone.h"
#include "support/matrix_near.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

Scene threeSegments() {
  Scene scene = awkwardScene();
  scene.chain.push_back(segmentOf(scene, 0));
  scene.chain.push_back(segmentOf(scene, 1));  // without a link between: a joint of two segments
  return scene;
}

TEST(Joints, KeepPoseAndBalanceOfForceAndMoment) {
  const Wrench wrench = (Wrench() << 0.01, 0.02, -0.02, 1e-3, -2e-3, 1e-3).finished();
  for (const Scene& scene : {paperScene(2), awkwardScene(), threeSegments()}) {
    const StiffnessModel model(scene, accurateTo(1e-12));
    StiffnessWorkspace workspace = model.makeWorkspace();
    RandomSource random(9);
    const Pressures pressures = random.pairs(scene.chamberCount(), 0.0, 0.5e5);
    const StiffnessSolution solution = model.solve(pressures, wrench, workspace);
    ASSERT_TRUE(solution.status.ok()) << model.describe(solution.status);
    const Backbone& backbone = workspace.backbone();
    // What the chain hands on: pose, force and moment at the section where the next body starts.
    Pose X;
    Vector3 n = Vector3::Zero(), m = Vector3::Zero();
    bool at_base = true;
    int joints = 0;
    const double length = scene.length();
    walk(
        scene,
        [&](int k, const Segment&) {
          const RodElement& first = backbone.elements[backbone.firstElement(k)];
          if (!at_base) {
            ++joints;
            EXPECT_TRUE(matrixNear(first.X_start().p, X.p, 1e-12 * length));
            EXPECT_TRUE(matrixNear(first.X_start().R, X.R, 1e-12));
            EXPECT_TRUE(matrixNear(Vector3(first.state.n_start), n, 1e-12));
            EXPECT_TRUE(matrixNear(Vector3(first.state.m_start), m, 1e-12 * length));
          }
          at_base = false;
          for (int i = 1; i < backbone.element_count[k]; ++i) {  // the same within a segment
            const RodElement &before = backbone.elements[backbone.firstElement(k) + i - 1], &after = *(&before + 1);
            EXPECT_TRUE(matrixNear(after.X_start().p, before.X_end().p, 1e-12 * length));
            EXPECT_TRUE(matrixNear(Vector3(after.state.m_start), before.m_end(), 1e-12 * length));
          }
          const RodElement& last = backbone.elements[backbone.firstElement(k) + backbone.element_count[k] - 1];
          X = last.X_end();
          n = last.n_end();
          m = last.m_end();
          EXPECT_TRUE(matrixNear(model.station(workspace, k, 1.0).X_BQ.p, X.p, 1e-11 * length));
        },
        [&](const Link& link) {
          ++joints;
          const Vector3 weight = link.mass * *scene.gravity, far = X.R * Vector3(0.0, 0.0, link.length);
          // Balance of the link about its near end: n, m are exerted there, n - weight and the new m at its far end.
          const Vector3 m_far = m - far.cross(n - weight) - (0.5 * far).cross(weight);
          n -= weight;
          m = m_far;
          X.p += far;
        });
    EXPECT_GE(joints, 2);
    // (35): at T what is left is the tip wrench and the weight of the tip mass.
    const Vector3 lever = X.R * scene.tip_offset;
    EXPECT_TRUE(matrixNear(X.p + lever, solution.X_BT.p, 1e-12));
    EXPECT_TRUE(matrixNear(n, linear(wrench) + scene.tip_mass * *scene.gravity, 1e-12));
    EXPECT_TRUE(matrixNear(m - lever.cross(n), angular(wrench), 1e-9 * length));
  }
}

// Seen from the other end: at every joint, of elements, too, the moment is that of all loads beyond, by Gauss quadrature over
// the same shape.
TEST(Joints, HoldTheMomentOfAllLoadsBeyond) {
  Scene hanging, paper = paperScene(1);  // elements by the dozen
  hanging.gravity = Vector3(0.5, 0.0, 9.81);
  for (int k = 0; k < 8; ++k) hanging.chain.push_back(segmentOf(paper, 0));
  const Wrench wrench = (Wrench() << 0.01, 0.02, -0.02, 1e-3, -2e-3, 1e-3).finished();
  for (const Scene& scene : {paperScene(2), awkwardScene(), threeSegments(), hanging}) {
    const StiffnessModel model(scene, accurateTo(1e-12));
    StiffnessWorkspace workspace = model.makeWorkspace();
    RandomSource random(9);
    const StiffnessSolution solution = model.solve(random.pairs(scene.chamberCount(), 0.0, 0.5e5), wrench, workspace);
    ASSERT_TRUE(solution.status.ok()) << model.describe(solution.status);
    const Backbone& backbone = workspace.backbone();
    const GaussLegendre& gauss = gaussLegendre(7);
    struct PointLoad {
      Vector3 p, force;
    };
    std::vector<PointLoad> loads;
    std::vector<size_t> loads_before;  // each element
    Pose X;
    walk(
        scene,
        [&](int k, const Segment& segment) {
          const int count = backbone.element_count[k];
          for (int i = 0; i < count; ++i) {
            loads_before.push_back(loads.size());
            for (int node = 0; node < 7; ++node)
              loads.push_back({model.station(workspace, k, (i + gauss.c[node]) / count).X_BQ.p,
                               gauss.b[node] / count * segment.mass() * *scene.gravity});
          }
          X = model.station(workspace, k, 1.0).X_BQ;
        },
        [&](const Link& link) {
          loads.push_back({X * Vector3(0.0, 0.0, 0.5 * link.length), link.mass * *scene.gravity});
          X.p = X * Vector3(0.0, 0.0, link.length);
        });
    loads.push_back({solution.X_BT.p, linear(wrench) + scene.tip_mass * *scene.gravity});
    double largest = 0.0;
    for (const RodElement& element : backbone.elements) largest = std::max(largest, Vector3(element.state.m_start).norm());
    for (size_t i = 0; i < backbone.elements.size(); ++i) {
      const RodElement& element = backbone.elements[i];
      Vector3 moment = angular(wrench);
      for (size_t k = loads_before[i]; k < loads.size(); ++k) moment += (loads[k].p - element.p_start()).cross(loads[k].force);
      EXPECT_TRUE(matrixNear(Vector3(element.state.m_start), moment, 1e-9 * largest)) << i;
    }
  }
}

}  // namespace
}  // namespace live_stiffness
