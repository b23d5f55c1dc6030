#pragma once
// A simulated rig: regulators, a robot that creeps, and a noisy tracker. Plays what the node would see, and the truth.
//
//   command --lag--> measured --+ slow error--> actual --creep--> effective --FineRobot--> X_BT --tracker--> X_AS
//                                                                               |
//                                                                            contact
//
// The regulator holds its own reading on the command after a lag, so its reading is what a driver publishes
// (`measured`); the slow error is that of its sensor, and only the robot feels it.

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "estimation/motion_history.h"
#include "live_stiffness/estimation/registration.h"
#include "rig/contact.h"
#include "rig/fine_robot.h"
#include "rig/pressure_program.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

struct RigOptions {
  std::vector<int> channel_of_chamber;  // see ChannelMap; empty: one channel per chamber
  ProgramOptions program;
  std::uint64_t seed = static_cast<std::uint64_t>(kSeed.standard);  // of everything random here

  double regulator_time_constant = kRegulatorTimeConstant.standard;  // s
  double regulator_error = kRegulatorError.standard;                 // bound of the slow error, Pa

  // Effective pressure = (1 - fraction) actual + fraction * actual lagged by the time constant: after a step the robot
  // reaches (1 - fraction) at once and creeps the rest. Fully relaxed it is the fine robot exactly.
  double creep_fraction = kCreepFraction.standard;
  double creep_time_constant = kCreepTimeConstant.standard;  // s

  // X_AB and X_TS of the rig, rotations orthonormal to 1e-6; and by how much its tracker is late, 0 to kLargestDelay.
  Registration registration;

  // White and isotropic. Both are RMS values of the error's *magnitude*, as trackers are specified: each of the three
  // components has the standard deviation value / sqrt(3). The rotation error is a small turn in the sensor's axes.
  double position_noise = kPositionNoise.si();  // m
  double rotation_noise = kRotationNoise.si();  // rad
  double drop_out_probability = kDropOutProbability.standard;  // per tracker sample outside of a drop-out, that one starts
  double drop_out_duration = kDropOutDuration.standard;        // s

  Contact contact;  // what pushes the tip now and then

  // Of all but the wrench and the registration.
  template <class Options, class Visit>
  static void forEachParameter(Options& options, Visit&& visit) {
    ProgramOptions::forEachParameter(options.program, visit);
    visit(kSeed, options.seed);
    visit(kRigChannelOfChamber, options.channel_of_chamber);
    visit(kRegulatorTimeConstant, options.regulator_time_constant);
    visit(kRegulatorError, options.regulator_error);
    visit(kCreepFraction, options.creep_fraction);
    visit(kCreepTimeConstant, options.creep_time_constant);
    visit(kPositionNoise, options.position_noise);
    visit(kRotationNoise, options.rotation_noise);
    visit(kDropOutProbability, options.drop_out_probability);
    visit(kDropOutDuration, options.drop_out_duration);
    Contact::forEachParameter(options.contact, visit);
  }
};

struct RigSample {
  double time = 0.0;             // s
  Pressures command;             // gauge, Pa, one per channel
  Pressures measured_channels;   // gauge, Pa, one per channel: what the regulator reports
  Pressures measured_chambers;   // the same, one per chamber
  std::optional<Pose> X_AS;      // tracker sample, of how the robot stood a delay before; empty during a drop-out
  Pressures actual_chambers;     // truth: gauge, Pa, never negative (a regulator cannot pull)
  Pressures effective_chambers;  // truth: after creep
  Wrench contact_wrench;         // truth: what the pusher exerts at T, base axes; its moment is about T
  Pose X_BT;                     // truth

  // Truth, as a force sensor between pusher and tip measures it: contact_wrench in axes of T.
  Wrench sensedContact() const { return wrenchAdjoint({X_BT.R.transpose(), Vector3::Zero()}) * contact_wrench; }
};

// First-order lag y' = (u - y) / tau of a vector, exact for an input that is linear between updates.
class FirstOrderLag {
 public:
  // time_constant: tau, s; 0 lets the input through. Input and output start at zero.
  FirstOrderLag(int size, double time_constant)
      : time_constant_(time_constant), input_(Pressures::Zero(size)), output_(Pressures::Zero(size)) {}

  // Goes on by `step` (s, not negative) to an input that has moved linearly since the last update.
  const Pressures& update(const Pressures& input, double step) {
    if (time_constant_ <= 0.0) {
      output_ = input;
    } else if (step > 0.0) {
      const Pressures lead = (time_constant_ / step) * (input - input_);  // tau u', how far y trails a ramp
      output_ = input - lead + std::exp(-step / time_constant_) * (output_ - input_ + lead);
    }
    input_ = input;
    return output_;
  }

 private:
  double time_constant_;
  Pressures input_, output_;
};

class RigModel {
 public:
  // Throws ConfigurationError with every fault: options out of range, a channel map that does not fit the scene, a
  // scene without segments, or pressures (amplitude plus regulator error) beyond the sections' range.
  RigModel(Scene scene, const RigOptions& options);

  // Takes the rig from the last time to `time` (s) and returns what is seen there. The first call starts from rest at
  // time 0. Equal seeds and equal times give equal samples. Between two calls the command counts as linear, so steps
  // of at most a tenth of the program's period keep its shape. Throws std::invalid_argument if time is not finite,
  // negative or goes backwards, std::runtime_error if the robot finds no equilibrium (buckled under the pusher).
  RigSample step(double time);

 private:
  Pressures slowError(double time) const;
  std::optional<Pose> track(double time);

  RigOptions options_;
  ChannelMap channel_map_;
  std::mt19937_64 random_;
  PressureProgram program_;
  FineRobot robot_;
  FirstOrderLag regulator_;  // of channels
  FirstOrderLag creep_;      // of chambers
  MotionHistory history_;
  std::vector<Vector3> error_phases_;  // rad, three components per channel
  double time_ = 0.0;
  double drop_out_until_ = -1.0;  // s
};

}  // namespace live_stiffness
