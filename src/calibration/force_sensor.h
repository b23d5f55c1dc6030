#pragma once
// A force sensor on the tip: how it sits there, and what its readings come to as a wrench on the robot.

#include <optional>
#include <string>
#include <vector>

#include "calibration/scene_parameter.h"
#include "estimation/interpolation.h"
#include "live_stiffness/estimation/recording.h"

namespace live_stiffness {

// Its axes F are turned about z of T, its origin is on that axis. T is double, or a type that carries derivatives.
template <class T>
struct ForceSensorMountOf {
  T azimuth = T(0.0);    // rad
  T height = T(0.0);     // of its origin above T along z of T, m
  double sign = 1.0;     // 1: it reports what acts on the robot; -1: what the robot exerts
  Wrench gains = Wrench::Ones();  // of its channels [f; m], own axes; 0: that channel is left out
  // Shares of its fz that show in fx and fy, by crosstalk or because its axis leans; they are taken off, -.
  Vector2Of<T> crosstalk = Vector2Of<T>::Constant(T(0.0));
  T delay = T(0.0);      // by which its readings are late against the pressures, s

  // Dead wrench at T in base axes of a reading [f; m] (its own axes and origin; N, N m), the tip oriented as R_BT. Its
  // delay is the reader's affair.
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

  // 3x3: projects a force (base axes) on what the channels that count can see of it.
  Matrix3 seen(const Matrix3& R_BT) const {
    const Matrix3 R_BF = R_BT * expSo3(Vector3(0.0, 0.0, azimuth));
    return R_BF * Vector3(linear(gains)).asDiagonal() * R_BF.transpose();
  }
};
using ForceSensorMount = ForceSensorMountOf<double>;

// What a calibration may fit of it: force_sensor_azimuth_deg, force_sensor_height_m, force_sensor_crosstalk_x and _y,
// force_sensor_delay_s; its start is the mount's value. nullopt: another name.
std::optional<SceneParameter> forceSensorParameter(const std::string& name, const ForceSensorMount& mount);
const std::vector<std::string>& forceSensorParameterNames();

// The mount with those of the parameters that are its own at these values (SI).
ForceSensorMount withParameters(const ForceSensorMount& mount, const std::vector<SceneParameter>& parameters,
                                const Eigen::VectorXd& values);

// A sensor's readings along a recording, which must have one at least where they are asked for.
class ForceReadings {
 public:
  explicit ForceReadings(const Recording& recording);

  // What the sensor felt at `time` (s): its reading of `delay` later as a dead wrench at T in base axes, the tip oriented
  // as R_BT. Linear between readings, the nearest one outside.
  Wrench atTip(const ForceSensorMount& mount, double time, const Matrix3& R_BT) const;
  // Its derivatives by the parameters (SI), 6 x parameters; zero by those of the scene.
  Eigen::Matrix<double, 6, Eigen::Dynamic> derivative(const ForceSensorMount& mount,
                                                      const std::vector<SceneParameter>& parameters, double time,
                                                      const Matrix3& R_BT) const;

 private:
  Wrench slopeAt(const TimePlace& place) const;

  std::vector<double> times_;
  std::vector<Wrench> readings_;
};

}  // namespace live_stiffness
