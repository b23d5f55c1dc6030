#include "rod/nodal_rotations.h"

#include <gtest/gtest.h>

#include "lie/cayley.h"
#include "live_stiffness/lie/so3.h"
#include "rod/shooting.h"
#include "support/matrix_near.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace live_stiffness {
namespace {

TEST(NodalRotations, CayleyVectorsAreRotations) {
  RandomSource random(61);
  for (double angle : {0.0, 1e-9, 0.3, 1.5, 3.0}) {
    const Vector3 axis = random.direction(1.0);
    const Matrix3 R = expSo3(angle * axis);
    EXPECT_TRUE(matrixNear(cayleyVector(R), 2.0 * std::tan(0.5 * angle) * axis, 1e-13 * (1.0 + std::tan(0.5 * angle)))) << angle;
    EXPECT_TRUE(matrixNear(cayleyRotation(cayleyVector(R)), R, 1e-14)) << angle;
  }
}

// Two segments and a link, bent by pressure and loads, in the given elements.
class BentChain {
 public:
  explicit BentChain(std::vector<int> count, int stages = kMaxStages)
      : scene_(awkwardScene()), chain_(scene_), backbone_(scene_) {
    for (int k = 0; k < 2; ++k) {
      backbone_.rest[k].stretch = 1.1;
      backbone_.rest[k].curvature = Vector3(20.0, -30.0, 5.0);
      backbone_.rest[k].c.bending_torsion.diagonal() << 900.0, 1000.0, 1200.0;
    }
    backbone_.resize(count, stages);
    prepare(chain_, DeadLoads(), backbone_);
    march(chain_, DeadLoads(), Vector3::Zero(), MarchMode::kUnloaded, backbone_);
  }
  void solve() {
    DeadLoads loads;
    linear(loads.tip) = Vector3(0.02, -0.03, -0.04);
    prepare(chain_, loads, backbone_);
    Vector3 unused;
    ASSERT_TRUE(shoot(chain_, loads, Vector3(2e-3, 1e-3, -1e-3), false, backbone_, unused));
  }
  const Chain& chain() const { return chain_; }
  Backbone& backbone() { return backbone_; }
  // Orientation at a share of a segment that is a border of elements.
  Matrix3 at(int segment, double share) const {
    const double i = share * backbone_.element_count[segment];
    if (i == 0.0) return backbone_.elements[backbone_.firstElement(segment)].X_start().R;
    const RodElement& e = backbone_.elements[backbone_.firstElement(segment) + static_cast<int>(std::lround(i)) - 1];
    return e.X_start().R * cayleyRotation(e.g_end(backbone_.kernel->stages));
  }

 private:
  Scene scene_;
  Chain chain_;
  Backbone backbone_;
};

TEST(NodalRotations, TakeTheUnloadedShapeAsItIs) {
  BentChain bent({4, 3});
  NodalRotations shape(bent.chain());
  shape.resize(bent.backbone(), 2);
  shape.takeUnloaded(bent.chain(), bent.backbone());
  ASSERT_EQ(shape.R.size(), 15u);
  for (int i = 0; i <= 4; ++i) EXPECT_TRUE(matrixNear(shape.R[2 * i], bent.at(0, i / 4.0), 1e-14)) << i;
  for (int i = 0; i <= 3; ++i) EXPECT_TRUE(matrixNear(shape.R[8 + 2 * i], bent.at(1, i / 3.0), 1e-14)) << i;
}

// Where a node is a border of elements before and after, nothing is interpolated.
TEST(NodalRotations, KeepTheBordersOfElements) {
  BentChain from({4, 6}), to({2, 3}, 5);
  from.solve();
  NodalRotations shape(from.chain());
  shape.resize(from.backbone(), 1);
  shape.take(from.backbone());
  shape.place(to.backbone());
  for (double share : {0.0, 0.5, 1.0}) EXPECT_TRUE(matrixNear(to.at(0, share), from.at(0, share), 1e-14)) << share;
  for (int i = 0; i <= 3; ++i) EXPECT_TRUE(matrixNear(to.at(1, i / 3.0), from.at(1, i / 3.0), 1e-14)) << i;
}

// Between them, Cayley vectors are interpolated linearly: the same shape to second order in the distance of nodes.
TEST(NodalRotations, GiveTheSameShapeOnOtherElementsToSecondOrder) {
  BentChain truth({30, 30});
  truth.solve();
  const auto error = [&](int finer) {
    BentChain from({2 * finer, 2 * finer}), to({5, 3}, 5);
    from.solve();
    NodalRotations shape(from.chain());
    shape.resize(to.backbone(), 4 * finer);
    shape.take(from.backbone());
    shape.place(to.backbone());
    double largest = 0.0;
    for (int segment : {0, 1})
      for (int i = 0; i <= to.backbone().element_count[segment]; ++i) {
        const double share = static_cast<double>(i) / to.backbone().element_count[segment];
        largest = std::max(largest, (to.at(segment, share) - truth.at(segment, share)).norm());
      }
    // The nodes of an element turn from its start as its end does.
    const GaussLegendre& table = gaussLegendre(5);
    for (const RodElement& e : to.backbone().elements)
      for (int node = 0; node < 5; ++node) {
        const Vector3 g(e.state.g[0][node], e.state.g[1][node], e.state.g[2][node]);
        EXPECT_LT((g - table.c[node] * e.g_end(5)).norm(), 0.1 * e.g_end(5).norm());
      }
    return largest;
  };
  EXPECT_LT(error(1), 2e-2);
  EXPECT_NEAR(error(2) / error(4), 4.0, 1.5);
}

// As many intervals as there is room for, however many elements there are: it never allocates.
TEST(NodalRotations, HaveRoomForAllThatAChainCanHave) {
  BentChain bent({Backbone::kMaxElements, Backbone::kMaxElements});
  NodalRotations shape(bent.chain());
  const Matrix3* data = shape.R.data();
  shape.resize(bent.backbone(), 8);
  EXPECT_EQ(shape.R.size(), 1u + 2u * NodalRotations::kMostIntervals);
  EXPECT_EQ(shape.R.data(), data);
}

}  // namespace
}  // namespace live_stiffness
