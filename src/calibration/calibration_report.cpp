#include "calibration/calibration_report.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

constexpr double kTellingApart = 0.9;  // larger correlations are reported

std::string padded(std::string text, size_t width) {
  text.resize(std::max(width, text.size() + 1), ' ');  // at least one space
  return text;
}

std::string inUnit(const SceneParameter& parameter, double si) { return numberText(si / parameter.unit); }

std::string percent(double share) {
  return fixedText(100.0 * share, 1) + " %";
}

std::string errorsText(const ComplianceFit& fit) {
  return "error of the norm (42) " + percent(fit.norm_error) + ", left out " + percent(fit.left_out_norm_error) +
         "; of the matrix " + percent(fit.matrix_error) + ", left out " + percent(fit.left_out_matrix_error);
}

std::string directionText(const UndeterminedDirection& direction, const std::vector<ParameterFit>& parameters) {
  const double largest = direction.weights.cwiseAbs().maxCoeff();
  std::string text;
  for (long k = 0; k < direction.weights.size(); ++k) {
    const double weight = direction.weights[k];
    if (std::abs(weight) < 0.2 * largest) continue;
    const SceneParameter& p = parameters[static_cast<size_t>(k)].parameter;
    text += (text.empty() ? "" : "  ") + p.name + (weight < 0.0 ? " -" : " +") +
            inUnit(p, std::abs(weight) * p.prior_sigma);
  }
  return text;
}

// A name as a field: with quotes where it has a separator in it.
std::string csvText(const std::string& name) {
  if (name.find_first_of(",;\"\t\n") == std::string::npos) return name;
  std::string quoted;
  for (char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return '"' + quoted + '"';
}

// Nothing for a number that is not there (NaN).
std::string csvText(double number) {
  if (!std::isfinite(number)) return "";
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  out << number;
  return out.str();
}

}  // namespace

std::string reportText(const CalibrationResult& result) {
  std::ostringstream out;
  out << (result.converged ? "converged" : "NOT converged: " + result.message) << "; " << numberText(result.seconds)
      << " s\n";
  if (!result.moduli.empty()) out << "\n" << result.moduli << "\n";
  if (!result.parameters.empty()) {
    out << "\n" << padded("parameter", 28) << padded("estimate", 12) << padded("std error", 12)
        << padded("data alone", 12) << "prior\n";
    for (const ParameterFit& fit : result.parameters) {
      const SceneParameter& p = fit.parameter;
      out << padded(p.name, 28) << padded(inUnit(p, fit.value), 12) << padded(inUnit(p, fit.standard_error), 12)
          << padded(fit.data_error > 1e3 * p.prior_sigma ? "none" : inUnit(p, fit.data_error), 12)
          << inUnit(p, p.prior_mean) << " +- " << inUnit(p, p.prior_sigma) << (fit.at_bound ? "   AT ITS BOUND" : "")
          << "\n";
    }
    std::string pairs;
    for (long i = 0; i < result.correlation.rows(); ++i)
      for (long j = 0; j < i; ++j)
        if (std::abs(result.correlation(i, j)) > kTellingApart)
          pairs += "  " + result.parameters[static_cast<size_t>(j)].parameter.name + " and " +
                   result.parameters[static_cast<size_t>(i)].parameter.name + ": " +
                   numberText(result.correlation(i, j)) + "\n";
    if (!pairs.empty()) out << "\nstrongly correlated:\n" << pairs;
    if (result.undetermined.empty()) out << "\nthe data determine all combinations of the parameters better than the priors do\n";
    else out << "\nthe data determine these combinations less well than the priors do:\n";
    for (const UndeterminedDirection& direction : result.undetermined)
      out << "  " << directionText(direction, result.parameters) << "\n";
  }
  for (const RecordingFit& fit : result.recordings) {
    out << "\n" << fit.name << "\n";
    if (fit.relative_to_base)
      out << "  relative to its base sensor: base_in_tracker is the base in that sensor's axes\n";
    if (fit.repeated > 0)
      out << "  " << fit.repeated << " of " << fit.position_error.size()
          << " samples repeat the pose before and are not fitted\n";
    if (fit.without_equilibrium > 0)
      out << "  " << fit.without_equilibrium << " of " << fit.position_error.size()
          << " samples have no equilibrium and are left out\n";
    out << "  tip error, samples of the fit:      " << millimetreText(fit.used) << "\n";
    if (fit.quasi_static_unloaded.count > 0)
      out << "  tip error, quasi-static unloaded:   " << millimetreText(fit.quasi_static_unloaded) << "\n";
    if (fit.left_out.count > 0)
      out << "  tip error, its block left out:      " << millimetreText(fit.left_out) << "\n";
    out << "  registration: " << fit.verdict << "\n";
  }
  if (!result.recordings.empty())
    out << "\nnoise seen (per axis): " << numberText(1e3 * result.position_sigma) << " mm, "
        << numberText(degrees(result.rotation_sigma)) << " deg\n";
  ComplianceFit mean;
  const auto solved = static_cast<double>(std::count_if(
      result.rows.begin(), result.rows.end(), [](const ComplianceFit& fit) { return std::isfinite(fit.norm_error); }));
  for (const ComplianceFit& fit : result.rows) {
    const bool has_solution = std::isfinite(fit.norm_error);
    out << "\n" << fit.name << ": " << (has_solution ? errorsText(fit) : "has no equilibrium");
    if (!has_solution) continue;
    for (double ComplianceFit::*error : {&ComplianceFit::norm_error, &ComplianceFit::matrix_error,
                                         &ComplianceFit::left_out_norm_error, &ComplianceFit::left_out_matrix_error})
      mean.*error += fit.*error / solved;
  }
  if (!result.rows.empty()) out << "\nmean: " << errorsText(mean) << "\n";
  return out.str();
}

