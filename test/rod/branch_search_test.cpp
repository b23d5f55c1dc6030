#include "rod/branch_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace live_stiffness {
namespace {

// One degree of freedom x with the energy a x^4/4 + x^6/6 + (1 - load) x^2/2 - (imperfection load + push) x, in the
// place of base moment and tip. a = 1: buckles gently at load 1. a = -1: snaps.
class OneDegreeOfFreedom : public EquilibriumFinder {
 public:
  OneDegreeOfFreedom(double a, double imperfection) : a_(a), imperfection_(imperfection) {}

  std::optional<Equilibrium> solve(const DeadLoads& loads, const Vector3& base_moment) override {
    const double load = loads.gravity.x(), push = loads.tip[0] + imperfection_ * load;
    double x = base_moment.x();
    for (int i = 0; i < 12; ++i) {
      ++iterations_;
      const double force = a_ * std::pow(x, 3) + std::pow(x, 5) + (1.0 - load) * x - push;
      const double stiffness = 3.0 * a_ * x * x + 5.0 * std::pow(x, 4) + 1.0 - load;
      if (std::abs(force) < 1e-13) {
        Equilibrium result;
        result.base_moment.x() = result.p_BT.x() = x;
        result.tangent = 1e-3 * Matrix6::Identity();
        result.tangent(0, 0) = 1.0 / stiffness;
        result.stable = stiffness > 1e-9;
        at = x;
        return result;
      }
      x -= force / stiffness;
      if (!std::isfinite(x)) return std::nullopt;
    }
    return std::nullopt;
  }
  double bendingOf(const Vector3& moment) const override { return moment.norm(); }
  bool exhausted() const override { return iterations_ > 600; }

  double at = 0.0;

 private:
  double a_, imperfection_;
  int iterations_ = 0;
};

DeadLoads load(double size) {
  DeadLoads loads;
  loads.gravity.x() = size;
  return loads;
}

// Positive root of a x^2 + x^4 + 1 - load = 0: the branch without imperfection.
double buckled(double a, double size) { return std::sqrt(0.5 * (-a + std::sqrt(a * a + 4.0 * (size - 1.0)))); }

TEST(BranchSearch, FollowsAnImperfectBranchWithoutAWord) {
  OneDegreeOfFreedom finder(1.0, 0.1);
  BranchSearch search(finder, 1.0);
  EXPECT_EQ(search.run(load(1.5)), BranchEnd::kLoading);
  EXPECT_EQ(search.stableShare(), 1.0);
  EXPECT_GT(finder.at, buckled(1.0, 1.5));
}

TEST(BranchSearch, GoesAroundABifurcationAndSaysSo) {
  OneDegreeOfFreedom finder(1.0, 0.0);
  BranchSearch search(finder, 1.0);
  EXPECT_EQ(search.run(load(1.5)), BranchEnd::kBuckled);
  EXPECT_NEAR(search.stableShare(), 1.0 / 1.5, 2.5e-3);
  EXPECT_NEAR(std::abs(finder.at), buckled(1.0, 1.5), 1e-9);
}

TEST(BranchSearch, NeverCallsASnapLoading) {
  for (double imperfection : {0.0, 0.05}) {
    OneDegreeOfFreedom finder(-1.0, imperfection);
    BranchSearch search(finder, 1.0);
    const BranchEnd end = search.run(load(1.2));
    EXPECT_TRUE(end == BranchEnd::kBuckled || end == BranchEnd::kUnstable) << imperfection;
    EXPECT_LT(search.stableShare(), 1.0) << imperfection;
  }
}

TEST(BranchSearch, StaysOnTheBranchFromZeroBelowTheBifurcation) {
  OneDegreeOfFreedom finder(-1.0, 0.0);  // a stable one is far away already at 0.8
  BranchSearch search(finder, 1.0);
  EXPECT_EQ(search.run(load(0.95)), BranchEnd::kLoading);
  EXPECT_EQ(finder.at, 0.0);
}

TEST(BranchSearch, RunsBrisklyToWhereItRunsCarefully) {
  OneDegreeOfFreedom brisk(1.0, 0.1), careful(1.0, 0.1);
  EXPECT_TRUE(BranchSearch(brisk, 1.0).runCoarse(load(0.9), Equilibrium(), 2));
  EXPECT_EQ(BranchSearch(careful, 1.0).run(load(0.9)), BranchEnd::kLoading);
  EXPECT_NEAR(brisk.at, careful.at, 1e-9);
}

// Past the bifurcation, where it snaps to, and by a step that ends far from where the ones before let expect.
TEST(BranchSearch, DoesNotRunBrisklyWhereThereIsMoreToTell) {
  OneDegreeOfFreedom straight(1.0, 0.0), snapping(-1.0, 0.05), jumping(-1.0, 0.3);
  EXPECT_FALSE(BranchSearch(straight, 1.0).runCoarse(load(1.5), Equilibrium(), 3));
  EXPECT_FALSE(BranchSearch(snapping, 1.0).runCoarse(load(1.2), Equilibrium(), 2));
  EXPECT_FALSE(BranchSearch(jumping, 0.1).runCoarse(load(0.9), Equilibrium(), 2));
}

}  // namespace
}  // namespace live_stiffness
