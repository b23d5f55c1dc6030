#pragma once
// A force sensor on the tip: how it is mounted, and the wrench on the robot that its readings mean.

#include <optional>
#include <string>
#include <vector>

#include "calibration/scene_parameter.h"
#include "estimation/interpolation.h"
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

// Its axes F are turned about z of T, its origin is on that axis. T is double, or a type that carries derivatives.
template <class T>
struct ForceSensorMountOf {
  T azimuth = T(0.0);    // rad
  T height = T(0.0);     // of its origin above T along z of T, m
  double sign = 1.0;     // 1: it reports what acts on the robot; -1: what the robot exerts
  Wrench gains = Wrench::Ones();  // of its channels [f; m], own axes; 0: that channel is left out
  // Shares of fz that appear in fx and fy, by crosstalk or because its axis is tilted; they are subtracted, -.
  Vector2Of<T> crosstalk = Vector2Of<T>::Constant(T(0.0));
  T delay = T(0.0);      // s by which its readings are later than the pressures

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
  Eigen::Matrix<T, 6, 1> atTip(const Eigen::Matrix<T, 6, 1>& reading, const Matrix3& R_BT) const {
    using std::cos, std::sin;
    using Vector3T = Vector3Of<T>;
    const T c = cos(azimuth), s = sin(azimuth);
    Eigen::Matrix<T, 6, 1> counted = reading;
    for (int i = 0; i < 2; ++i) counted[i] -= crosstalk[i] * reading[2];
    for (int i = 0; i < 6; ++i) counted[i] *= gains[i] * sign;
    const auto turned = [&](int k) {
      return Vector3T(c * counted[k] - s * counted[k + 1], s * counted[k] + c * counted[k + 1], counted[k + 2]);
    };
    const Vector3T force = turned(0), moment = turned(3) + Vector3T(-height * force.y(), height * force.x(), T(0.0));
    Eigen::Matrix<T, 6, 1> wrench;
    for (int i = 0; i < 3; ++i) {
      wrench[i] = R_BT(i, 0) * force.x() + R_BT(i, 1) * force.y() + R_BT(i, 2) * force.z();
      wrench[3 + i] = R_BT(i, 0) * moment.x() + R_BT(i, 1) * moment.y() + R_BT(i, 2) * moment.z();
    }
    return wrench;
  }

  // 3x3: projects a force (base axes) on the part that the channels in use measure.
  Matrix3 seen(const Matrix3& R_BT) const {
    const Matrix3 R_BF = R_BT * expSo3(Vector3(0.0, 0.0, azimuth));
    return R_BF * Vector3(linear(gains)).asDiagonal() * R_BF.transpose();
  }
};
using ForceSensorMount = ForceSensorMountOf<double>;

// The parameter with this name, if a calibration can fit it: force_sensor_azimuth_deg, _height_m, _crosstalk_x, _crosstalk_y,
// _delay_s. Its start is the value of the mount. nullopt: another name.
std::optional<SceneParameter> forceSensorParameter(const std::string& name, const ForceSensorMount& mount);
const std::vector<std::string>& forceSensorParameterNames();

// The mount with these values (SI) of the parameters that belong to it; other parameters are ignored.
ForceSensorMount withParameters(const ForceSensorMount& mount, const std::vector<SceneParameter>& parameters,
                                const Eigen::VectorXd& values);

// A sensor's readings along a recording; at least one is needed before wrench() is called.
class ForceReadings {
 public:
  explicit ForceReadings(const Recording& recording);

  // The wrench at `time` (s), from the reading at time + delay, as a dead wrench at T in base axes, with the tip oriented as
  // R_BT. Linear between readings; outside of them the nearest one.
  Wrench atTip(const ForceSensorMount& mount, double time, const Matrix3& R_BT) const;
  // Its derivatives by the parameters (SI), 6 x parameters; zero for parameters of the scene.
  Eigen::Matrix<double, 6, Eigen::Dynamic> derivative(const ForceSensorMount& mount,
                                                      const std::vector<SceneParameter>& parameters, double time,
                                                      const Matrix3& R_BT) const;

 private:
  Wrench slopeAt(const TimePlace& place) const;

  std::vector<double> times_;
  std::vector<Wrench> readings_;
};

}  // namespace live_stiffness
