#pragma once
// The interactive marker at the tip: a question asked with the mouse, and its answer as a ghost of the robot.
//
// Three questions, chosen in its menu: which force holds the tip at a position, which wrench holds it at a pose, and
// where a wrench takes it. The handle follows the tip until it is dragged, and stays where it is dragged until "let
// go". Each is answered by the exact nonlinear equilibrium in a workspace of its own, never by the live solver.
//
// All runs in the thread that spins the global callback queue: the mouse's events as well as update().

#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <ros/node_handle.h>

#include <optional>
#include <string>
#include <vector>

#include "ros/estimate_snapshot.h"
#include "ros/markers.h"
#include "ros/node_parameters.h"

namespace live_stiffness {

class TipHandle {
 public:
  enum class Question { kForceAtPosition, kWrenchAtPose, kDeflectionUnderWrench };
  static constexpr char kName[] = "tip";  // of the interactive marker

  // Serves the interactive marker on ~tip_marker, and publishes the ghost on `markers`.
  TipHandle(const ros::NodeHandle& private_node, const MarkerStyle& style,
            const TipHandleOptions& options, const ros::Publisher& markers, GetSnapshot get_snapshot);
  TipHandle(const TipHandle&) = delete;  // callbacks refer to it

  // Lets the handle follow the tip, or answers for the newest estimate. Call at the rate of the markers: dragging only
  // moves the handle, so that questions do not pile up. Answers take at most a fifth of the time.
  void update();

 private:
  void drag(const visualization_msgs::InteractiveMarkerFeedback& feedback);
  void choose(Question question);
  void letGo();
  void fillMenu();
  void insertMarker(const Pose& X_BT);
  bool isAnswered(const Estimate& estimate) const;
  Ghost answer(const Estimate& estimate);
  Ghost answerForce(const Estimate& estimate);
  Ghost answerDeflection(const Estimate& estimate);
  void addShape(Ghost& ghost) const;

  MarkerStyle style_;
  TipHandleOptions options_;
  ros::Publisher markers_;
  GetSnapshot get_snapshot_;
  ModelWorkspace solver_;
  Question question_ = Question::kForceAtPosition;
  std::optional<Pose> dragged_;  // where the handle was left, base axes; none: it follows the tip
  Wrench wrench_ = Wrench::Zero();  // asked about, kDeflectionUnderWrench
  struct Asked {
    Pressures effective;
    Wrench tip_wrench;
    Pose X_BH;
  };
  std::optional<Asked> asked_;  // what ghost_ answers
  Ghost ghost_;
  ros::WallTime next_answer_;    // not before, so that hard questions leave time for all else
  bool is_inserted_ = false;     // rviz knows the handle with the controls of the question

  interactive_markers::InteractiveMarkerServer server_;
  interactive_markers::MenuHandler menu_;
  std::vector<interactive_markers::MenuHandler::EntryHandle> entries_;  // of the questions, in their order
};

}  // namespace live_stiffness
