#include "calibration/force_sensor.h"

#include <ceres/jet.h>

namespace live_stiffness {
namespace {

// Prior of each parameter: sensors are mounted by eye, and the sensor's own clock may differ by about a sample. reach: bound
// on the change in both directions; zero: the parameter's range.
struct KnownNumber {
  NumberParameter parameter;
  ParameterKind kind;
  double sigma, reach;
};
constexpr KnownNumber kKnownNumbers[] = {
    {kForceSensorAzimuth, ParameterKind::kForceSensorAzimuth, 5.0 * kDegree, 30.0 * kDegree},
    {kForceSensorHeight, ParameterKind::kForceSensorHeight, 0.02, 0.1},
    {kForceSensorCrosstalkX, ParameterKind::kForceSensorCrosstalkX, 0.05, 0.0},
    {kForceSensorCrosstalkY, ParameterKind::kForceSensorCrosstalkY, 0.05, 0.0},
    {kForceSensorDelay, ParameterKind::kForceSensorDelay, 0.05, 0.0},
};

// The member of the mount that a parameter names, or nullptr.
template <class T>
T* numberOf(ForceSensorMountOf<T>& mount, ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kForceSensorAzimuth: return &mount.azimuth;
    case ParameterKind::kForceSensorHeight: return &mount.height;
    case ParameterKind::kForceSensorCrosstalkX: return &mount.crosstalk[0];
    case ParameterKind::kForceSensorCrosstalkY: return &mount.crosstalk[1];
    case ParameterKind::kForceSensorDelay: return &mount.delay;
    default: return nullptr;
  }
}

constexpr int kNumbers = 5;
using MountJet = ceres::Jet<double, kNumbers>;

}  // namespace

std::optional<SceneParameter> forceSensorParameter(const std::string& name, const ForceSensorMount& mount) {
  ForceSensorMount numbers = mount;
  for (const KnownNumber& known : kKnownNumbers) {
    if (name != known.parameter.key) continue;
    SceneParameter parameter;
    parameter.name = name;
    parameter.kind = known.kind;
    parameter.start = parameter.prior_mean = *numberOf(numbers, known.kind);
    parameter.prior_sigma = known.sigma;
    parameter.low = known.reach > 0.0 ? parameter.start - known.reach : known.parameter.range.low;
    parameter.high = known.reach > 0.0 ? parameter.start + known.reach : known.parameter.range.high;
    parameter.unit = known.parameter.unit;
    return parameter;
  }
  return std::nullopt;
}

const std::vector<std::string>& forceSensorParameterNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const KnownNumber& known : kKnownNumbers) all.emplace_back(known.parameter.key);
    return all;
  }();
  return names;
}

ForceSensorMount withParameters(const ForceSensorMount& mount, const std::vector<SceneParameter>& parameters,
                                const Eigen::VectorXd& values) {
  ForceSensorMount result = mount;
  for (size_t k = 0; k < parameters.size(); ++k)
    if (double* number = numberOf(result, parameters[k].kind)) *number = values[static_cast<long>(k)];
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
  return mount.atTip(valueAt(readings_, placeIn(times_, time + mount.delay)), R_BT);
}

// Time derivative. At the time of a reading (a sensor without delay) the mean of both sides. Zero outside the readings.
Wrench ForceReadings::slopeAt(const TimePlace& place) const {
  const auto slopeFrom = [&](size_t i) {
    return Wrench((readings_[i + 1] - readings_[i]) / (times_[i + 1] - times_[i]));
  };
  if (place.share > 0.0 && place.share < 1.0) return slopeFrom(place.before);
  if (place.share > 0.0 || place.before == 0) return Wrench::Zero();
  return 0.5 * (slopeFrom(place.before - 1) + slopeFrom(place.before));
}

Eigen::Matrix<double, 6, Eigen::Dynamic> ForceReadings::derivative(const ForceSensorMount& mount,
                                                                   const std::vector<SceneParameter>& parameters,
                                                                   double time, const Matrix3& R_BT) const {
  ForceSensorMountOf<MountJet> seeded;
  seeded.sign = mount.sign;
  seeded.gains = mount.gains;
  ForceSensorMount numbers = mount;
  for (int k = 0; k < kNumbers; ++k)
    *numberOf(seeded, kKnownNumbers[k].kind) = MountJet(*numberOf(numbers, kKnownNumbers[k].kind), k);
  const TimePlace place = placeIn(times_, time + mount.delay);
  const Wrench reading = valueAt(readings_, place), slope = slopeAt(place);
  Eigen::Matrix<MountJet, 6, 1> read;
  for (int i = 0; i < 6; ++i) read[i] = MountJet(reading[i]) + slope[i] * (seeded.delay - mount.delay);
  const Eigen::Matrix<MountJet, 6, 1> wrench = seeded.atTip(read, R_BT);
  Eigen::Matrix<double, 6, Eigen::Dynamic> derivative(6, static_cast<long>(parameters.size()));
  derivative.setZero();
  for (size_t k = 0; k < parameters.size(); ++k)
    for (int n = 0; n < kNumbers; ++n)
      if (parameters[k].kind == kKnownNumbers[n].kind)
        for (int i = 0; i < 6; ++i) derivative(i, static_cast<long>(k)) = wrench[i].v[n];
  return derivative;
}

}  // namespace live_stiffness
