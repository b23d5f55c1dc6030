#include "calibration/scene_parameter.h"

#include <algorithm>
#include <cmath>

#include "live_stiffness/checks.h"
#include "section/section_reader.h"

namespace live_stiffness {
namespace {

constexpr char kYoungsModulus[] = "youngs_modulus_pa", kPitchRadius[] = "chamber_pitch_radius_m",
               kChamberRadius[] = "chamber_radius_m", kGentLimit[] = "gent_limit", kYeohC2[] = "yeoh_c2",
               kYeohC3[] = "yeoh_c3", kLinkMass[] = "link_mass_kg";

// Prior sigma of a parameter before any measurement: the larger of a share of the scene's value and a minimum. Lengths have
// 5 %: the elastic length, and the place where the pressure acts in a chamber, are not what a ruler measures. The moduli of
// silicones differ by half between batches and test methods.
struct Known {
  const char* name;
  NumberOfParameter in;
  double share, least, low, high;
  Range legal = Range::positive();
};
Link* lastLink(Scene& scene) {
  for (auto body = scene.chain.rbegin(); body != scene.chain.rend(); ++body)
    if (auto* link = std::get_if<Link>(&*body)) return link;
  return nullptr;
}
constexpr Known kKnown[] = {
    {kYoungsModulus, [](Scene&, Segment& s) { return &s.section.youngs_modulus; }, 0.5, 0.0, 1e3, 1e9},
    {"shear_modulus_pa", [](Scene&, Segment& s) { return &s.section.shear_modulus; }, 0.5, 0.0, 1e2, 1e9},
    {"shear_correction", [](Scene&, Segment& s) { return &s.section.shear_correction; }, 0.2, 0.0, 0.1, 10.0},
    {"length_m", [](Scene&, Segment& s) { return &s.length; }, 0.05, 0.0, 1e-3, 10.0},
    {kPitchRadius, [](Scene&, Segment& s) { return &s.section.chambers.pitch_radius; }, 0.05, 1e-6, 1e-5, 1.0},
    {kChamberRadius, [](Scene&, Segment& s) { return &s.section.chambers.radius; }, 0.05, 0.0, 1e-5, 1.0},
    {"chamber_area_growth_per_pa", [](Scene&, Segment& s) { return &s.section.chambers.area_growth; }, 0.0, 2e-6,
     kAreaGrowthRange.low, kAreaGrowthRange.high, kAreaGrowthRange},
    {kGentLimit, [](Scene&, Segment& s) { return &s.section.material.gent_limit; }, 1.0, 0.0, 0.1, 1e4},
    {kYeohC2, [](Scene&, Segment& s) { return &s.section.material.yeoh_c2; }, 0.0, 0.5, -2.0, 10.0, Range::finite()},
    {kYeohC3, [](Scene&, Segment& s) { return &s.section.material.yeoh_c3; }, 0.0, 0.5, -2.0, 10.0, Range::finite()},
    {"pressure_stiffening", [](Scene&, Segment& s) { return &s.section.material.pressure_stiffening; }, 0.0, 1.0,
     kPressureStiffeningRange.low, kPressureStiffeningRange.high,
     kPressureStiffeningRange},
    {"creep_share", [](Scene&, Segment& s) { return &s.section.material.creep_share; }, 0.0, 0.1, 0.0, 0.5, kCreepShareRange},
    {"creep_time_s", [](Scene&, Segment& s) { return &s.section.material.creep_time; }, 1.0, 1.0, 0.2, 60.0},
    {"tip_mass_kg", [](Scene& scene, Segment&) { return &scene.tip_mass; }, 0.2, 1e-3, 0.0, 10.0, Range::nonnegative()},
    {kLinkMass, [](Scene& scene, Segment&) { return &lastLink(scene)->mass; }, 0.2, 1e-3, 0.0, 10.0,
     Range::nonnegative()},
};
constexpr double kAzimuthSigma = 5.0 * kDegree, kAzimuthReach = 30.0 * kDegree;
const std::string kAzimuth = "channel_azimuth_";

// A bound of the chambers' place is a micrometre within what is legal, so that a value there is so, too, when it is read back.
constexpr double kMargin = 1e-6;

const Segment& firstSegment(const Scene& scene) {
  for (const Body& body : scene.chain)
    if (const auto* segment = std::get_if<Segment>(&body)) return *segment;
  throw ConfigurationError("scene", {"chain: must hold at least one segment"});
}

// Chambers of a channel within each segment: all segments alike, or none.
std::vector<int> chambersOfChannel(const Scene& scene, const ChannelMap& channels, int channel) {
  const int per_segment = firstSegment(scene).section.chambers.count();
  const int channels_per_segment = channels.channelCount() / std::max(1, scene.segmentCount());
  std::vector<int> chambers;
  for (int k = 0; k < channels.chamberCount(); ++k)
    if (k < per_segment && channels_per_segment > 0 && channels.channelOfChamber()[k] == channel) chambers.push_back(k);
  return chambers;
}

bool isThere(const std::string& name, Scene scene) {
  const StretchLaw law = firstSegment(scene).section.material.law;
  if (name == kGentLimit) return law == StretchLaw::kGent;
  if (name == kYeohC2 || name == kYeohC3) return law == StretchLaw::kYeoh;
  if (name == kPitchRadius || name == kChamberRadius) return firstSegment(scene).section.chambers.count() > 0;
  return name != kLinkMass || lastLink(scene) != nullptr;
}

void setIn(Scene& scene, Segment& segment, const SceneParameter& parameter, double value) {
  for (int chamber : parameter.chambers) segment.section.chambers.azimuths[chamber] += value - parameter.start;
  if (parameter.in == nullptr) return;
  double& number = *parameter.in(scene, segment);
  if (parameter.name == kYoungsModulus) segment.section.shear_modulus *= value / number;
  number = value;
}

// Moves the chambers to where they are between lumen and outer wall.
void fitIntoTube(CrossSection& section) {
  Chambers& chambers = section.chambers;
  const double low = section.lumen_radius > 0.0 ? section.lumen_radius + chambers.radius + kMargin : 0.0;
  const double high = section.outer_radius - chambers.radius - kMargin;
  if (chambers.count() > 0 && low <= high) chambers.pitch_radius = std::clamp(chambers.pitch_radius, low, high);
}

}  // namespace

std::vector<std::string> sceneParameterNames(const Scene& scene, const ChannelMap& channels) {
  std::vector<std::string> names;
  for (const Known& known : kKnown)
    if (isThere(known.name, scene)) names.push_back(known.name);
  for (int channel = 0; channel < channels.channelCount(); ++channel)
    if (!chambersOfChannel(scene, channels, channel).empty())
      names.push_back(kAzimuth + std::to_string(channel + 1) + "_deg");
  return names;
}

SceneParameter sceneParameter(const std::string& name, const Scene& scene, const ChannelMap& channels) {
  const std::vector<std::string> names = sceneParameterNames(scene, channels);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string legal;
    for (const std::string& other : names) legal += (legal.empty() ? "" : ", ") + other;
    throw ConfigurationError("parameters", {"'" + name + "' is none that this scene has: must be one of " + legal});
  }
  SceneParameter parameter;
  parameter.name = name;
  if (name.compare(0, kAzimuth.size(), kAzimuth) == 0) {
    parameter.chambers = chambersOfChannel(scene, channels, std::stoi(name.substr(kAzimuth.size())) - 1);
    const std::vector<double>& azimuths = firstSegment(scene).section.chambers.azimuths;
    double x = 0.0, y = 0.0;
    for (int chamber : parameter.chambers) {
      x += std::cos(azimuths[chamber]);
      y += std::sin(azimuths[chamber]);
    }
    parameter.start = std::atan2(y, x);
    parameter.prior_sigma = kAzimuthSigma;
    parameter.low = parameter.start - kAzimuthReach;
    parameter.high = parameter.start + kAzimuthReach;
    parameter.unit = kDegree;
  } else {
    const Known& known = *std::find_if(std::begin(kKnown), std::end(kKnown),
                                       [&](const Known& entry) { return name == entry.name; });
    parameter.in = known.in;
    Scene copy = scene;
    Segment first = firstSegment(scene);
    parameter.start = *known.in(copy, first);
    parameter.prior_sigma = std::max(known.share * std::abs(parameter.start), known.least);
    parameter.low = known.low;
    parameter.high = known.high;
    parameter.legal = known.legal;
    // The tubes around them limit chamber radius and pitch radius. Without a lumen chambers may reach over the axis, where the
    // scene has them there.
    for (const Body& body : scene.chain) {
      const auto* segment = std::get_if<Segment>(&body);
      if (segment == nullptr || segment->section.chambers.count() == 0) continue;
      const CrossSection& section = segment->section;
      const double inner = section.lumen_radius, outer = section.outer_radius;
      const double pitch = section.chambers.pitch_radius, radius = section.chambers.radius;
      const bool clear = inner > 0.0 || radius <= pitch;
      if (name == kPitchRadius) {
        parameter.low = std::max(parameter.low, clear ? inner + radius + kMargin : 0.0);
        parameter.high = std::min(parameter.high, outer - radius - kMargin);
      }
      if (name == kChamberRadius)
        parameter.high = std::min(parameter.high, std::min(clear ? pitch - inner : outer, outer - pitch) - kMargin);
    }
    if (name == kChamberRadius) parameter.low = 0.5 * parameter.start;
    parameter.high = std::max(parameter.high, parameter.low);
  }
  parameter.prior_mean = parameter.start;
  parameter.step = 1e-3 * parameter.prior_sigma;
  return parameter;
}

