#pragma once
// A recording of a robot: chamber pressures, tracker poses and, if there is one, the tip force sensor over time.
//
// Read from CSV with one header line. Columns are found by name, in any order; others are ignored with a warning:
//   time_s                                    strictly increasing
//   pressure_K_pa_abs or pressure_K_pa        K = 1, 2, ... without gaps; all absolute or all gauge
//   tip_x_m .. tip_z_m, tip_qw .. tip_qz      tracker sensor on the tip, in the tracker frame A
//   base_x_m .. base_z_m                      optional: tracker sensor at the base, in A
//   force_x_n .. force_z_n, torque_x_nm .. torque_z_nm    optional: tip force/torque sensor

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/tracker_measures.h"
#include "live_stiffness/lie/se3.h"

namespace live_stiffness {

struct RecordedSample {
  int line = 0;        // of the file, counted from 1
  double time = 0.0;   // s
  Pressures pressures;  // one per channel, Pa; absolute or gauge as Recording::absolute says
  std::optional<Vector3> base_position;  // p_A of the base sensor, m
  std::optional<Eigen::Quaterniond> base_orientation;  // q_A of the base sensor
  Vector3 tip_position = Vector3::Zero();  // p_AS of the tip sensor, m
  // Orientation q_AS of the tip sensor, unit norm. Of the two signs of one rotation it has the one that is nearer to the
  // previous sample, so that the components are continuous in time.
  Eigen::Quaterniond tip_orientation = Eigen::Quaterniond::Identity();
  // How long the tracker has repeated just this pose, s; 0: it is a new one. A tracker that has lost its sensor repeats itself,
  // and a recording with a higher rate than the tracker's does, too.
  double unchanged_for = 0.0;
  std::optional<Wrench> tip_wrench;  // [f; m] as recorded: in the sensor's axes, at the sensor; N and N m

  Pose tipPose() const { return {tip_orientation.toRotationMatrix(), tip_position}; }  // X_AS
};

struct Recording {
  std::string name;                     // path it was read from
  std::optional<TrackerMeasures> measures;  // of tip_orientation; none: to be found from the data
  bool absolute = false;                // pressures are absolute; see gaugePressures()
  std::vector<RecordedSample> samples;  // in order of time, never empty
  std::vector<std::string> warnings;    // "line N: reason" for every line left out, and for ignored columns

  int channelCount() const { return static_cast<int>(samples.front().pressures.size()); }
};

// Reads a file. A line with a missing, extra, unreadable or non-finite value, a time that does not increase, or a zero
// quaternion is left out with a warning. Throws ConfigurationError (all faults) when the file cannot be read, the
// header lacks or repeats a column, or no line is left.
Recording loadRecording(const std::string& path);

// The same from text; `name` stands for the path in messages.
Recording parseRecording(const std::string& csv, const std::string& name);

// Gauge pressures of each sample (Pa). Absolute recording: minus the mean of each channel over the first half second, in
// which the robot must be at rest (the first sample only, if a sample period is longer). Gauge recording: as they are.
std::vector<Pressures> gaugePressures(const Recording& recording);

// Indices of the quasi-static samples, ascending; may be empty. The robot moves between two samples whose pressures differ by
// more than 2 kPa in any channel, if they are neighbours or at most 0.25 s apart. Samples from 0.3 s before the first of the
// two until 1 s after the second are left out; all others are quasi-static.
std::vector<int> quasiStaticSamples(const Recording& recording);

// True if the measured force is below 0.06 N, the noise of the recorded robot's sensor, or if no force was recorded.
bool isUnloaded(const RecordedSample& sample);

}  // namespace live_stiffness
