#pragma once
// The interactive marker at the tip (the handle), and the ghost of the robot that answers it.
//
// Its menu has three modes: the force that holds the tip at a position, the wrench that holds it at a pose, and the pose of
// the tip under a wrench. The handle follows the tip until it is dragged, and then stays there until "let go". The answer
// is the exact nonlinear equilibrium, in a workspace of its own, so that the live solver is not affected.
//
// Everything runs in the thread that spins the global callback queue: events of the mouse and update().

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

  // Serves the interactive marker on ~tip_marker.
  TipHandle(const ros::NodeHandle& private_node, const MarkerStyle& style,
            const TipHandleOptions& options, GetSnapshot get_snapshot);

  // Moves the handle with the tip, or answers for the newest estimate; returns the ghost, if there is one. Call it at the
  // rate of the markers. Dragging only moves the handle, so that no queue of requests builds up. Answers take at most a
  // fifth of the time.
  visualization_msgs::MarkerArray update();

 private:
  enum class Question { kForceAtPosition, kWrenchAtPose, kDeflectionUnderWrench };

  void drag(const visualization_msgs::InteractiveMarkerFeedback& feedback);
  void choose(Question question);
  void letGo();
  void fillMenu();
  void insertMarker(const Pose& X_BT);
  bool isAnswered(const Estimate& estimate) const;
  void answer(const Estimate& estimate);  // sets ghost_
  // Both set the shape of ghost_, if there is one, and return its text.
  std::string answerForce(const Estimate& estimate);
  std::string answerDeflection(const Estimate& estimate);
  // The shape is that of the last solve; the tip before and after the wrench was added, and as (19) predicts it.
  std::string show(const Wrench& wrench, const Pose& before, const Pose& after, const Pose& predicted);

  MarkerStyle style_;
  TipHandleOptions options_;
  GetSnapshot get_snapshot_;
  ModelWorkspace solver_;
  Question question_ = Question::kForceAtPosition;
  std::optional<Pose> dragged_;  // pose of the handle after dragging, in B; none: it follows the tip
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
