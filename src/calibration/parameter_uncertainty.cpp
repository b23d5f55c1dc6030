#include "calibration/parameter_uncertainty.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

constexpr double kMostTurnError = 5.0;     // deg, and
constexpr double kMostOffsetError = 5e-3;  // m: with larger errors a registration counts as not determined

// Inverse of a symmetric matrix that may be singular, by eigenvalues; directions without information get a huge
// variance.
Eigen::MatrixXd inverseInformation(const Eigen::MatrixXd& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  const double least = 1e-12 * std::max(1.0, eigen.eigenvalues().cwiseAbs().maxCoeff());
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(least).cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace

void describeParameters(const CalibrationProblem& problem, const std::vector<SceneParameter>& parameters,
                        const CalibrationProblem::Solution& solution, size_t recordings, bool use_priors,
                        CalibrationResult& result) {
  const long count = static_cast<long>(parameters.size());
  const long rest = solution.jacobian.cols() - count;
  Eigen::MatrixXd information = solution.jacobian.transpose() * solution.jacobian;
  for (long at = count; at < information.cols(); at += kRegistrationSize)  // the weak prior on the sensor's offset
    information.diagonal().segment(at + 6, 3).array() += 1.0 / (kOffsetSigma * kOffsetSigma);
  // Information of the data about the parameters, registrations eliminated, in units of the priors' information.
  Eigen::MatrixXd data = information.topLeftCorner(count, count);
  if (rest > 0 && count > 0)
    data -= information.topRightCorner(count, rest) * inverseInformation(information.bottomRightCorner(rest, rest)) *
            information.bottomLeftCorner(rest, count);
  const Eigen::MatrixXd prior = Eigen::MatrixXd::Identity(count, count) * (use_priors ? 1.0 : 0.0);
  const Eigen::MatrixXd covariance = count > 0 ? inverseInformation(data + prior) : Eigen::MatrixXd();
  const Eigen::MatrixXd data_covariance = count > 0 ? inverseInformation(data) : Eigen::MatrixXd();
  const Eigen::VectorXd values = problem.values(solution.unknowns.x);
  for (long k = 0; k < count; ++k) {
    const SceneParameter& p = parameters[static_cast<size_t>(k)];
    const double near = 1e-6 * (p.high - p.low);
    const double value = valueIn(result.scene, p, values[k]);
    result.parameters.push_back({p, value, p.prior_sigma * std::sqrt(covariance(k, k)),
                                 p.prior_sigma * std::sqrt(data_covariance(k, k)),
                                 values[k] < p.low + near || values[k] > p.high - near || std::abs(value - values[k]) > near});
  }
  if (count > 0) {
    const Eigen::VectorXd deviation = covariance.diagonal().cwiseSqrt();
    result.correlation = covariance.cwiseQuotient(deviation * deviation.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(data);
    for (long k = 0; k < count && eigen.eigenvalues()[k] < 1.0; ++k)
      result.undetermined.push_back({eigen.eigenvectors().col(k), std::max(0.0, eigen.eigenvalues()[k])});
  }
  // Registrations, including the uncertainty of the parameters.
  for (size_t n = 0; n < recordings && rest == 0; ++n) {
    result.recordings[n].determined = true;
    result.recordings[n].verdict = "given";
  }
  if (rest == 0) return;
  if (count > 0) information.topLeftCorner(count, count) += prior;
  const Eigen::MatrixXd all = inverseInformation(information);
  for (size_t n = 0; n < recordings; ++n) {
    const long at = count + static_cast<long>(problem.registrationIndex(n)) * kRegistrationSize;
    const double turn = degrees(std::sqrt(all.diagonal().segment(at, 3).maxCoeff()));
    const double offset = std::sqrt(all.diagonal().segment(at + 6, 3).maxCoeff());
    RecordingFit& fit = result.recordings[n];
    fit.determined = turn < kMostTurnError && offset < kMostOffsetError;
    fit.verdict = std::string(fit.determined ? "determined" : "NOT determined by these data") + ": base rotation +- " +
                  numberText(turn) + " deg, sensor offset +- " + numberText(1e3 * offset) + " mm";
    if (!fit.determined) fit.verdict += "; bend the robot far in at least two directions, or measure the offset";
  }
}

}  // namespace live_stiffness
