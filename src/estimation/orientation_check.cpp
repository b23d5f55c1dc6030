#include "estimation/orientation_check.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "estimation/position_fit.h"
#include "live_stiffness/estimation/error_summary.h"

namespace live_stiffness {
namespace {

constexpr double kMuchBetter = 1.0 / 3.0;       // of the error: model error cannot do this, as it stays in all readings
constexpr double kBetter = 0.75;                // the same of positions alone; never reached by models that are not mirrored
constexpr double kAlike = 1.5;                  // readings whose errors differ less are not told apart
constexpr double kSame = 0.05;                  // so near, errors of positions do not tell one fit from another
constexpr double kDoubtful = 0.5;               // of what the tips turn by: with a larger error they hardly agree
constexpr double kLeastTurn = 2.0 * kDegree;     // errors and differences below this say nothing
constexpr double kLeastDistance = 0.003;        // the same of positions, relative to the rms length of the arm
constexpr double kFollows = 0.5;                // correlation above which measured turns belong to predicted ones
constexpr double kOutlier = 10.0;               // median residuals

constexpr const char* kAxes[] = {"x", "y", "z"};

Matrix3 mirrorAcross(int axis) {
  Vector3 signs = Vector3::Ones();
  if (axis >= 0) signs[axis] = -1.0;
  return signs.asDiagonal();
}

std::string number(double value, const std::string& unit) {
  char text[32];
  std::snprintf(text, sizeof text, value < 10.0 ? "%.1f " : "%.0f ", value);
  return text + unit;
}
std::string degreesText(double angle) { return number(degrees(angle), "deg"); }
std::string millimetres(double distance) { return number(1e3 * distance, "mm"); }

struct Samples {
  std::vector<Pose> X_BT, X_AS;
};

PositionFit fitPositions(const Samples& samples) { return fitPositions(samples.X_BT, samples.X_AS, false); }

std::vector<Pose> applied(const PoseReading& reading, std::vector<Pose> poses) {
  for (Pose& X : poses) X = apply(reading, X);
  return poses;
}

// Mean angle left by the best constant rotation of the sensor.
double rotationError(const Matrix3& R_AB, const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS,
                     TrackerMeasures measures) {
  const Matrix3 R_TS = sensorRotation(R_AB, X_BT, X_AS, measures);
  double sum = 0.0;
  for (size_t i = 0; i < X_BT.size(); ++i) sum += rotationBetween(R_AB * X_BT[i].R * R_TS, X_AS[i].R, measures);
  return sum / static_cast<double>(X_BT.size());
}

// Rotation vectors from the mean orientation, in the axes in which the poses are given, and their mean length.
std::vector<Vector3> turns(const std::vector<Pose>& poses, double& mean_length) {
  Matrix3 sum = Matrix3::Zero();
  for (const Pose& X : poses) sum += X.R;
  const Matrix3 mean = nearestRotation(sum);
  std::vector<Vector3> vectors;
  mean_length = 0.0;
  for (const Pose& X : poses) {
    vectors.push_back(logSo3(X.R * mean.transpose()));
    mean_length += vectors.back().norm() / static_cast<double>(poses.size());
  }
  return vectors;
}

double sumOfSingularValues(const Matrix3& M) {  // of the square, as gcc suspects Eigen's own to be uninitialised
  const Eigen::SelfAdjointEigenSolver<Matrix3> square(M.transpose() * M, Eigen::EigenvaluesOnly);
  return square.eigenvalues().cwiseMax(0.0).cwiseSqrt().sum();
}

// How measured turns u follow predicted ones R v, without regard to their size.
struct Following {
  double as_given = 0.0;   // correlation, -1 to 1
  double in_any_axes = 0.0;  // with v turned or mirrored so that it is largest, 0 to 1
};
Following following(const Matrix3& R, const std::vector<Vector3>& v, const std::vector<Vector3>& u) {
  Matrix3 products = Matrix3::Zero();
  double squares_u = 0.0, squares_v = 0.0;
  for (size_t i = 0; i < u.size(); ++i) {
    products += u[i] * (R * v[i]).transpose();
    squares_u += u[i].squaredNorm();
    squares_v += v[i].squaredNorm();
  }
  const double scale = std::sqrt(squares_u * squares_v) + 1e-300;
  return {products.trace() / scale, sumOfSingularValues(products) / scale};
}

// Whether the turn of a measured orientation about its z axis means nothing: it jumps from sample to sample, is far off, or
// was never measured (a driver then sets the quaternion's z to zero). A robot that twists does none of these.
bool turnIsNoise(const Matrix3& R_AB, const Samples& samples) {
  const Matrix3 R_TS =
      sensorRotation(R_AB, samples.X_BT, samples.X_AS, TrackerMeasures::kPositionAndAxis);
  std::vector<Pose> levelled;  // measured orientation in the axes of the expected one, which has the measured z axis
  Matrix3 sum = Matrix3::Zero();
  bool has_z = false;
  for (size_t i = 0; i < samples.X_BT.size(); ++i) {
    const Pose expected{R_AB * samples.X_BT[i].R * R_TS, Vector3::Zero()};
    const Pose smallest = completedPose(samples.X_AS[i], expected, TrackerMeasures::kPositionAndAxis);
    levelled.push_back({smallest.R.transpose() * samples.X_AS[i].R, Vector3::Zero()});
    sum += levelled.back().R;
    has_z = has_z || std::abs(Eigen::Quaterniond(samples.X_AS[i].R).z()) > 1e-4;
  }
  const Matrix3 mean = nearestRotation(sum);
  double size = 0.0, jump = 0.0;
  for (size_t i = 0; i < levelled.size(); ++i) {
    size += logSo3(mean.transpose() * levelled[i].R).norm();
    if (i > 0) jump += logSo3(levelled[i - 1].R.transpose() * levelled[i].R).norm();
  }
  constexpr double kFarOff = 30.0 * kDegree, kJumps = 0.5;  // independent errors jump by 1.3 times their size
  return !has_z || size > kFarOff * static_cast<double>(levelled.size()) || jump > kJumps * size;
}

std::vector<PoseReading> readingsToTry(bool mirrored) {
  using Order = PoseReading::Order;
  const std::vector<PoseReading> orders{{Order::kAsGiven, false}, {Order::kXyzw, false}, {Order::kWxyz, false},
                                        {Order::kAsGiven, true},  {Order::kXyzw, true},  {Order::kWxyz, true}};
  std::vector<PoseReading> readings;
  if (!mirrored) {
    readings.assign(orders.begin() + 1, orders.end());
    for (bool inverse : {false, true})
      for (int axis = 0; axis < 3; ++axis) readings.push_back({Order::kAsGiven, inverse, axis, -1});
    return readings;
  }
  readings.push_back({Order::kAsGiven, false, 1, 1});  // mirrors across x or z differ from it by a rotation of the frame
  for (const PoseReading& order : orders)
    for (int axis : {1, 0, 2}) readings.push_back({order.order, order.inverse, -1, axis});
  return readings;
}

// Without samples far from a first fit.
Samples withoutOutliers(const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS) {
  const Samples all{X_BT, X_AS};
  const std::vector<double> residuals = fitPositions(all).residuals;
  const double limit = kOutlier * quantile(residuals, 0.5);
  Samples kept;
  for (size_t i = 0; i < residuals.size(); ++i) {
    if (residuals[i] > limit) continue;
    kept.X_BT.push_back(X_BT[i]);
    kept.X_AS.push_back(X_AS[i]);
  }
  return kept.X_BT.size() < 3 ? all : kept;
}

struct BestReadings {
  std::vector<PoseReading> readings;  // in which the orientations fit about as well as in the best one
  double error = 0.0;                 // of the best one, rad
};

// R_AB: of the positions, and of those mirrored across y; nothing of those that are out of the question.
BestReadings bestReadings(const Samples& samples, const std::optional<Matrix3>& R_AB, const std::optional<Matrix3>& R_AB_mirrored,
                          TrackerMeasures measures) {
  std::vector<std::pair<PoseReading, double>> errors;
  for (const bool mirrored : {false, true}) {
    if (!(mirrored ? R_AB_mirrored : R_AB)) continue;
    for (const PoseReading& reading : readingsToTry(mirrored)) {
      const Matrix3 R =
          mirrored ? Matrix3(mirrorAcross(reading.mirrored_position) * mirrorAcross(1) * *R_AB_mirrored) : *R_AB;
      errors.emplace_back(reading, rotationError(R, samples.X_BT, applied(reading, samples.X_AS), measures));
    }
  }
  BestReadings best;
  best.error = errors.front().second;
  for (const auto& tried : errors) best.error = std::min(best.error, tried.second);
  std::vector<double> kept;
  for (const auto& [reading, of_reading] : errors) {
    const double error = of_reading;
    // Readings that differ by a constant rotation alone have the same error: each of them is right.
    const bool known = std::any_of(kept.begin(), kept.end(), [&](double other) { return std::abs(other - error) < 1e-9; });
    if (known || error > kAlike * best.error + radians(0.2)) continue;
    best.readings.push_back(reading);
    kept.push_back(error);
  }
  return best;
}

}  // namespace

std::string PoseReading::text() const {
  std::vector<std::string> parts;
  const bool left_handed = mirrored_rotation >= 0 && mirrored_rotation == mirrored_position;
  if (left_handed) parts.push_back(std::string("taken from a left-handed frame (") + kAxes[mirrored_position] + " mirrored)");
  if (order != Order::kAsGiven) parts.push_back(order == Order::kXyzw ? "read as x, y, z, w" : "read as w, x, y, z");
  const std::string others[] = {"qy and qz", "qx and qz", "qx and qy"};
  if (mirrored_rotation >= 0 && !left_handed)
    parts.push_back("read with " + (inverse ? std::string("q") + kAxes[mirrored_rotation] : others[mirrored_rotation]) +
                    " negated");
  else if (inverse) parts.push_back("inverted (the tracker as seen from the sensor was given)");
  if (mirrored_position >= 0 && !left_handed)
    parts.push_back(std::string("taken with ") + kAxes[mirrored_position] + " of the positions negated");
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : " and ") + part;
  return text;
}

