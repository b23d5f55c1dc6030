#pragma once
// A force sensor on the tip: how it is mounted, and the wrench on the robot that its readings mean.

#include <optional>
#include <string>
#include <vector>

#include "calibration/scene_parameter.h"
#include "live_stiffness/estimation/recording.h"
#include "live_stiffness/parameters.h"

namespace live_stiffness {

// Numbers of the mount: what calibrate can fit, and options of programs.
inline constexpr NumberParameter kForceSensorAzimuth{
    "force_sensor_azimuth_deg", 0.0, Range::finite(), "turn of the force sensor about z of T", Live::kNo, kDegree};
inline constexpr NumberParameter kForceSensorHeight{
    "force_sensor_height_m", 0.0, Range::finite(), "its origin above T"};
inline constexpr NumberParameter kForceSensorCrosstalkX{
    "force_sensor_crosstalk_x", 0.0, {-1.0, 1.0},
    "share of its fz that appears in fx (crosstalk, or a tilted axis), which is subtracted"};
inline constexpr NumberParameter kForceSensorCrosstalkY{"force_sensor_crosstalk_y", 0.0, {-1.0, 1.0}, "the same in fy"};
inline constexpr NumberParameter kForceSensorDelay{
    "force_sensor_delay_s", 0.0, {-1.0, 1.0}, "delay of its readings relative to the pressures"};

// Its axes F are turned about z of T, its origin is on that axis.
struct ForceSensorMount {
  double azimuth = 0.0;    // rad
  double height = 0.0;     // of its origin above T along z of T, m
  double sign = 1.0;       // 1: it reports what acts on the robot; -1: what the robot exerts
  Wrench gains = Wrench::Ones();  // of its channels [f; m], own axes; 0: that channel is left out
  // Shares of fz that appear in fx and fy, by crosstalk or because its axis is tilted; they are subtracted, -.
  Eigen::Vector2d crosstalk = Eigen::Vector2d::Zero();
  bool in_base_axes = false;  // it reports the wrench at T in base axes: azimuth, height and crosstalk mean nothing
  double delay = 0.0;      // s by which its readings are later than the pressures

  template <class Mount, class Visit>
  static void forEachParameter(Mount& mount, Visit&& visit) {
    visit(kForceSensorAzimuth, mount.azimuth);
    visit(kForceSensorHeight, mount.height);
    visit(kForceSensorCrosstalkX, mount.crosstalk[0]);
    visit(kForceSensorCrosstalkY, mount.crosstalk[1]);
    visit(kForceSensorDelay, mount.delay);
  }

  // Dead wrench at T in base axes of a reading [f; m] (its own axes and origin; N, N m), the tip oriented as R_BT. The
  // delay is not applied here.
  Wrench atTip(const Wrench& reading, const Matrix3& R_BT) const;
  // 3x3: projects a force (base axes) on the part that the channels in use measure.
  Matrix3 seen(const Matrix3& R_BT) const;
};

// The parameter with this name, if a calibration can fit it: force_sensor_azimuth_deg, _height_m, _crosstalk_x, _crosstalk_y,
// _delay_s. Its start is the value of the mount. nullopt: another name.
std::optional<SceneParameter> forceSensorParameter(const std::string& name, const ForceSensorMount& mount);
std::vector<std::string> forceSensorParameterNames();

// The mount with these values (SI) of the parameters that belong to it; other parameters are ignored.
ForceSensorMount withParameters(const ForceSensorMount& mount, const std::vector<SceneParameter>& parameters,
                                const Eigen::VectorXd& values);

// A sensor's readings along a recording; at least one is needed before atTip() is called.
class ForceReadings {
 public:
  explicit ForceReadings(const Recording& recording);

  // The wrench at `time` (s), from the reading at time + delay, as a dead wrench at T in base axes, with the tip oriented as
  // R_BT. Linear between readings; outside of them the nearest one.
  Wrench atTip(const ForceSensorMount& mount, double time, const Matrix3& R_BT) const;

 private:
  std::vector<double> times_;
  std::vector<Wrench> readings_;
};

}  // namespace live_stiffness
