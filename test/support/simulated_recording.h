#pragma once
// Recordings of a robot that is known: the simulated rig, which integrates its own fine model.

#include <random>

#include "live_stiffness/estimation/recording.h"
#include "rig/rig_model.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

// Three channels, each of which feeds a pair of chambers.
inline const ChannelMap kPairs = ChannelMap::even(3, 6);

struct SimulatedRecording {
  double seconds = 40.0, sample_time = 0.1;
  double amplitude = 80000.0;       // Pa
  double position_noise = 0.3e-3;   // per axis, m
  double rotation_noise = 0.005;    // per axis, rad
  double creep_share = 0.0, creep_time = 2.0;
  double outlier_share = 0.0;       // of samples, displaced by 20 mm
  std::string program = "triangle";

  Registration registration() const {
    return {{expSo3(Vector3(0.4, -0.2, 2.0)), Vector3(0.1, 0.2, -0.3)},
            {expSo3(Vector3(0.1, 0.3, -1.0)), Vector3(0.012, 0.002, -0.003)}};
  }

  // Of kPairs.
  Recording record(const Scene& truth) const {
    RigOptions options;
    options.drop_out_probability = 0.0;
    options.channel_of_chamber = {0, 0, 1, 1, 2, 2};
    options.program = {program, amplitude, 12.0};
    options.registration = registration();
    options.regulator_error = options.position_noise = options.rotation_noise = 0.0;
    options.creep_fraction = creep_share;
    options.creep_time_constant = creep_time;
    RigModel rig(truth, options);
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    const auto noise = [&](double sigma) {
      const double x = normal(random), y = normal(random), z = normal(random);
      return Vector3(sigma * x, sigma * y, sigma * z);
    };
    Recording recording;
    recording.name = "simulated";
    for (double time = 0.0; time < seconds; time += sample_time) {
      const RigSample seen = rig.step(time);
      RecordedSample sample;
      sample.time = time;
      sample.pressures = seen.measured_channels;
      sample.tip_position = seen.X_AS->p + noise(position_noise);
      if (uniform(random) < outlier_share) sample.tip_position += Vector3(0.02, -0.01, 0.0);
      sample.tip_orientation = Eigen::Quaterniond(Matrix3(seen.X_AS->R * expSo3(noise(rotation_noise))));
      recording.samples.push_back(sample);
    }
    return recording;
  }
};

}  // namespace live_stiffness
