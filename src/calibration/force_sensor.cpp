#include "calibration/force_sensor.h"

#include <algorithm>
#include <iterator>

#include "estimation/interpolation.h"

namespace live_stiffness {
namespace {

// Prior of each parameter: sensors are mounted by eye, and the sensor's own clock may differ by about a sample. reach: bound
// on the change in both directions; zero: the parameter's range.
struct Prior {
  NumberParameter parameter;
  double sigma, reach;
};
constexpr Prior kPriors[] = {
    {kForceSensorAzimuth, 5.0 * kDegree, 30.0 * kDegree}, {kForceSensorHeight, 0.02, 0.1},
    {kForceSensorCrosstalkX, 0.05, 0.0},                  {kForceSensorCrosstalkY, 0.05, 0.0},
    {kForceSensorDelay, 0.05, 0.0},
};

}  // namespace

Wrench ForceSensorMount::atTip(const Wrench& reading, const Matrix3& R_BT) const {
  if (in_base_axes) return (sign * gains).cwiseProduct(reading);
  Wrench counted = reading;
  counted.head<2>() -= reading[2] * crosstalk;
  const Pose X_TF{expSo3(Vector3(0.0, 0.0, azimuth)), Vector3(0.0, 0.0, height)};
  return wrenchAdjoint({R_BT * X_TF.R, R_BT * X_TF.p}) * (sign * gains).cwiseProduct(counted);
}

Matrix3 ForceSensorMount::seen(const Matrix3& R_BT) const {
  if (in_base_axes) return Vector3(linear(gains)).asDiagonal();
  const Matrix3 R_BF = R_BT * expSo3(Vector3(0.0, 0.0, azimuth));
  return R_BF * Vector3(linear(gains)).asDiagonal() * R_BF.transpose();
}

std::optional<SceneParameter> forceSensorParameter(const std::string& name, const ForceSensorMount& mount) {
  std::optional<SceneParameter> found;
  ForceSensorMount::forEachParameter(mount, [&](const NumberParameter& number, double value) {
    if (name != number.key) return;
    const Prior& prior = *std::find_if(std::begin(kPriors), std::end(kPriors),
                                       [&](const Prior& entry) { return name == entry.parameter.key; });
    const double low = prior.reach > 0.0 ? value - prior.reach : number.range.low;
    const double high = prior.reach > 0.0 ? value + prior.reach : number.range.high;
    found = SceneParameter{name, nullptr, {}, value, value, prior.sigma, low, high, number.unit, 1e-3 * prior.sigma};
  });
  return found;
}

std::vector<std::string> forceSensorParameterNames() {
  std::vector<std::string> names;
  for (const Prior& prior : kPriors) names.emplace_back(prior.parameter.key);
  return names;
}

ForceSensorMount withParameters(const ForceSensorMount& mount, const std::vector<SceneParameter>& parameters,
                                const Eigen::VectorXd& values) {
  ForceSensorMount result = mount;
  ForceSensorMount::forEachParameter(result, [&](const NumberParameter& number, double& value) {
    for (size_t k = 0; k < parameters.size(); ++k)
      if (parameters[k].name == number.key) value = values[static_cast<long>(k)];
  });
  return result;
}

ForceReadings::ForceReadings(const Recording& recording) {
  for (const RecordedSample& sample : recording.samples) {
    if (!sample.tip_wrench) continue;
    times_.push_back(sample.time);
    readings_.push_back(*sample.tip_wrench);
  }
}

Wrench ForceReadings::atTip(const ForceSensorMount& mount, double time, const Matrix3& R_BT) const {
  return mount.atTip(interpolated(times_, readings_, time + mount.delay), R_BT);
}

}  // namespace live_stiffness
