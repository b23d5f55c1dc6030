#include "live_stiffness/estimation/error_summary.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "live_stiffness/checks.h"

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
  const auto text = [](double length) { return fixedText(1e3 * length, 2); };
  return "mean " + text(summary.mean) + ", RMS " + text(summary.rms) + ", p95 " + text(summary.p95) + ", max " +
         text(summary.max) + " mm (" + std::to_string(summary.count) + " samples)";
}

}  // namespace live_stiffness
