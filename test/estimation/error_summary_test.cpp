#include "live_stiffness/estimation/error_summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/decimal_comma.h"

namespace live_stiffness {
namespace {

TEST(ErrorSummary, OfOneToTwentyIsKnown) {
  std::vector<double> errors;
  for (int i = 20; i >= 1; --i) errors.push_back(i);
  const ErrorSummary summary = summarizeErrors(errors);
  EXPECT_EQ(summary.count, 20);
  EXPECT_DOUBLE_EQ(summary.mean, 10.5);
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt(143.5));  // (n + 1)(2n + 1) / 6
  EXPECT_EQ(summary.p95, 19.0);  // 19 of 20 are 95 %
  EXPECT_EQ(summary.max, 20.0);
}

TEST(ErrorSummary, OfOneErrorIsThatError) {
  const ErrorSummary summary = summarizeErrors({0.25});
  EXPECT_EQ(summary.p95, 0.25);
  EXPECT_EQ(summary.mean, 0.25);
}

TEST(ErrorSummary, OfNothingCountsNothing) { EXPECT_EQ(summarizeErrors({}).count, 0); }

TEST(ErrorSummary, DoesNotHideNan) {
  const ErrorSummary summary = summarizeErrors({1.0, std::nan(""), 2.0});
  for (double figure : {summary.mean, summary.rms, summary.p95, summary.max}) EXPECT_TRUE(std::isnan(figure));
}

TEST(ErrorSummary, TextIsInMillimetres) {
  const DecimalComma comma;  // of others in the process
  EXPECT_EQ(millimetreText(summarizeErrors({0.001, 0.001})),
            "mean 1.00, RMS 1.00, p95 1.00, max 1.00 mm (2 samples)");
}

}  // namespace
}  // namespace live_stiffness
