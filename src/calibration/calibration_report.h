#pragma once
// The result of a calibration, as text and as tables for plotting.

#include <string>

#include "calibration/calibration.h"

namespace live_stiffness {

// Several lines: estimates with standard errors, correlations, combinations that the data do not determine, errors of the fit
// and with blocks left out, registrations with their verdicts.
std::string reportText(const CalibrationResult& result);

// CSV of every sample: recording, time_s, used, error_x_m .. error_z_m (base axes), error_m, rotation_error_rad,
// left_out_error_m, pressure_K_pa (gauge, one per channel). Empty: left_out_error_m where it was not left out, errors where the
// model has no equilibrium, the rotation's where the tracker measures none. For scripts/plot_calibration.
std::string residualTable(const CalibrationResult& result, const std::vector<CalibrationRecording>& recordings);

// CSV of every row of the compliance tables: row, norm_error (42), matrix_error and the same left out (left_out_...),
// then measured, predicted and left out entries (measured_c11_m_per_n ...), column by column.
std::string complianceTableOf(const CalibrationResult& result);

}  // namespace live_stiffness
