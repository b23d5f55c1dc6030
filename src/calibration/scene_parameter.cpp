#include "calibration/scene_parameter.h"

#include <algorithm>
#include <cmath>

#include "live_stiffness/checks.h"
#include "section/section_reader.h"

namespace live_stiffness {
namespace {

// Prior sigma of a parameter before any measurement: the larger of a share of the scene's value and a minimum. Lengths have
// 5 %: the elastic length, and the place where the pressure acts in a chamber, are not what a ruler measures. The moduli of
// silicones differ by half between batches and test methods.
struct Known {
  const char* name;
  ParameterKind kind;
  double share, least, low, high, unit;
};
constexpr Known kKnown[] = {
    {"youngs_modulus_pa", ParameterKind::kYoungsModulus, 0.5, 0.0, 1e3, 1e9, 1.0},
    {"shear_modulus_pa", ParameterKind::kShearModulus, 0.5, 0.0, 1e2, 1e9, 1.0},
    {"shear_correction", ParameterKind::kShearCorrection, 0.2, 0.0, 0.1, 10.0, 1.0},
    {"length_m", ParameterKind::kLength, 0.05, 0.0, 1e-3, 10.0, 1.0},
    {"chamber_pitch_radius_m", ParameterKind::kPitchRadius, 0.05, 0.0, 1e-5, 1.0, 1.0},
    {"chamber_radius_m", ParameterKind::kChamberRadius, 0.05, 0.0, 1e-5, 1.0, 1.0},
    {"chamber_area_growth_per_pa", ParameterKind::kAreaGrowth, 0.0, 2e-6, kAreaGrowthRange.low, kAreaGrowthRange.high,
     1.0},
    {"gent_limit", ParameterKind::kGentLimit, 1.0, 0.0, 0.1, 1e4, 1.0},
    {"yeoh_c2", ParameterKind::kYeohC2, 0.0, 0.5, -2.0, 10.0, 1.0},
    {"yeoh_c3", ParameterKind::kYeohC3, 0.0, 0.5, -2.0, 10.0, 1.0},
    {"pressure_stiffening", ParameterKind::kPressureStiffening, 0.0, 1.0, kPressureStiffeningRange.low,
     kPressureStiffeningRange.high, 1.0},
    {"creep_share", ParameterKind::kCreepShare, 0.0, 0.1, 0.0, 0.5, 1.0},
    {"creep_time_s", ParameterKind::kCreepTime, 1.0, 1.0, 0.2, 60.0, 1.0},
    {"tip_mass_kg", ParameterKind::kTipMass, 0.2, 1e-3, 0.0, 10.0, 1.0},
    {"link_mass_kg", ParameterKind::kLinkMass, 0.2, 1e-3, 0.0, 10.0, 1.0},
};
constexpr double kAzimuthSigma = 5.0 * kDegree, kAzimuthReach = 30.0 * kDegree;
const std::string kAzimuth = "channel_azimuth_";

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

bool isThere(const Known& known, const Scene& scene) {
  const Material& material = firstSegment(scene).section.material;
  switch (known.kind) {
    case ParameterKind::kGentLimit: return material.law == StretchLaw::kGent;
    case ParameterKind::kYeohC2:
    case ParameterKind::kYeohC3: return material.law == StretchLaw::kYeoh;
    case ParameterKind::kLinkMass:
      return std::any_of(scene.chain.begin(), scene.chain.end(),
                         [](const Body& body) { return std::holds_alternative<Link>(body); });
    default: return true;
  }
}

// The number of a segment that a parameter names, or nullptr.
double* numberOf(Segment& segment, ParameterKind kind) {
  CrossSection& section = segment.section;
  switch (kind) {
    case ParameterKind::kYoungsModulus: return &section.youngs_modulus;
    case ParameterKind::kShearModulus: return &section.shear_modulus;
    case ParameterKind::kShearCorrection: return &section.shear_correction;
    case ParameterKind::kLength: return &segment.length;
    case ParameterKind::kPitchRadius: return &section.chambers.pitch_radius;
    case ParameterKind::kChamberRadius: return &section.chambers.radius;
    case ParameterKind::kAreaGrowth: return &section.chambers.area_growth;
    case ParameterKind::kGentLimit: return &section.material.gent_limit;
    case ParameterKind::kYeohC2: return &section.material.yeoh_c2;
    case ParameterKind::kYeohC3: return &section.material.yeoh_c3;
    case ParameterKind::kPressureStiffening: return &section.material.pressure_stiffening;
    case ParameterKind::kCreepShare: return &section.material.creep_share;
    case ParameterKind::kCreepTime: return &section.material.creep_time;
    default: return nullptr;
  }
}

Link* lastLink(Scene& scene) {
  for (auto body = scene.chain.rbegin(); body != scene.chain.rend(); ++body)
    if (auto* link = std::get_if<Link>(&*body)) return link;
  return nullptr;
}

double valueIn(Scene scene, ParameterKind kind) {
  if (kind == ParameterKind::kTipMass) return scene.tip_mass;
  if (kind == ParameterKind::kLinkMass) return lastLink(scene)->mass;
  Segment segment = firstSegment(scene);
  return *numberOf(segment, kind);
}

void setIn(Segment& segment, const SceneParameter& parameter, double value) {
  if (parameter.kind == ParameterKind::kChannelAzimuth)
    for (int chamber : parameter.chambers) segment.section.chambers.azimuths[chamber] += value - parameter.start;
  double* const number = numberOf(segment, parameter.kind);
  if (number == nullptr) return;
  if (parameter.kind == ParameterKind::kYoungsModulus) segment.section.shear_modulus *= value / *number;
  *number = value;
}

}  // namespace

std::vector<std::string> sceneParameterNames(const Scene& scene, const ChannelMap& channels) {
  std::vector<std::string> names;
  for (const Known& known : kKnown)
    if (isThere(known, scene)) names.push_back(known.name);
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
    parameter.kind = ParameterKind::kChannelAzimuth;
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
    parameter.kind = known.kind;
    parameter.start = valueIn(scene, known.kind);
    parameter.prior_sigma = std::max(known.share * std::abs(parameter.start), known.least);
    parameter.low = known.low;
    parameter.high = known.high;
    parameter.unit = known.unit;
    // The tube around them limits chamber radius and pitch radius. The bound is a micrometre smaller, so that a value at the
    // bound is still legal when it is read back.
    constexpr double kMargin = 1e-6;
    const CrossSection& section = firstSegment(scene).section;
    const double inner = section.lumen_radius, outer = section.outer_radius;
    const double pitch = section.chambers.pitch_radius, radius = section.chambers.radius;
    if (known.kind == ParameterKind::kPitchRadius) {
      parameter.low = inner + radius + kMargin;
      parameter.high = outer - radius - kMargin;
    }
    if (known.kind == ParameterKind::kChamberRadius) {
      parameter.low = 0.5 * radius;
      parameter.high = std::min(pitch - inner, outer - pitch) - kMargin;
    }
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
  ParameterStep step{values, values, 0.0};
  step.above[k] = std::min(values[k] + p.step, p.high);
  step.below[k] = std::max(values[k] - p.step, p.low);
  step.distance = step.above[k] - step.below[k];
  return step;
}

Scene withParameters(const Scene& scene, const std::vector<SceneParameter>& parameters, const Eigen::VectorXd& values) {
  Scene result = scene;
  for (size_t k = 0; k < parameters.size(); ++k) {
    const double value = values[static_cast<long>(k)];
    if (parameters[k].kind == ParameterKind::kTipMass) result.tip_mass = value;
    else if (parameters[k].kind == ParameterKind::kLinkMass) lastLink(result)->mass = value;
    else
      for (Body& body : result.chain)
        if (auto* segment = std::get_if<Segment>(&body)) setIn(*segment, parameters[k], value);
  }
  return result;
}

}  // namespace live_stiffness