std::string residualTable(const CalibrationResult& result, const std::vector<CalibrationRecording>& recordings) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  out << "recording,time_s,used,error_x_m,error_y_m,error_z_m,error_m,rotation_error_rad,left_out_error_m";
  const int channels = recordings.empty() ? 0 : recordings.front().recording.channelCount();
  for (int k = 1; k <= channels; ++k) out << ",pressure_" << k << "_pa";
  out << "\n";
  for (size_t n = 0; n < recordings.size(); ++n) {
    const RecordingFit& fit = result.recordings[n];
    for (size_t i = 0; i < fit.position_error.size(); ++i) {
      const Vector3& e = fit.position_residual[i];
      out << csvText(fit.name) << "," << recordings[n].recording.samples[i].time << "," << recordings[n].used[i];
      for (double error : {e.x(), e.y(), e.z(), fit.position_error[i], fit.rotation_error[i], fit.left_out_error[i]})
        out << "," << csvText(error);
      for (int k = 0; k < channels; ++k) out << "," << recordings[n].channels[i][k];
      out << "\n";
    }
  }
  return out.str();
}

std::string complianceTableOf(const CalibrationResult& result) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  out << "row,norm_error,matrix_error,left_out_norm_error,left_out_matrix_error";
  for (const char* which : {"measured", "predicted", "left_out"})
    for (int j = 1; j <= 3; ++j)
      for (int i = 1; i <= 3; ++i) out << "," << which << "_c" << i << j << "_m_per_n";
  out << "\n";
  for (const ComplianceFit& fit : result.rows) {
    out << csvText(fit.name) << "," << fit.norm_error << "," << fit.matrix_error << "," << fit.left_out_norm_error << ","
        << fit.left_out_matrix_error;
    for (const Matrix3* C : {&fit.measured, &fit.predicted, &fit.left_out})
      for (int k = 0; k < 9; ++k) out << "," << (*C)(k);
    out << "\n";
  }
  return out.str();
}

}  // namespace live_stiffness
