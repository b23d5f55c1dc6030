#include "live_stiffness/estimation/error_summary.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace live_stiffness {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + std::min<long>(values.size() - 1, static_cast<long>(share * values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

ErrorSummary summarizeErrors(std::vector<double> errors) {
  ErrorSummary summary;
  summary.count = static_cast<int>(errors.size());
  if (errors.empty()) return summary;
  const Eigen::Map<const Eigen::VectorXd> all(errors.data(), summary.count);
  // Sorting needs an order, which NaN does not have; and a NaN must show in the result.
  if (all.hasNaN()) {
    summary.mean = summary.rms = summary.p95 = summary.max = std::numeric_limits<double>::quiet_NaN();
    return summary;
  }
  summary.mean = all.mean();
  summary.rms = std::sqrt(all.squaredNorm() / summary.count);
  std::sort(errors.begin(), errors.end());
  // Minus a little, because 0.95 * 20 is slightly more than 19 in binary.
  summary.p95 = errors[static_cast<size_t>(std::ceil(0.95 * summary.count - 1e-9)) - 1];
  summary.max = errors.back();
  return summary;
}

std::string millimetreText(const ErrorSummary& summary) {
  char text[160];
  std::snprintf(text, sizeof(text), "mean %.2f, RMS %.2f, p95 %.2f, max %.2f mm (%d samples)", 1e3 * summary.mean,
                1e3 * summary.rms, 1e3 * summary.p95, 1e3 * summary.max, summary.count);
  return text;
}

}  // namespace live_stiffness
