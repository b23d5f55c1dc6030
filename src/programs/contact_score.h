#pragma once
// How well an estimated tip force agrees with the measured one, and when contact was reported.

#include <string>
#include <vector>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

struct ContactSample {
  double time = 0.0;                                            // s
  Vector3 truth = Vector3::Zero(), estimate = Vector3::Zero();  // on the robot, base axes, N
  Matrix3 compliance = Matrix3::Identity();  // translational block at the tip, symmetric, base axes, m/N
  bool contact = false;                      // reported
  Matrix3 seen = Matrix3::Identity();        // projects a force on the part that the sensor measures, base axes
};

// *Compliant components* are those along the two most compliant principal axes of the tip's translation, the ones that the
// tip's position shows.
struct ContactScore {
  static constexpr double kTouch = 0.06;   // N; below this there is no contact (noise of the recorded force sensor)
  static constexpr double kFirm = 0.15;    // N; a push that must be detected
  static constexpr double kFalse = 0.10;   // N; an estimate that matters
  static constexpr double kSettle = 1.0;   // s until a push, or its end, must be detected

  int pushes = 0;              // times that the force rose above kTouch after at least kSettle below it
  int during = 0;              // samples with a true force of at least kTouch; the next nine are over them
  double rms = 0.0, rms_truth = 0.0;                      // error of what the sensor sees of the force, and the force, N
  double rms_compliant = 0.0, rms_compliant_truth = 0.0;  // of the compliant components, seen or not, N
  double peak = 0.0, peak_truth = 0.0;                      // largest force, estimated while in contact and true, N
  double peak_compliant = 0.0, peak_compliant_truth = 0.0;  // the same of the compliant components, N
  double stiff_compliance = 0.0;  // mean along the stiffest principal axis, m/N: how far a force there moves the tip
  double seen = 0.0;           // share of samples with contact, of those that have been pushed by kFirm for kSettle
  double longest_false = 0.0;  // longest contact with an estimate above kFalse, nothing having touched for kSettle, s
  // Delay of the estimate relative to the truth, s: where the cross-correlation of the compliant components is largest,
  // between plus and minus kSettle in steps of 10 ms; and that correlation, -1 to 1. Both zero if either force is zero.
  double delay = 0.0, correlation = 0.0;

  std::string text() const;   // as one line
  std::string table() const;  // CSV: a line "quantity,value" for each of the above, SI, unit in the name
};

// samples: in order of time. All zero for none.
ContactScore contactScore(const std::vector<ContactSample>& samples);

}  // namespace live_stiffness
