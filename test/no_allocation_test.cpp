// solve() allocates nothing. An executable of its own, because it replaces malloc of the whole process: everything that
// allocates ends there, operator new and Eigen's aligned memory alike.

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>

#include "live_stiffness/estimation/stiffness_estimator.h"
#include "parallel/parallel_cases.h"
#include "support/random_source.h"
#include "support/scenes.h"

namespace {

// Plain integers: thread_local storage or atomics with dynamic set-up could allocate themselves. Tests have one thread.
bool g_counting = false;
long g_allocations = 0;

}  // namespace

// Sanitizers bring a malloc of their own. gcc names them by macros, clang by features.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define OTHER_MALLOC 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define OTHER_MALLOC 1
#endif

#if defined(__GLIBC__) && !defined(OTHER_MALLOC)
#define COUNTS_ALLOCATIONS 1
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* pointer, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) {
  g_allocations += g_counting;
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  g_allocations += g_counting;
  return __libc_calloc(count, size);
}
void* realloc(void* pointer, size_t size) {
  g_allocations += g_counting;
  return __libc_realloc(pointer, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  g_allocations += g_counting;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** pointer, size_t alignment, size_t size) {
  g_allocations += g_counting;
  *pointer = __libc_memalign(alignment, size);
  return *pointer ? 0 : ENOMEM;
}
}
#endif

