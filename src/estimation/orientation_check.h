#pragma once
// Whether measured orientations mean what they are read as: tried against the tips that the model predicts.
//
// Positions tell how the base stands; then orientations in the right reading agree with the model up to one constant rotation,
// that of the sensor on the tip. All errors are what is left after the best such rotation.

#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/recording.h"

namespace live_stiffness {

// How measured poses are to be read instead of as given. Mirrored: a component of the position changes its sign, or the
// orientation is seen in a mirror across that axis. First the order of the quaternion is changed, then its inverse is taken,
// then it is mirrored.
struct PoseReading {
  enum class Order { kAsGiven, kXyzw, kWxyz };  // of the four numbers, when they stand where the other order was expected
  Order order = Order::kAsGiven;
  bool inverse = false;        // the tracker as the sensor sees it was given
  int mirrored_rotation = -1;  // 0 to 2: axis x, y or z; -1: none
  int mirrored_position = -1;

  std::string text() const;  // what was done to positions and orientations, in words; empty: nothing
};

Pose apply(const PoseReading& reading, const Pose& X_AS);
Recording apply(const PoseReading& reading, Recording recording);

struct OrientationCheck {
  TrackerMeasures measures = TrackerMeasures::kPose;  // as told, or else as found
  // Readings that fit much better than as given. None: as given is right. Several: the motion does not tell them apart.
  std::vector<PoseReading> readings;
  bool unexplained = false;  // orientations that follow the tip, but in no reading that was tried; or not as was told
  double position_as_given = 0.0, position_as_read = 0.0;  // RMS distance of the sensor from the fitted model, m
  // Mean angle of the orientations, or of the z axes if only those are measured, rad; both zero for positions only.
  double rotation_as_given = 0.0, rotation_as_read = 0.0;
  std::string reason;  // why less than the whole pose was found to be measured, or what is unexplained

  bool wrong() const { return unexplained || !readings.empty(); }
  // What was found, as one line without a full stop; empty: the poses are what they were taken for.
  std::string text() const;
};

// Judges measured sensor poses X_AS at the times of predicted tips X_BT (the same number, at least 3, all finite). measures:
// as told; none: to be found. Needs tips that turn by some degrees; without them little can be found.
OrientationCheck checkOrientations(const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS,
                                   std::optional<TrackerMeasures> measures = std::nullopt);

// R_TS as the mean of (R_AB R_BT_i)^T R_AS_i; of the z axes alone, without turn about them; or the identity.
Matrix3 sensorRotation(const Matrix3& R_AB, const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS,
                       TrackerMeasures measures);
// Angle between orientations, or between z axes; 0 if neither is measured. rad.
double rotationBetween(const Matrix3& a, const Matrix3& b, TrackerMeasures measures);

}  // namespace live_stiffness