Pose apply(const PoseReading& reading, const Pose& X_AS) {
  Eigen::Quaterniond q(X_AS.R);
  if (reading.order == PoseReading::Order::kXyzw) q = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
  if (reading.order == PoseReading::Order::kWxyz) q = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w());
  if (reading.inverse) q = q.conjugate();
  const Matrix3 mirror = mirrorAcross(reading.mirrored_rotation);
  return {mirror * q.toRotationMatrix() * mirror, mirrorAcross(reading.mirrored_position) * X_AS.p};
}

Recording apply(const PoseReading& reading, Recording recording) {
  for (size_t i = 0; i < recording.samples.size(); ++i) {
    RecordedSample& sample = recording.samples[i];
    const Pose X_AS = apply(reading, sample.tipPose());
    sample.tip_position = X_AS.p;
    sample.tip_orientation = Eigen::Quaterniond(X_AS.R);
    if (i > 0 && sample.tip_orientation.dot(recording.samples[i - 1].tip_orientation) < 0.0)
      sample.tip_orientation.coeffs() *= -1.0;
    if (sample.base_position) *sample.base_position = mirrorAcross(reading.mirrored_position) * *sample.base_position;
  }
  return recording;
}

OrientationCheck checkOrientations(const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS,
                                   std::optional<TrackerMeasures> told) {
  OrientationCheck check;
  check.measures = told.value_or(TrackerMeasures::kPose);
  const Samples samples = withoutOutliers(X_BT, X_AS);
  const PositionFit fit = fitPositions(samples);
  const double rms = check.position_as_given = check.position_as_read = summarizeErrors(fit.residuals).rms;

  Samples mirror = samples;
  mirror.X_AS = applied({PoseReading::Order::kAsGiven, false, -1, 1}, mirror.X_AS);
  const PositionFit of_mirror = fitPositions(mirror);
  const double mirror_rms = summarizeErrors(of_mirror.residuals).rms;
  Vector3 mean = Vector3::Zero();
  double squares = 0.0, spread = 0.0;
  for (const Pose& X : samples.X_BT) mean += X.p / static_cast<double>(samples.X_BT.size());
  for (const Pose& X : samples.X_BT) {
    squares += X.p.squaredNorm() / static_cast<double>(samples.X_BT.size());
    spread += (X.p - mean).squaredNorm() / static_cast<double>(samples.X_BT.size());
  }
  // A mirrored small motion fits almost as well with the base upside down; then orientations decide.
  const bool orientations_decide = check.measures != TrackerMeasures::kPosition;
  const bool mirrored = mirror_rms < (orientations_decide ? kMuchBetter : kBetter) * rms &&
                        rms - mirror_rms > kLeastDistance * std::sqrt(squares);
  std::optional<Matrix3> R_AB_not_mirrored, R_AB_mirrored;
  if (!mirrored) R_AB_not_mirrored = fit.X_AB.R;
  if (mirror_rms < rms) R_AB_mirrored = of_mirror.X_AB.R;
  const Matrix3& R_AB = fit.X_AB.R;
  const bool in_one_plane = std::abs(mirror_rms - rms) < kSame * rms;
  if (mirrored) {
    check.position_as_read = mirror_rms;
    check.readings = {{PoseReading::Order::kAsGiven, false, -1, 1}};
  }
  if (check.measures == TrackerMeasures::kPosition) return check;
  double predicted_turn = 0.0, measured_turn = 0.0;
  const std::vector<Vector3> v = turns(samples.X_BT, predicted_turn), u = turns(samples.X_AS, measured_turn);
  const auto is_doubtful = [&](double error) { return error > std::max(kLeastTurn, kDoubtful * predicted_turn); };
  // Of a motion in one plane the base has two sides on which it could be; orientations decide.
  const PositionFit other = fitPositions(samples.X_BT, samples.X_AS, true);
  const bool as_good = summarizeErrors(other.residuals).rms < (1.0 + kSame) * rms;
  const auto error_as_given = [&](TrackerMeasures measures) {
    const double error = rotationError(R_AB, samples.X_BT, samples.X_AS, measures);
    return as_good ? std::min(error, rotationError(other.X_AB.R, samples.X_BT, samples.X_AS, measures)) : error;
  };
  const auto readings_found = [&](TrackerMeasures measures) {
    if (in_one_plane) return false;  // several readings look alike
    const BestReadings best = bestReadings(samples, R_AB_not_mirrored, R_AB_mirrored, measures);
    const double given = error_as_given(measures);
    const bool much_better = best.error < kMuchBetter * given && given - best.error > kLeastTurn;
    if (mirrored ? is_doubtful(best.error) : !much_better) return false;
    if (measures != check.measures && !turnIsNoise(R_AB, {samples.X_BT, applied(best.readings.front(), samples.X_AS)}))
      return false;
    check.readings = best.readings;
    check.position_as_read = best.readings.front().mirrored_position >= 0 ? mirror_rms : rms;
    check.rotation_as_given = given;
    check.rotation_as_read = best.error;
    return true;
  };
  const double given = check.rotation_as_given = check.rotation_as_read = error_as_given(check.measures);
  if (readings_found(check.measures)) return check;
  // A mirror across the robot's own axis leaves its orientations as they are; the sensor's offset hides most of the rest.
  for (int axis = 0; axis < 3 && !mirrored; ++axis) {
    if (mirror_rms > kBetter * rms || rms - mirror_rms < kLeastDistance * std::sqrt(squares)) break;
    const Matrix3 R = mirrorAcross(axis) * mirrorAcross(1) * of_mirror.X_AB.R;
    const double as_read = rotationError(R, samples.X_BT, samples.X_AS, check.measures);
    if (is_doubtful(as_read)) continue;
    check.readings = {{PoseReading::Order::kAsGiven, false, -1, axis}};
    check.position_as_read = mirror_rms;
    return check;
  }
  if (!mirrored && !is_doubtful(given)) return check;

  const auto take_as = [&](TrackerMeasures measures, const std::string& reason) {
    check.reason = reason;
    check.unexplained = told.has_value();
    if (told) check.reason += ", but was told to be measured";
    else check.measures = measures;
    if (check.measures == TrackerMeasures::kPosition) {  // then positions alone say whether they are mirrored
      const OrientationCheck of_positions = checkOrientations(X_BT, X_AS, TrackerMeasures::kPosition);
      check.readings = of_positions.readings;
      check.position_as_read = of_positions.position_as_read;
      check.rotation_as_given = check.rotation_as_read = 0.0;
    }
    return check;
  };
  constexpr double kConstant = 0.2;
  if (predicted_turn > kLeastTurn && measured_turn < kConstant * predicted_turn)
    return take_as(TrackerMeasures::kPosition, "the orientation hardly changes (by " + degreesText(measured_turn) +
                                                   ") while the tip turns by " + degreesText(predicted_turn));
  // Where even the positions do not follow, the model or the pressures are wrong.
  if (in_one_plane || check.position_as_read > kDoubtful * std::sqrt(spread)) return check;
  if (check.measures == TrackerMeasures::kPose) {
    const double axis_error = error_as_given(TrackerMeasures::kPositionAndAxis);
    const bool fits = !mirrored && axis_error < kMuchBetter * given && !is_doubtful(axis_error) && turnIsNoise(R_AB, samples);
    if (fits || readings_found(TrackerMeasures::kPositionAndAxis))
      return take_as(TrackerMeasures::kPositionAndAxis,
                     "the z axis fits to " + degreesText(fits ? axis_error : check.rotation_as_read) +
                         ", while the turn about it means nothing (whole orientation: " + degreesText(given) + ")");
  }
  const Following follows = following(R_AB, v, u);
  if (follows.in_any_axes < kFollows)
    return take_as(TrackerMeasures::kPosition, "the orientation does not follow the tip (" + degreesText(given) + " off)");
  if (mirrored || follows.as_given < kFollows) {
    check.unexplained = true;
    check.reason = "the orientation is off by " + degreesText(given) + " while the tip turns by " + degreesText(predicted_turn) +
                   ", in every reading that was tried: is it given in the same axes as the position? "
                   "(tracker_measures: position does without it)";
  }
  return check;
}

