#pragma once
// Calibration: parameters of a scene and the registration of each recording, fitted together to what was measured.
//
// Minimised over parameters theta and registrations, with Ceres:
//     sum over samples  rho(|e_position / sigma_p|^2 + |e_rotation / sigma_r|^2) / correlation
//   + sum over rows of compliance tables  |C - C_measured|^2 / (sigma_C |C_measured|)^2 + (norms alike)
//   + sum over parameters ((theta - prior mean) / prior sigma)^2                within the parameters' bounds,
// rho is Huber's loss. Neighbouring samples share their model error (creep, a plateau), so `correlation` = correlation time /
// sample time of them together count as one sample. Otherwise 1000 samples would outweigh every prior, and the standard
// errors would be far too small. sigma_p and sigma_r are estimated from the residuals of a first fit (medians); then the
// fit is repeated.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibration/compliance_table.h"
#include "calibration/force_sensor.h"
#include "live_stiffness/compliance/model_options.h"
#include "live_stiffness/estimation/error_summary.h"
#include "live_stiffness/estimation/recording.h"
#include "live_stiffness/estimation/registration.h"

namespace live_stiffness {

enum class SampleChoice { kAll, kQuasiStatic };

// Treatment of samples under contact (not isUnloaded): left out of the fit and predicted without the force; left out of the
// fit but predicted with the sensor's wrench; or fitted with it.
enum class LoadedSamples { kIgnore, kPredict, kFit };

struct CalibrationRecording {
  Recording recording;
  std::vector<Pressures> channels;  // gauge, one per sample
  std::vector<bool> used;           // per sample: takes part in the fit
  std::vector<bool> loaded;         // per sample: the force sensor's wrench acts on the model
  bool relative_to_base = false;    // the tip's poses are in the axes of a base sensor

  // A pose that only repeats the one before is not used. Where each sample has a pose of a base sensor, the tip is taken
  // relative to it (relativeToBase()). Throws ConfigurationError when fewer than three unloaded samples of the kind are left.
  CalibrationRecording(Recording recording, SampleChoice choice, LoadedSamples loads);
};

struct CalibrationOptions {
  ModelOptions model;
  double position_sigma = 0.5e-3;     // of model and tracker together, first guess, m
  double rotation_sigma = radians(1.0);  // rad; 0: orientations are not used
  double compliance_sigma = 0.05;     // of measured compliances, relative to the row's Frobenius norm
  double correlation_time = 1.0;      // s
  double huber = 2.0;                 // residuals beyond this number of sigmas have linear weight
  bool use_priors = true;
  bool shared_registration = false;   // of all recordings: they are of one set-up
  std::optional<Registration> given;  // known registration of all recordings, held constant
  int blocks = 8;                     // of each recording, for the leave-one-block-out error; 0: none
  ForceSensorMount force_sensor;
  std::function<void(const std::string& stage, int done, int total)> progress;  // may be empty
};

struct RecordingFit {
  std::string name;
  Registration registration;
  bool determined = false;                 // the data determine the registration: the standard errors in the verdict are small
  std::string verdict;                     // the same as text, with advice
  int repeated = 0;                        // samples that repeat the pose before
  int without_equilibrium = 0;             // samples that have none at the solution: left out of all errors
  bool relative_to_base = false;           // the registration is that of the base sensor's axes, not of the tracker's
  std::vector<double> position_error;      // |predicted - measured| of the sensor, every sample, m; NaN without equilibrium
  std::vector<double> rotation_error;      // of what is measured, rad, every sample; NaN without
  std::vector<Vector3> position_residual;  // predicted - measured, base axes, m; NaN without equilibrium
  std::vector<double> left_out_error;      // position error of used samples with their block left out, m; NaN elsewhere
  ErrorSummary used, quasi_static_unloaded, left_out;
};

struct ComplianceFit {
  std::string name;
  Matrix3 predicted, measured;       // m/N
  Matrix3 left_out;                  // prediction of a fit without this row
  double norm_error = 0.0;           // (42): | |C_e| - |C| | / |C_e|
  double matrix_error = 0.0;         // |C_e - C| / |C_e|
  double left_out_norm_error = 0.0, left_out_matrix_error = 0.0;
};

struct ParameterFit {
  SceneParameter parameter;
  double value = 0.0;           // SI
  double standard_error = 0.0;  // SI; with the prior
  double data_error = 0.0;      // SI; without the prior; infinite if the data do not determine it
  bool at_bound = false;
};

// A combination of parameters about which the priors say more than the data.
struct UndeterminedDirection {
  Eigen::VectorXd weights;   // unit vector in units of prior sigmas, one per parameter
  double information = 0.0;  // of the data, relative to the priors': below 1
};

struct CalibrationResult {
  bool converged = false;
  std::string message;  // of the optimiser
  std::string moduli;   // that the scene's own do not carry the robot, and which would; empty: they do
  int iterations = 0;
  double seconds = 0.0;
  Scene scene;
  ForceSensorMount force_sensor;
  std::vector<ParameterFit> parameters;
  Eigen::MatrixXd correlation;  // of the parameters, with priors
  std::vector<UndeterminedDirection> undetermined;
  double position_sigma = 0.0, rotation_sigma = 0.0;  // as estimated
  std::vector<RecordingFit> recordings;
  std::vector<ComplianceFit> rows;
};

// Samples without an equilibrium are left out. If more than kFewShare have none at the start, the fit starts with other moduli,
// with priors likewise, if Young's modulus is among the parameters; else the registrations do not count as determined. Throws
// ConfigurationError on data that do not fit the scene, or when more than kMostShare have none then, with moduli that would do.
CalibrationResult calibrate(const Scene& scene, const ChannelMap& channels,
                            const std::vector<SceneParameter>& parameters,
                            const std::vector<CalibrationRecording>& recordings, const std::vector<ComplianceRow>& rows,
                            const CalibrationOptions& options);

}  // namespace live_stiffness
