#pragma once
// What a tracker measures of the sensor on the tip, from its messages or from tf. Knows no subscriber.

#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>
#include <topic_tools/shape_shifter.h>

#include <map>
#include <optional>
#include <string>

#include "estimation/measures_finder.h"
#include "live_stiffness/estimation/registration.h"
#include "ros/conversions.h"
#include "ros/input_status.h"

namespace live_stiffness {

class TrackerInput {
 public:
  // Both must outlive the input. registration: to judge what is plausible.
  TrackerInput(const InputParameters& parameters, const Registration& registration);

  // X_AS of the sensor, and the stamp to use for it; none if the message cannot be used.
  std::optional<Parsed<Pose>> read(const topic_tools::ShapeShifter& message);
  // The same from tf, if ~aurora_tf_frame is set; none, too, if there is nothing new.
  std::optional<Parsed<Pose>> read(const tf2_msgs::TFMessage& transforms, bool is_static);
  bool usesTf() const { return !parameters_.tracker_tf_frame.empty(); }

  // What the tracker measures: as told, or as found; whole poses as long as there is no doubt about that.
  TrackerMeasures measures() const;
  // The same; none: neither told nor found.
  std::optional<TrackerMeasures> knownMeasures() const;

  // True if the newest good pose is that of before: nothing was measured, since a tracker that measures is noisy.
  bool isRepeated() const { return is_repeated_; }
  double unchangedFor() const { return secondsBetween(last_change_, ros::Time::now()); }  // how long it repeats one pose, s
  // True if the tracker gives the same pose for longer than ~pose_timeout_s: it has lost its sensor.
  bool repeatsItself() const { return unchangedFor() > parameters_.pose_timeout; }
  // False if no good pose came within ~pose_timeout_s, or the sensor is lost.
  bool isFresh() const { return status_.age() <= parameters_.pose_timeout && !repeatsItself(); }
  InputStatus& status() { return status_; }
  // Other tools and what was found, as text; empty: nothing to say.
  std::vector<std::string> report() const;
  // doubt: why good poses are not compared with the estimate; empty: they are.
  void diagnose(const std::string& doubt, diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  std::optional<Parsed<Pose>> accept(const Parsed<TrackedPose>& parsed);
  // Why the pose is that of another tool; empty: it is the sensor's.
  std::string otherTool(const TrackedPose& tracked);
  std::string othersText() const;

  const InputParameters& parameters_;
  const Registration& registration_;
  InputStatus status_;
  MeasuresFinder finder_;
  std::string sensor_;                   // name of the sensor: ~sensor_frame, or the first child that was seen
  std::map<std::string, long> others_;   // poses of other tools
  std::string other_error_;              // about the newest of them
  Pose X_AS_;                            // newest
  ros::Time last_change_;                // when it last changed
  bool is_repeated_ = false;
  ros::Time last_tf_stamp_, last_tf_;    // of the newest transform; when the newest message of tf came
  tf2::BufferCore tf_;
};

}  // namespace live_stiffness
