#include "live_stiffness/estimation/contact_score.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace live_stiffness {

ContactScore contactScore(const std::vector<ContactSample>& samples) {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  ContactScore score;
  double touched = kNever, gentle = samples.empty() ? 0.0 : samples.front().time, false_since = 0.0;
  bool was_false = false;
  int firm = 0, firm_seen = 0;
  for (const ContactSample& sample : samples) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> principal(sample.compliance);
    const auto compliant = [&](const Vector3& force) {
      return (principal.eigenvectors().rightCols<2>().transpose() * force).eval();
    };
    const double truth = sample.truth.norm();
    if (truth < ContactScore::kFirm) gentle = sample.time;
    if (sample.time - gentle > ContactScore::kSettle) {
      ++firm;
      firm_seen += sample.contact;
    }
    if (truth >= ContactScore::kTouch) {
      if (sample.time - touched > ContactScore::kSettle) ++score.pushes;
      touched = sample.time;
      const Vector3 error = sample.estimate - sample.truth;
      score.rms += error.squaredNorm();
      score.rms_truth += truth * truth;
      score.rms_compliant += compliant(error).squaredNorm();
      score.rms_compliant_truth += compliant(sample.truth).squaredNorm();
      score.peak_truth = std::max(score.peak_truth, truth);
      score.peak_compliant_truth = std::max(score.peak_compliant_truth, compliant(sample.truth).norm());
      if (sample.contact) {
        score.peak = std::max(score.peak, sample.estimate.norm());
        score.peak_compliant = std::max(score.peak_compliant, compliant(sample.estimate).norm());
      }
      ++score.during;
    }
    const bool is_false = sample.contact && sample.estimate.norm() > ContactScore::kFalse &&
                          sample.time - touched > ContactScore::kSettle;
    if (is_false && !was_false) false_since = sample.time;
    if (is_false) score.longest_false = std::max(score.longest_false, sample.time - false_since);
    was_false = is_false;
  }
  for (double* sum : {&score.rms, &score.rms_truth, &score.rms_compliant, &score.rms_compliant_truth})
    *sum = std::sqrt(*sum / std::max(1, score.during));
  score.seen = static_cast<double>(firm_seen) / std::max(1, firm);
  return score;
}

std::string ContactScore::text() const {
  std::ostringstream out;
  out.precision(3);
  out << pushes << " pushes, " << during << " samples. Force: RMS error " << rms << " N (of " << rms_truth << " N), peak "
      << peak << " N (measured " << peak_truth << " N). Compliant components: RMS error " << rms_compliant << " N (of "
      << rms_compliant_truth << " N), peak " << peak_compliant << " N (measured " << peak_compliant_truth
      << " N). Contact seen " << 100.0 * seen << " %, longest false " << longest_false << " s";
  return out.str();
}

}  // namespace live_stiffness