std::string OrientationCheck::text() const {
  std::string text = reason;
  if (!reason.empty() && !unexplained) text += ": taken as tracker_measures: " + trackerMeasuresName(measures);
  if (readings.empty()) return text;
  std::string how;
  for (const PoseReading& reading : readings) how += (how.empty() ? "" : ", or ") + reading.text();
  const bool mirrored = readings.front().mirrored_position >= 0, turned = rotation_as_read < rotation_as_given;
  if (!text.empty()) text += "; ";
  text += std::string("the ") + (mirrored ? (turned ? "poses" : "positions") : "orientations") + " fit when " + how + ": ";
  if (mirrored) text += millimetres(position_as_read) + " instead of " + millimetres(position_as_given);
  if (turned)
    text += (mirrored ? ", " : "") + degreesText(rotation_as_read) + " instead of " + degreesText(rotation_as_given);
  if (readings.size() > 1) text += "; this motion does not tell which: bend in more directions";
  if (mirrored) text += "; or two pressure channels are swapped";
  return text;
}

Matrix3 sensorRotation(const Matrix3& R_AB, const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS,
                       TrackerMeasures measures) {
  if (measures == TrackerMeasures::kPosition) return Matrix3::Identity();
  Matrix3 sum = Matrix3::Zero();
  for (size_t i = 0; i < X_BT.size(); ++i) sum += (R_AB * X_BT[i].R).transpose() * X_AS[i].R;
  if (measures == TrackerMeasures::kPose) return nearestRotation(sum);
  return Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), sum.col(2)).toRotationMatrix();
}

double rotationBetween(const Matrix3& a, const Matrix3& b, TrackerMeasures measures) {
  if (measures == TrackerMeasures::kPosition) return 0.0;
  if (measures == TrackerMeasures::kPose) return logSo3(a.transpose() * b).norm();
  const Vector3 z = a.col(2), other = b.col(2);
  return std::atan2(z.cross(other).norm(), z.dot(other));
}

}  // namespace live_stiffness