namespace live_stiffness {
namespace {

class Counting {
 public:
  Counting() {
    g_allocations = 0;
    g_counting = true;
  }
  ~Counting() { g_counting = false; }
};

class NoAllocation : public ::testing::Test {
 protected:
  void SetUp() override {
#ifndef COUNTS_ALLOCATIONS
    GTEST_SKIP() << "malloc can be replaced with glibc and without address or thread sanitizer only";
#endif
  }
};

// Without this one a broken counter would let all the others pass.
TEST_F(NoAllocation, IsNoticedWhenThereIsOne) {
  {
    const Counting counting;
    Eigen::VectorXd vector = Eigen::VectorXd::Zero(100);
    volatile double keep = vector[3];
    (void)keep;
  }
  EXPECT_GT(g_allocations, 0);
}

TEST_F(NoAllocation, InAnySolveFromTheFirstOn) {
  for (const Scene& scene : {paperScene(1), paperScene(2), weightlessPaperScene(2), awkwardScene()})
    for (Stepping stepping : kSteppings)
      for (double accuracy : {1e-6, 1e-13}) {
        ModelOptions options = accurateTo(accuracy);
        options.stepping = stepping;
        const StiffnessModel model(scene, options);
        StiffnessWorkspace workspace = model.makeWorkspace();
        RandomSource random(71);
        for (int i = 0; i < 30; ++i) {
          const Pressures pressures = random.pairs(scene.chamberCount(), -0.3e5, 1.2e5);
          const Wrench wrench = i % 3 == 0 ? Wrench(Wrench::Zero()) : random.wrench(0.05, 1e-3);
          if (i % 5 == 0) workspace.reset();
          const Counting counting;
          model.solve(pressures, wrench, workspace);
          ASSERT_EQ(g_allocations, 0) << "solve " << i << ", " << steppingName(stepping) << ", accuracy " << accuracy;
        }
      }
}

TEST_F(NoAllocation, InSolvesThatFail) {
  const StiffnessModel model(paperScene(1), {});
  StiffnessWorkspace workspace = model.makeWorkspace();
  const Pressures good = Pressures::Constant(6, 5e4), high = Pressures::Constant(6, 1e6),
                  nan = Pressures::Constant(6, std::nan("")), few = Pressures::Zero(5);
  const Counting counting;
  EXPECT_FALSE(model.solve(high, Wrench::Zero(), workspace).status.ok());
  EXPECT_FALSE(model.solve(nan, Wrench::Zero(), workspace).status.ok());
  EXPECT_FALSE(model.solve(few, Wrench::Zero(), workspace).status.ok());
  EXPECT_FALSE(model.solve(good, Wrench::Constant(1e9), workspace).status.ok());
  EXPECT_TRUE(model.solve(good, Wrench::Zero(), workspace).status.ok());
  EXPECT_EQ(g_allocations, 0);
}

// Through the way downhill, finer elements and the search for the share of the loads that is stable.
TEST_F(NoAllocation, WhereTheRobotTopplesOrMayLeanInAnyDirection) {
  Scene standing = paperScene(1);
  for (int k = 1; k < 8; ++k) standing.chain.push_back(segmentOf(standing, 0));
  const StiffnessModel chain(standing, {}), column(paperScene(1), {});
  StiffnessWorkspace of_chain = chain.makeWorkspace(), of_column = column.makeWorkspace();
  RandomSource random(12);
  const Pressures uneven = random.pairs(48, 0.0, 5e4), even = Pressures::Constant(6, 1.5e5);
  const Counting counting;
  EXPECT_TRUE(chain.solve(uneven, Wrench::Zero(), of_chain).status.ok());
  EXPECT_EQ(column.solve(even, Wrench::Zero(), of_column).status.code, SolveCode::kUnstable);
  EXPECT_EQ(g_allocations, 0);
}

TEST_F(NoAllocation, InAStation) {
  const StiffnessModel model(paperScene(2), {});
  StiffnessWorkspace workspace = model.makeWorkspace();
  const Pressures pressures = Pressures::Constant(12, 5e4);
  const Counting counting;
  model.solve(pressures, Wrench::Zero(), workspace);
  model.station(workspace, 1, 0.3);
  EXPECT_EQ(g_allocations, 0);
}

// Warm or cold, of one element or of many.
TEST_F(NoAllocation, InAPlanOfStations) {
  StationPlan plan({0.1, 0.2, 0.5, 0.6, 0.9, 1.0});
  Station stations[6];
  for (double accuracy : {1e-3, 1e-12}) {
    const StiffnessModel model(paperScene(2), accurateTo(accuracy));
    StiffnessWorkspace workspace = model.makeWorkspace();
    const Pressures pressures = Pressures::Constant(12, 5e4);
    const Counting counting;
    model.solve(pressures, Wrench::Zero(), workspace);
    model.stations(workspace, 1, plan, stations);
    EXPECT_EQ(g_allocations, 0);
  }
}

// With stations, shape and markers' data; the first two make room for estimate and candidate.
TEST_F(NoAllocation, InAnUpdateOfTheEstimatorAfterTheSecond) {
  StiffnessEstimator estimator(paperScene(2), {}, {});
  RandomSource random(72);
  for (int i = 0; i < 20; ++i) {
    const Pressures pressures = random.pairs(12, -0.3e5, 1e5);
    const Wrench wrench = random.wrench(0.05, 1e-3);
    const Counting counting;
    const bool solved = estimator.setPressures(pressures, 0.01 * i) == StiffnessEstimator::Outcome::kSolved;
    const bool pushed = estimator.setTipWrench(wrench) == StiffnessEstimator::Outcome::kSolved;
    ASSERT_TRUE(solved && pushed) << i;
    if (i >= 1) {
      ASSERT_EQ(g_allocations, 0) << i;
    }
  }
}

TEST_F(NoAllocation, InAParallelRobot) {
  const ParallelModel model(awkwardRobot(), {});
  ParallelWorkspace workspace = model.makeWorkspace();
  std::vector<double> lengths = unevenLengths();
  const std::vector<double> hopeless{0.1, 3.0, 0.1, 3.0, 0.1, 3.0};
  const Pose pose{Matrix3::Identity(), Vector3(0.02, 0.0, 0.4)};
  bool good = true;
  const Counting counting;
  for (int i = 0; i < 5; ++i) {
    lengths[i] += 1e-3;
    good = model.solve(lengths, Wrench::Zero(), workspace).status.ok() && good;
  }
  good = model.solveForLengths(pose, Wrench::Zero(), workspace).status.ok() && good;
  good = !model.solve(hopeless, Wrench::Zero(), workspace).status.ok() && good;
  EXPECT_EQ(g_allocations, 0);
  EXPECT_TRUE(good);
}

}  // namespace
}  // namespace live_stiffness
