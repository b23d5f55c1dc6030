#include "ros/tip_handle.h"

#include <algorithm>
#include <cstdio>

#include "live_stiffness/analysis/holding_wrench.h"
#include "ros/conversions.h"

namespace live_stiffness {
namespace {

using interactive_markers::MenuHandler;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::InteractiveMarkerFeedback;

constexpr char kOtherShape[] = "no ghost: the robot is in another stable shape than the one it takes from rest";

constexpr char kName[] = "tip";  // of the interactive marker

// Of the questions, in their order.
constexpr const char* kTitles[] = {"Drag the tip: force that holds it at the position",
                                   "Drag the tip: wrench that holds it at the pose", "Apply a wrench: deflection"};

std::string wrenchText(const Wrench& wrench) {
  char text[120];
  const Vector3 f = 1e3 * linear(wrench), m = 1e3 * angular(wrench);
  int size = std::snprintf(text, sizeof text, "%.3g mN (%.3g, %.3g, %.3g)", f.norm(), f.x(), f.y(), f.z());
  if (m.norm() > 0.0)
    size += std::snprintf(text + size, sizeof text - size, "\n%.3g mN m (%.3g, %.3g, %.3g)", m.norm(), m.x(), m.y(),
                          m.z());
  return std::string(text, size);
}

// Motion of the tip, and the error of (19).
std::string motionText(const Pose& before, const Pose& after, const Pose& predicted) {
  const PoseDifference motion = differenceOf(before, after), error = differenceOf(predicted, after);
  char text[120];
  std::snprintf(text, sizeof text, "%.3g mm, %.3g deg; from C alone %.2g mm off", 1e3 * motion.position,
                degrees(motion.rotation), 1e3 * error.position);
  return text;
}

InteractiveMarkerControl axisControl(const Vector3& axis, uint8_t mode, const std::string& name) {
  InteractiveMarkerControl control;
  control.name = name;
  control.interaction_mode = mode;
  control.orientation_mode = InteractiveMarkerControl::FIXED;
  // rviz moves along, and turns about, the x axis of a control.
  control.orientation = toQuaternion(Eigen::Quaterniond::FromTwoVectors(Vector3::UnitX(), axis).toRotationMatrix());
  return control;
}

}  // namespace

TipHandle::TipHandle(const ros::NodeHandle& private_node, const MarkerStyle& style,
                     const TipHandleOptions& options, GetSnapshot get_snapshot)
    : style_(style),
      options_(options),
      get_snapshot_(std::move(get_snapshot)),
      server_(private_node.resolveName("tip_marker")) {
  fillMenu();
}

void TipHandle::fillMenu() {
  for (const char* title : kTitles) {
    const auto question = static_cast<Question>(entries_.size());
    entries_.push_back(menu_.insert(title, [this, question](const InteractiveMarkerFeedback::ConstPtr&) { choose(question); }));
  }
  menu_.insert("Let go", [this](const InteractiveMarkerFeedback::ConstPtr&) { letGo(); });
  choose(question_);
}

void TipHandle::choose(Question question) {
  question_ = question;
  for (size_t i = 0; i < entries_.size(); ++i)
    menu_.setCheckState(entries_[i],
                        static_cast<size_t>(question) == i ? MenuHandler::CHECKED : MenuHandler::UNCHECKED);
  letGo();
  is_inserted_ = false;  // the controls change
}

void TipHandle::letGo() {
  dragged_.reset();
  asked_.reset();
  wrench_.setZero();
  next_answer_ = ros::WallTime();
}

void TipHandle::insertMarker(const Pose& X_BT) {
  visualization_msgs::InteractiveMarker marker;
  marker.header.frame_id = style_.frame;  // without a stamp, so that rviz answers in this frame
  marker.name = kName;
  marker.description = kTitles[static_cast<size_t>(question_)];
  marker.scale = static_cast<float>(0.3 * solver_.model().scene().length());
  marker.pose = toPose(X_BT);
  for (int k = 0; k < 3; ++k) {
    const std::string name(1, "xyz"[k]);
    marker.controls.push_back(axisControl(Vector3::Unit(k), InteractiveMarkerControl::MOVE_AXIS, "move_" + name));
    if (question_ != Question::kForceAtPosition)
      marker.controls.push_back(axisControl(Vector3::Unit(k), InteractiveMarkerControl::ROTATE_AXIS, "turn_" + name));
  }
  InteractiveMarkerControl ball;  // drag it in the plane of the screen; a right click opens the menu
  ball.name = "move";
  ball.interaction_mode = InteractiveMarkerControl::MOVE_3D;
  ball.always_visible = true;
  // A marker without a frame is in the frame of the handle.
  Picture sphere("", ros::Time());
  sphere.addBall("", 0, Vector3::Zero(), 0.35 * marker.scale, color(0.9, 0.9, 0.95, 0.35));
  ball.markers = sphere.markers().markers;
  marker.controls.push_back(ball);
  server_.insert(marker, [this](const InteractiveMarkerFeedback::ConstPtr& feedback) {
    if (feedback->event_type == InteractiveMarkerFeedback::POSE_UPDATE) drag(*feedback);
  });
  menu_.apply(server_, kName);
  is_inserted_ = true;
}

void TipHandle::drag(const InteractiveMarkerFeedback& feedback) {
  const EstimateSnapshot newest = get_snapshot_();
  if (newest.estimate == nullptr) return;
  const Parsed<Pose> pose = readPose(feedback.pose);
  const Parsed<Matrix3> axes = readAxes(feedback.header.frame_id, {style_.frame, ""}, nullptr);
  if (!pose.ok() || !axes.ok()) {
    ROS_ERROR_THROTTLE(1.0, "tip_marker: %s", (pose.ok() ? axes.error : pose.error).c_str());
    return;
  }
  dragged_ = pose.value;
  const Twist drag = residualTwist(*dragged_, newest.estimate->solution.X_BT);
  wrench_ << options_.force_per_m * linear(drag), options_.moment_per_rad * angular(drag);
  if (question_ == Question::kForceAtPosition) angular(wrench_).setZero();
}

bool TipHandle::isAnswered(const Estimate& estimate) const {
  return asked_ && asked_->effective == estimate.effective && asked_->tip_wrench == estimate.tip_wrench &&
         asked_->X_BH.p == dragged_->p && asked_->X_BH.R == dragged_->R;
}

visualization_msgs::MarkerArray TipHandle::update() {
  const EstimateSnapshot newest = get_snapshot_();
  if (newest.estimate == nullptr) return {};
  const Estimate& estimate = *newest.estimate;
  if (solver_.setModel(newest.model)) {
    letGo();
    is_inserted_ = false;
  }
  if (!is_inserted_) insertMarker(estimate.solution.X_BT);
  if (!dragged_) server_.setPose(kName, toPose(estimate.solution.X_BT));
  server_.applyChanges();
  if (!dragged_) return {};
  const ros::WallTime start = ros::WallTime::now();
  if (!isAnswered(estimate) && start >= next_answer_) {
    answer(estimate);
    asked_ = Asked{estimate.effective, estimate.tip_wrench, *dragged_};
    const ros::WallTime end = ros::WallTime::now();
    next_answer_ = end + (end - start) * 4.0;
  }
  return makeGhostMarkers(ghost_, options_.force_per_m, style_, newest.stamp);
}

void TipHandle::answer(const Estimate& estimate) {
  ghost_ = Ghost();
  ghost_.text = question_ == Question::kDeflectionUnderWrench ? answerDeflection(estimate) : answerForce(estimate);
  ghost_.text_place = {dragged_->p.x(), dragged_->p.y(),  // above handle, tip and eigenvalues
                       std::max(dragged_->p.z(), estimate.solution.X_BT.p.z()) + 0.036};
}

std::string TipHandle::answerForce(const Estimate& estimate) {
  HoldGoal goal{dragged_->p, std::nullopt};
  if (question_ == Question::kWrenchAtPose) goal.orientation = dragged_->R;
  const HoldingWrench found =
      findHoldingWrench(solver_.model(), estimate.effective, estimate.tip_wrench, goal, solver_.workspace());
  if (!found.before.status.ok()) return "no ghost: " + solver_.model().describe(found.before.status);
  if (!isSameEquilibrium(found.before.X_BT, estimate.solution.X_BT, solver_.model())) return kOtherShape;
  if (!found.reached)
    return "no stable equilibrium there;\nthe tip comes to " + numberText(1e3 * found.miss.position) +
           " mm from it under\n" + wrenchText(found.wrench);
  const Pose predicted = predictDeflection(found.before.X_BT, found.before.compliance, found.wrench).exponential;
  return show(found.wrench, found.before.X_BT, found.held.X_BT, predicted);
}

std::string TipHandle::answerDeflection(const Estimate& estimate) {
  const DeflectionCheck check =
      checkDeflection(solver_.model(), estimate.effective, estimate.tip_wrench, wrench_, solver_.workspace());
  if (!check.undeflected_ok || !check.status.ok())
    return wrenchText(wrench_) + "\nno ghost: " + solver_.model().describe(check.status);
  if (!isSameEquilibrium(check.undeflected, estimate.solution.X_BT, solver_.model())) return kOtherShape;
  return show(wrench_, check.undeflected, check.exact, check.predicted.exponential);
}

std::string TipHandle::show(const Wrench& wrench, const Pose& before, const Pose& after, const Pose& predicted) {
  ghost_.X_BT = after;
  ghost_.force = linear(wrench);
  for (const Station& station : sampleBackbone(solver_.model(), solver_.workspace(), kShapeSections))
    ghost_.shape.push_back(station.X_BQ);
  return wrenchText(wrench) + "\n" + motionText(before, after, predicted);
}

}  // namespace live_stiffness
