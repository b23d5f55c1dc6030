#pragma once
// Registration of tracker and robot by least squares: predicted tip poses against measured sensor poses.

#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/error_summary.h"
#include "live_stiffness/estimation/registration.h"
#include "live_stiffness/estimation/tracker_measures.h"

namespace live_stiffness {

// A direction whose singular value in the scaled problem is below this is not determined by the data: a position error e of
// the model or the tracker would change the sensor offset by more than e / kWeakSensitivity.
constexpr double kWeakSensitivity = 0.01;

struct RegistrationFit {
  Registration registration;
  TrackerMeasures measures = TrackerMeasures::kPose;  // what was used; the rotation of X_TS, or its turn about z, is zero without
  std::vector<double> residuals;           // |p_AS predicted - measured| per sample, m
  ErrorSummary position;                   // of the residuals, m
  ErrorSummary rotation;                   // angle between predicted and measured orientation, or z axes, rad; or empty
  bool base_rotation_determined = false;   // false: other rotations of the base fit equally well; the guess was kept
  bool sensor_offset_determined = false;   // false: other offsets fit equally well; that component was left at zero
  double weakest_sensitivity = 0.0;        // smallest singular value: m of sensor motion per m of offset, or per
                                           // turn of the base that moves the tip by 1 m at its rms distance
  bool orientations_fit = true;            // false: they, or mirrored positions, are not what they were taken for
  std::string orientations;                // what was found about that, as one line; empty: nothing to say
  bool determined() const { return base_rotation_determined && sensor_offset_determined && orientations_fit; }
  // What the user can do about it; empty when everything is determined.
  std::string advice() const;
  // What of the sensor was not measured and stays open, as one line; empty: nothing.
  std::string unmeasured() const;
};

// Fits X_AB and the sensor's offset p_TS to the positions (rigid: no scale), minimising
//   sum_i | X_AB (p_BT_i + R_BT_i p_TS) - p_AS_i |^2,
// by Gauss-Newton with p_AB eliminated, started from two independent guesses of R_AB (positions by Kabsch's method with
// no offset; and, if orientations are measured, rotation vectors from the mean orientation by the same method, whatever the
// offset); then the sensor's rotation R_TS as the mean of (R_AB R_BT_i)^T R_AS_i, or from the z axes alone. Components of
// offset and rotation that the motion does not determine keep their starting value (offset: zero), and the flags say so. For
// example, when the robot bends in one plane only, an offset normal to that plane looks the same as a shift of the base.
// Orientations have no part in the fit of the positions, and are judged by it: orientations_fit.
// X_BT: predicted, X_AS: measured, at the same times. measures: none: found from the data. Throws ConfigurationError on
// different sizes, fewer than 3 samples, or values that are not finite.
RegistrationFit fitRegistration(const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS,
                                std::optional<TrackerMeasures> measures = TrackerMeasures::kPose);

}  // namespace live_stiffness
