#include "ros/estimate_updater.h"

namespace live_stiffness {

EstimateUpdater::EstimateUpdater(const NodeParameters& parameters, EstimateOutput& output)
    : parameters_(parameters),
      output_(output),
      estimator_(std::make_shared<StiffnessEstimator>(parameters.scene, parameters.model, parameters.estimator)),
      pressures_(parameters, &parameters.scene),
      wrenches_("tip_wrench", parameters.frames, parameters.tip_wrench_timeout) {}

std::optional<Parsed<Pressures>> EstimateUpdater::onPressures(const topic_tools::ShapeShifter& message,
                                                              const std::string& publisher) {
  return use(pressures_.read(message, publisher));
}

std::optional<Parsed<Pressures>> EstimateUpdater::onChannelPressure(const sensor_msgs::FluidPressure& message,
                                                                    size_t channel) {
  return use(pressures_.readChannel(message, channel));
}

std::optional<Parsed<Pressures>> EstimateUpdater::use(std::optional<Parsed<Pressures>> channels) {
  if (!channels) return channels;
  channels->value = pressures_.chambers(channels->value);
  const Pressures& pressures = channels->value;
  pressure_stamp_ = channels->stamp;
  if (is_paused_) return channels;
  const double time = channels->stamp.toSec();
  onSolved(estimator_->setPressures(pressures, time));
  if (estimator_->estimate() != nullptr && estimator_->status().ok())
    history_.add({time, pressures, estimator_->estimate()->solution.X_BT});
  return channels;
}

void EstimateUpdater::onTipWrench(const geometry_msgs::WrenchStamped& message) {
  const Pose* const X_BT = estimator_->estimate() ? &estimator_->estimate()->solution.X_BT : nullptr;
  if (const auto wrench = wrenches_.read(message, X_BT)) onSolved(estimator_->setTipWrench(*wrench));
}

void EstimateUpdater::onHeartbeat() {
  pressures_.status().checkClock();
  if (wrenches_.expires()) onSolved(estimator_->setTipWrench(Wrench::Zero()));
  if (isStale()) putOut();
  else onSolved(estimator_->solve());
}

void EstimateUpdater::onSolved(StiffnessEstimator::Outcome outcome) {
  if (!estimator_->status().ok()) {
    pressures_.status().logError(estimator_->statusText());
    if (outcome == StiffnessEstimator::Outcome::kFailed && failures_++ == 0) first_failure_ = estimator_->statusText();
  } else if (outcome == StiffnessEstimator::Outcome::kSolved) {
    estimate_stamp_ = pressure_stamp_;
  }
  if (outcome != StiffnessEstimator::Outcome::kUnchanged) putOut();
}

std::string EstimateUpdater::newestError() const {
  if (is_paused_) return "paused: call ~pause with false to continue";
  const std::string& input_error = pressures_.status().error();
  return input_error.empty() ? estimator_->statusText() : input_error;
}

// The last good estimate, with its present status.
void EstimateUpdater::putOut() {
  if (estimator_->estimate() == nullptr) return;
  const Estimate& estimate = *estimator_->estimate();
  const auto message =
      boost::make_shared<StiffnessEstimate>(toEstimate(estimate, estimate_stamp_, parameters_.frames.base));
  setStatus(estimator_->status().code, newestError(), pressures_.status().isStale(), parameters_.pressure_timeout,
            "pressures", *message);
  if (is_paused_) message->status = static_cast<uint8_t>(estimator_->status().code);
  output_.onEstimate(message, message->stale ? nullptr : &estimate.solution.X_BT);
}

void EstimateUpdater::setPaused(bool is_paused) {
  is_paused_ = is_paused;
  putOut();
}

void EstimateUpdater::replaceEstimator(std::shared_ptr<StiffnessEstimator> estimator, bool keeps_inputs) {
  estimator_.swap(estimator);  // `estimator` is now the one before
  pressures_.setScene(parameters_.scene);
  history_.clear();
  const Pressures& pressures = estimator->pressures();
  if (keeps_inputs) estimator_->setTipWrench(estimator->tipWrench());
  if (keeps_inputs && pressures.size() == estimator_->model().scene().chamberCount())
    onSolved(estimator_->setPressures(pressures, pressure_stamp_.toSec()));
  else estimate_stamp_ = ros::Time();
}

// A late tracker shows where the robot was then.
KnownState EstimateUpdater::stateAt(const ros::Time& stamp, double delay) const {
  KnownState state;
  const Estimate* const estimate = estimator_->estimate();
  state.newest_wrench = estimator_->tipWrench();
  state.is_known = estimate != nullptr && !isStale() && !history_.empty();
  if (!state.is_known) return state;
  const double time = stamp.toSec() - delay;
  state.solved_wrench = estimate->tip_wrench;
  state.then = delay == 0.0 ? Moment{time, estimator_->pressures(), estimate->solution.X_BT} : history_.at(time);
  return state;
}

}  // namespace live_stiffness
