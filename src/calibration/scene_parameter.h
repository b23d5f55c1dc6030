#pragma once
// Parameters that a calibration can change, of a scene or of a force sensor: names, priors and bounds.

#include <string>
#include <vector>

#include "live_stiffness/checks.h"
#include "live_stiffness/rod/scene.h"
#include "live_stiffness/section/channel_map.h"

namespace live_stiffness {

// The number of a parameter in a scene: one of the segment, or one of the whole scene.
using NumberOfParameter = double* (*)(Scene& scene, Segment& segment);

struct SceneParameter {
  std::string name;  // its key in the scene file, such as youngs_modulus_pa; of a channel's azimuth channel_azimuth_K_deg,
                     // K from 1, of the last link's mass link_mass_kg
  NumberOfParameter in = nullptr;  // nullptr: a channel's azimuth, or of a force sensor and not of the scene
  std::vector<int> chambers;       // of a channel's azimuth: which of a segment's chambers
  // All in SI (azimuths in rad, see `unit`):
  double start = 0.0;        // the scene's value; where the search begins
  double prior_mean = 0.0;   // of the prior, a normal distribution, truncated at the bounds
  double prior_sigma = 1.0;
  double low = 0.0, high = 0.0;
  double unit = 1.0;         // SI value of one unit of `name`
  double step = 0.0;         // of central differences: a thousandth of the prior sigma that it has by default
  Range legal = Range::finite();  // what a scene may have; the bounds lie within it
};

// Parameter of a scene by its name, with default prior and bounds. Its start is the value of the first segment; a calibrated
// value is set in all segments. Throws ConfigurationError with the legal names on an unknown one, or one that this scene does
// not have (a Gent limit without that law, a link's mass without a link, no such channel).
SceneParameter sceneParameter(const std::string& name, const Scene& scene, const ChannelMap& channels);

// All names that this scene has.
std::vector<std::string> sceneParameterNames(const Scene& scene, const ChannelMap& channels);

// Values of the parameters (SI) at x, their differences from the start in units of prior sigmas; limited to their bounds.
Eigen::VectorXd valuesAt(const std::vector<SceneParameter>& parameters, const double* x);

// Values (SI) a step above and below, by one parameter only, for a central difference; the bounds stop a step.
struct ParameterStep {
  Eigen::VectorXd above, below;
  double distance() const { return (above - below).sum(); }  // SI
};
ParameterStep stepAbout(const Eigen::VectorXd& values, const std::vector<SceneParameter>& parameters, size_t which);

// The scene with these values (SI) of the parameters that belong to it; other parameters are ignored. With Young's modulus
// the shear modulus changes, so that Poisson's ratio stays the same. A channel's azimuth rotates all its chambers together
// about the backbone. Where a fitted chamber radius or pitch radius would put the chambers through a wall, the pitch radius
// stops there, so that the scene stays legal.
Scene withParameters(const Scene& scene, const std::vector<SceneParameter>& parameters, const Eigen::VectorXd& values);

// Value (SI) that the scene has, which is not the one given where withParameters() stopped it.
double valueIn(const Scene& scene, const SceneParameter& parameter, double given);

// The scene with all its moduli times a factor.
Scene withModuliTimes(const Scene& scene, double factor);

}  // namespace live_stiffness
