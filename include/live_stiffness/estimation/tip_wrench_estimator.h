#pragma once
// External tip wrench, live: an iterated extended Kalman filter that fuses the model with the tracker.
//
// State: wrench W at T (3 or 6 components), logarithm g of the stiffness scale, twist b of the model error. Measurement:
//   measured X_BT = (p + b_v, exp(b_w) R),   (R, p) the model's equilibrium under pressures, W and known wrench,
// whose derivative by W is the tangent compliance at the loaded equilibrium; iterated, so that large deflections are
// not linearised (Bell and Cathey, "The iterated Kalman filter update as a Gauss-Newton method", IEEE TAC 1993).
// Creep is taken from the scene; what it leaves is model error. See docs/estimation.md.

#include <memory>
#include <string>

#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/estimation/tracker_measures.h"
#include "live_stiffness/parameters.h"

namespace live_stiffness {

class SceneCreep;
class TipWrenchFilter;

// What an experimenter can know; docs/estimation.md says how to set it.
// Standard deviations unless stated; positions and forces for each axis.
struct TipWrenchOptions {
  int components = static_cast<int>(kWrenchComponents.standard);  // 3: a pure force at T; 6: force and moment
  double position_noise = kTrackerPositionNoise.si();  // white, per sample, of the tracker and of what the model does not
  double rotation_noise = kTrackerRotationNoise.si();  // follow from one sample to the next, m and rad
  double contact_force = kContactForce.si();           // size to expect in contact, N
  double model_error_position = kModelErrorPosition.si();  // of the slow twist between the model's tip and the real one:
  double model_error_rotation = kModelErrorRotation.si();  // creep that the model does not know, registration; m and rad
  double scale_deviation = kStiffnessScaleDeviation.si();  // of the logarithm of the stiffness scale at the start, -; 0: it
                                                           // stays 1
  double contact_on_force = kContactOnForce.si();          // above it contact begins, N

  template <class Options, class Visit>
  static void forEachParameter(Options& options, Visit&& visit) {
    visit(kWrenchComponents, options.components);
    visit(kTrackerPositionNoise, options.position_noise);
    visit(kTrackerRotationNoise, options.rotation_noise);
    visit(kContactForce, options.contact_force);
    visit(kModelErrorPosition, options.model_error_position);
    visit(kModelErrorRotation, options.model_error_rotation);
    visit(kStiffnessScaleDeviation, options.scale_deviation);
    visit(kContactOnForce, options.contact_on_force);
  }

  // Adds a fault unless there are 3 or 6 components; FaultList::checkAll() checks the ranges.
  void checkComponents(FaultList& faults) const {
    if (components == 4 || components == 5)
      faults.add(kWrenchComponents.key + (" = " + std::to_string(components)) + ": must be 3 (force) or 6 (force and moment)");
  }
};

struct TipWrenchEstimate {
  double time = 0.0;                      // s, of the sample
  Wrench wrench = Wrench::Zero();         // external dead wrench at T, base axes, N and N m; without the known one
  Matrix6 covariance = Matrix6::Zero();   // of the wrench; with 3 components the moment's part is zero
  double stiffness_scale = 1.0;           // factor on all moduli of the scene, -
  double stiffness_scale_deviation = 0.0; // standard deviation, -
  bool contact = false;                   // with hysteresis
  Pose X_BT;                              // corrected tip pose: equilibrium under the estimate, and model error added, m
  Twist model_error = Twist::Zero();      // b, m and rad, base axes
  StiffnessSolution solution;             // equilibrium at the estimated wrench (known one included) and scale; its
                                          // compliance is the corrected compliance
  bool outlier = false;                   // the newest pose was left out; the rest is a prediction
  bool tracked = true;                    // false: no pose came with this update; the rest is a prediction
  double innovation = 0.0;                // of the newest pose, in standard deviations of what was expected
  int iterations = 0;                     // of the measurement update; 0 in predictions
};

enum class TipWrenchCode {
  kOk = 0,
  kInvalidInput = 1,   // not finite, wrong number of pressures, or a rotation that is none: refused
  kTimeBackwards = 2,  // not after the last sample: refused
  kRestarted = 3,      // time jumped back by more than kRestartAfter: started again with this sample
  kOutlier = 4,        // pose beyond the gate: predicted only
  kSolveFailed = 5,    // the model has no solution there (status()): the last good estimate is kept
};
const char* codeName(TipWrenchCode code);  // "ok", "invalid_input", "time_backwards", "restarted", "outlier", ...

class TipWrenchEstimator {
 public:
  static constexpr int kMaxIterations = 8;  // of a measurement update
  static constexpr double kRestartAfter = 1.0;  // s

  // Throws ConfigurationError (all faults) on bad options or scene. Creep is that of the first segment.
  TipWrenchEstimator(const Scene& scene, const ModelOptions& model_options, const TipWrenchOptions& options);
  ~TipWrenchEstimator();

  // A sample: gauge pressures (Pa, one per chamber), measured tip pose (m; through the registration) and time (s,
  // increasing). True if estimate() is of this sample, outliers included; else see code(). Never throws. Bounded work:
  // at most 4 (kMaxIterations + 2) solves; no allocation once running while the stiffness scale stands still.
  bool update(PressuresRef gauge_pressures, const Pose& measured_X_BT, double time);
  // The same without a pose (drop-out): predicts, and the covariance grows.
  bool predict(PressuresRef gauge_pressures, double time);

  // Known dead wrench at T (base axes; weight of a tool, say), from the next sample on. Refused (false) unless finite.
  bool setKnownWrench(const Wrench& known);
  // What the tracker measures, from the next sample on; the rest of a pose must come from completedPose().
  void setMeasures(TrackerMeasures measures);
  // Forgets everything but options, scene, known wrench and what is measured.
  void reset();

  // The last good estimate; nullptr before the first.
  const TipWrenchEstimate* estimate() const { return has_estimate_ ? &estimate_ : nullptr; }
  TipWrenchCode code() const { return code_; }           // of the newest call
  const SolveStatus& status() const { return status_; }  // of the newest solve
  std::string statusText() const;                        // "" when ok, else the reason and the way out
  const StiffnessModel& model() const;                   // at the current scale

 private:
  bool accept(PressuresRef pressures, const Pose* measured, double time);
  bool step(PressuresRef pressures, const Pose* measured, double time);
  bool isOutlier(const Pose& measured, double innovation);
  bool fail();
  void updateContact(double elapsed);
  void publish(const StiffnessSolution& solution, double time);

  const TipWrenchOptions options_;
  const std::unique_ptr<TipWrenchFilter> filter_;  // refers to the options
  const std::unique_ptr<SceneCreep> creep_;
  bool contact_ = false;
  double pending_ = 0.0;             // s that the force has asked for contact to begin or to end
  Wrench known_ = Wrench::Zero();
  Pressures pressures_;              // of the last sample, as given, Pa
  double time_ = 0.0;                // of the last sample, s
  bool started_ = false, has_estimate_ = false;
  int outliers_ = 0;                 // in a row that agree with one another
  Pose last_outlier_;
  TipWrenchCode code_ = TipWrenchCode::kOk;
  SolveStatus status_;
  TipWrenchEstimate estimate_;
};

}  // namespace live_stiffness