Eigen::VectorXd valuesAt(const std::vector<SceneParameter>& parameters, const double* x) {
  Eigen::VectorXd values(static_cast<long>(parameters.size()));
  for (size_t k = 0; k < parameters.size(); ++k)
    values[static_cast<long>(k)] =  // rounding must not make a mass of zero negative
        std::clamp(parameters[k].start + parameters[k].prior_sigma * x[k], parameters[k].low, parameters[k].high);
  return values;
}

ParameterStep stepAbout(const Eigen::VectorXd& values, const std::vector<SceneParameter>& parameters, size_t which) {
  const SceneParameter& p = parameters[which];
  const auto k = static_cast<long>(which);
  ParameterStep step{values, values};
  step.above[k] = std::min(values[k] + p.step, p.high);
  step.below[k] = std::max(values[k] - p.step, p.low);
  return step;
}

Scene withParameters(const Scene& scene, const std::vector<SceneParameter>& parameters, const Eigen::VectorXd& values) {
  Scene result = scene;
  const bool moves_chambers = std::any_of(parameters.begin(), parameters.end(), [](const SceneParameter& p) {
    return p.name == kPitchRadius || p.name == kChamberRadius;
  });
  for (Body& body : result.chain) {
    auto* segment = std::get_if<Segment>(&body);
    if (segment == nullptr) continue;
    for (size_t k = 0; k < parameters.size(); ++k) setIn(result, *segment, parameters[k], values[static_cast<long>(k)]);
    if (moves_chambers) fitIntoTube(segment->section);
  }
  return result;
}

double valueIn(const Scene& scene, const SceneParameter& parameter, double given) {
  if (parameter.in == nullptr) return given;
  Scene copy = scene;
  Segment first = firstSegment(scene);
  return *parameter.in(copy, first);
}

Scene withModuliTimes(const Scene& scene, double factor) {
  Scene result = scene;
  for (Body& body : result.chain)
    if (auto* segment = std::get_if<Segment>(&body)) {
      segment->section.youngs_modulus *= factor;
      segment->section.shear_modulus *= factor;
    }
  return result;
}

}  // namespace live_stiffness
