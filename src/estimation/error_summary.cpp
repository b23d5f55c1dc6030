#include "live_stiffness/estimation/error_summary.h"

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
  // Sorting needs an order, which NaN does not have; and a NaN must show in the result.
  if (std::any_of(errors.begin(), errors.end(), [](double error) { return std::isnan(error); })) {
    summary.mean = summary.rms = summary.p95 = summary.max = std::numeric_limits<double>::quiet_NaN();
    return summary;
  }
  std::sort(errors.begin(), errors.end());
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (double error : errors) {
    sum += error;
    sum_of_squares += error * error;
  }
  const double count = static_cast<double>(errors.size());
  summary.mean = sum / count;
  summary.rms = std::sqrt(sum_of_squares / count);
  // Minus a little, because 0.95 * 20 is slightly more than 19 in binary.
  summary.p95 = errors[static_cast<size_t>(std::ceil(0.95 * count - 1e-9)) - 1];
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
