#pragma once
// The four numbers with which errors are reported everywhere: mean, RMS, 95th percentile and maximum.

#include <string>
#include <vector>

namespace live_stiffness {

struct ErrorSummary {
  int count = 0;      // of errors; when 0 nothing else holds
  double mean = 0.0;  // all in the unit of the errors
  double rms = 0.0;
  double p95 = 0.0;   // smallest error that at least 95 % of the errors do not exceed
  double max = 0.0;
};

// The value that a share (0 to 1) of the values does not exceed, to the nearest of them; 0.5: the median. Zero of none.
double quantile(std::vector<double> values, double share);

// Summary of error magnitudes, which must not be negative. A NaN among them makes every number NaN.
ErrorSummary summarizeErrors(std::vector<double> errors);

// "mean 0.67, RMS 0.81, p95 1.60, max 2.31 mm (1094 samples)" of errors in metres.
std::string millimetreText(const ErrorSummary& summary);

}  // namespace live_stiffness
