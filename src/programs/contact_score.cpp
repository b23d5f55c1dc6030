#include "contact_score.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>

#include "estimation/interpolation.h"

namespace live_stiffness {
namespace {

void findDelay(const std::vector<double>& times, const std::vector<Vector3>& truth,
               const std::vector<Vector3>& estimate, ContactScore& score) {
  constexpr int kSteps = 100;
  constexpr double kStep = ContactScore::kSettle / kSteps;
  for (int step = -kSteps; step <= kSteps; ++step) {
    double product = 0.0, truths = 0.0, estimates = 0.0;
    for (size_t i = 0; i < times.size(); ++i) {
      const Vector3 later = interpolated(times, estimate, times[i] + step * kStep);
      product += truth[i].dot(later);
      truths += truth[i].squaredNorm();
      estimates += later.squaredNorm();
    }
    if (!(truths > 0.0 && estimates > 0.0)) continue;
    const double correlation = product / std::sqrt(truths * estimates);
    if (correlation > score.correlation) score.correlation = correlation, score.delay = step * kStep;
  }
}

}  // namespace

ContactScore contactScore(const std::vector<ContactSample>& samples) {
  constexpr double kNever = -kInfinity;
  ContactScore score;
  double touched = kNever, gentle = samples.empty() ? 0.0 : samples.front().time, false_since = 0.0;
  bool was_false = false;
  std::vector<double> times;
  std::vector<Vector3> truths, estimates;  // compliant components
  int firm = 0, firm_seen = 0;
  for (const ContactSample& sample : samples) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> principal(sample.compliance);
    const Eigen::Matrix<double, 3, 2> axes = principal.eigenvectors().rightCols<2>();  // the most compliant ones
    const auto compliant = [&](const Vector3& force) -> Vector3 { return axes * (axes.transpose() * force); };
    times.push_back(sample.time);
    truths.push_back(compliant(sample.truth));
    estimates.push_back(compliant(sample.estimate));
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
      score.rms += (sample.seen * error).squaredNorm();
      score.rms_truth += truth * truth;
      score.rms_compliant += compliant(error).squaredNorm();
      score.rms_compliant_truth += compliant(sample.truth).squaredNorm();
      score.peak_truth = std::max(score.peak_truth, truth);
      score.peak_compliant_truth = std::max(score.peak_compliant_truth, compliant(sample.truth).norm());
      if (sample.contact) {
        score.peak = std::max(score.peak, sample.estimate.norm());
        score.peak_compliant = std::max(score.peak_compliant, compliant(sample.estimate).norm());
      }
      score.stiff_compliance += principal.eigenvalues()[0];
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
  score.stiff_compliance /= std::max(1, score.during);
  score.seen = static_cast<double>(firm_seen) / std::max(1, firm);
  findDelay(times, truths, estimates, score);
  return score;
}

std::string ContactScore::text() const {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(3);
  out << pushes << " pushes, " << during << " samples. Force: RMS error " << rms << " N (of " << rms_truth << " N), peak "
      << peak << " N (measured " << peak_truth << " N). Compliant components: RMS error " << rms_compliant << " N (of "
      << rms_compliant_truth << " N), peak " << peak_compliant << " N (measured " << peak_compliant_truth
      << " N). Along the stiffest axis " << 1e3 * stiff_compliance << " mm/N. Contact seen "
      << 100.0 * seen << " %, longest false " << longest_false << " s. The estimate trails by "
      << 1e3 * delay << " ms (correlation " << correlation << ")";
  return out.str();
}

std::string ContactScore::table() const {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  const std::pair<const char*, double> rows[] = {
      {"pushes", pushes}, {"during", during},
      {"rms_n", rms}, {"rms_truth_n", rms_truth}, {"rms_compliant_n", rms_compliant},
      {"rms_compliant_truth_n", rms_compliant_truth},
      {"peak_n", peak}, {"peak_truth_n", peak_truth}, {"peak_compliant_n", peak_compliant},
      {"peak_compliant_truth_n", peak_compliant_truth}, {"stiff_compliance_m_per_n", stiff_compliance},
      {"seen", seen}, {"longest_false_s", longest_false}, {"delay_s", delay}, {"correlation", correlation}};
  out << "quantity,value\n";
  for (const auto& [quantity, value] : rows) out << quantity << ',' << value << '\n';
  return out.str();
}

}  // namespace live_stiffness
