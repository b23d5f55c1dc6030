#pragma once
// How well an estimated tip force follows the true one, and when contact was reported.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "live_stiffness/TipContact.h"
#include "live_stiffness/conventions.h"
#include "support/estimate_checks.h"

namespace live_stiffness {

struct ContactSample {
  double time = 0.0;  // s
  Vector3 truth = Vector3::Zero(), estimate = Vector3::Zero();  // N, base axes
  Matrix3 compliance = Matrix3::Identity();  // of the tip's translation, estimated, m/N
  bool contact = false;
};

struct ContactScore {
  static constexpr double kTouch = 0.06;  // N; below nothing touches, as the data's README has it
  static constexpr double kSettle = 1.0;  // s that a push and its end may take to be seen

  int pushes = 0;             // times that the force rose above kTouch after at least kSettle below it
  int during = 0;             // samples with a true force of at least kTouch
  double rms = 0.0;           // error of the force over them, N
  double rms_compliant = 0.0;  // the same of its components along the two most compliant principal axes
  double largest_truth = 0.0, largest_estimate = 0.0;  // N
  double seen = 0.0;          // share of samples with contact, of those that have been pushed by 0.15 N for kSettle
  double longest_false = 0.0;  // longest contact with an estimate above 0.1 N while nothing has touched for kSettle, s
};

// samples: in order of time.
inline ContactScore contactScore(const std::vector<ContactSample>& samples) {
  constexpr double kFirm = 0.15, kFalseForce = 0.1;  // N
  ContactScore score;
  double squares = 0.0, compliant_squares = 0.0, touched = -1e9, gentle = -1e9, false_since = -1.0;
  int firm = 0, firm_seen = 0;
  for (const ContactSample& sample : samples) {
    const double truth = sample.truth.norm();
    score.largest_truth = std::max(score.largest_truth, truth);
    score.largest_estimate = std::max(score.largest_estimate, sample.contact ? sample.estimate.norm() : 0.0);
    if (truth < kFirm) gentle = sample.time;
    if (sample.time - gentle > ContactScore::kSettle) {
      ++firm;
      firm_seen += sample.contact;
    }
    if (truth >= ContactScore::kTouch) {
      if (sample.time - touched > ContactScore::kSettle) ++score.pushes;
      touched = sample.time;
      squares += (sample.estimate - sample.truth).squaredNorm();
      const Eigen::SelfAdjointEigenSolver<Matrix3> principal(sample.compliance);
      compliant_squares +=
          (principal.eigenvectors().rightCols<2>().transpose() * (sample.estimate - sample.truth)).squaredNorm();
      ++score.during;
    }
    const bool is_false = sample.contact && sample.estimate.norm() > kFalseForce &&
                          sample.time - touched > ContactScore::kSettle;
    if (!is_false) false_since = -1.0;
    else if (false_since < 0.0) false_since = sample.time;
    if (is_false) score.longest_false = std::max(score.longest_false, sample.time - false_since);
  }
  score.rms = std::sqrt(squares / std::max(1, score.during));
  score.rms_compliant = std::sqrt(compliant_squares / std::max(1, score.during));
  score.seen = static_cast<double>(firm_seen) / std::max(1, firm);
  return score;
}

inline Vector3 vectorFrom(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

// Translational block of its compliance, m/N.
inline Matrix3 translationalCompliance(const TipContact& message) {
  Matrix3 C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C(i, j) = message.compliance[6 * i + j];
  return 0.5 * (C + C.transpose());
}

inline bool isFinite(const TipContact& message) {
  bool finite = positionOf(message.tip_pose).allFinite() && vectorFrom(message.wrench.force).allFinite() &&
                vectorFrom(message.wrench.torque).allFinite() && std::isfinite(message.stiffness_scale) &&
                std::isfinite(message.stiffness_scale_deviation) && std::isfinite(message.innovation);
  for (const auto* values : {&message.covariance, &message.compliance})
    for (double value : *values) finite = finite && std::isfinite(value);
  return finite;
}

}  // namespace live_stiffness
