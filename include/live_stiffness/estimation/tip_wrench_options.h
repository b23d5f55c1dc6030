#pragma once
// Options of the tip wrench estimator, in physical units. docs/estimation.md says how to set them.

#include "live_stiffness/checks.h"
#include "live_stiffness/conventions.h"
#include "live_stiffness/estimation/contact_detector.h"

namespace live_stiffness {

// Standard deviations of a tracker's poses: position per axis, m; rotation per axis, rad.
struct TrackerNoise {
  double position = 2e-3;
  double rotation = 0.5;
};

// Standard deviations unless stated. Positions and forces are per axis. Legal ranges in the comments.
struct TipWrenchOptions {
  int components = 3;  // 3: a pure force at T; 6: force and moment

  // White, per sample, of the tracker and of what the model does not follow from one sample to the next: a silicone arm
  // in motion is some millimetres from its model, and its tip turns about its own axis in ways that none describes (5
  // to 13 deg on recordings), so that by default rotation hardly counts. With 6 components it must: lower it.
  TrackerNoise tracker;  // position 1e-6 to 0.1 m, rotation 1e-5 to 1 rad

  // The wrench, a Gauss-Markov process. Without contact it is small and soon forgotten, so that what lasts counts as
  // model error; under contact it walks freely up to the size that can be expected.
  double free_force = 0.05;     // N; 1e-4 to 100
  double free_moment = 1e-3;    // N m; 1e-6 to 10
  double free_time = 0.5;       // s; 0.01 to 100
  double contact_force = 0.3;   // N; 1e-3 to 1e4
  double contact_moment = 0.01; // N m; 1e-5 to 1e3
  double force_walk = 1.5;      // N / sqrt(s); 1e-3 to 1e3
  double moment_walk = 0.015;   // N m / sqrt(s); 1e-5 to 100

  // Model error: a slow twist between the model's tip and the real one (creep that the model does not know, errors of
  // registration and model). A Gauss-Markov process; every change of pressure adds to it.
  double bias_position = 1.5e-3;            // m; 0 to 0.1
  double bias_rotation = radians(4.0);      // rad; 0 to 1
  double bias_time = 2.0;                   // s, without contact; 0.1 to 1e5
  double bias_time_in_contact = 100.0;      // s; 0.1 to 1e5
  double bias_position_per_pressure = 2e-8;            // m/Pa of change, 2-norm over chambers; 0 to 1e-5
  double bias_rotation_per_pressure = radians(5e-5);   // rad/Pa; 0 to 1e-2

  // Stiffness scale: the factor on all moduli, its logarithm walks at random. Learnt without contact only.
  double scale_deviation = 0.0;  // of the logarithm at the start, -; 0 to 1; 0: the scale stays 1
  double scale_walk = 0.002;     // 1 / sqrt(s); 0 to 1

  // Samples farther from the prediction than this many standard deviations count less (as in Huber's loss), and beyond
  // the gate not at all, until `reaccept` samples in a row agree with one another.
  double robust_from = 2.0;  // 1 to 100
  double gate = 8.0;         // at least robust_from, to 1000
  int reaccept = 5;          // 2 to 1000

  ContactThresholds contact;

  // Adds a fault for every value out of its range, under the names above.
  void check(FaultList& faults) const;
};

}  // namespace live_stiffness
