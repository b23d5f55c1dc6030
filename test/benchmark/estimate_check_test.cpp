// The short form of the check that scripts/report makes on 10 000 random scenes; same goals.

#include "benchmark/estimate_check.h"

#include <gtest/gtest.h>

#include <cmath>

namespace live_stiffness {
namespace {

TEST(NumericalError, IsTrueAndKeptBelowTheRequestedAccuracyOverRandomScenes) {
  const EstimateShares shares = checkEstimates(2024, 1000, [](const EstimateCase& one) {
    if (!one.solved()) return;
    EXPECT_TRUE(std::isfinite(one.error) && std::isfinite(one.estimate));
    if (!one.withinTenEstimates())
      std::cout << one.segments << " segments, requested " << one.requested << ", estimated " << one.estimate
                << ", true " << one.error << "\n";
  });
  std::cout << shares.solved << " of " << shares.cases << " solved (" << shares.loaded << " with loads), "
            << shares.of_code[2] << " out of range, " << shares.of_code[3] << " not converged, " << shares.of_code[4]
            << " unstable; error at most " << shares.worst_ratio << " times the estimate\n";
  EXPECT_GE(shares.solved, 850);
  EXPECT_GE(shares.loaded, 700);
  EXPECT_EQ(shares.of_code[static_cast<int>(SolveCode::kInvalidInput)], 0);
  EXPECT_GE(shares.tenEstimatesShare(), 0.999);
  EXPECT_GE(shares.requestedShare(), 0.99);
}

}  // namespace
}  // namespace live_stiffness
