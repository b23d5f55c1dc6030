#include <algorithm>
#include <cmath>

#include "analysis/scene_description.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

// What is usual for soft arms of any size; beyond it a slip is more likely. docs/tutorial.md has this table.
constexpr double kLongest = 3.0;            // of a segment or link, m
constexpr double kWidest = 0.3;             // outer radius, m
constexpr double kHeaviest = 5.0;           // a link, or what the tip carries, kg
constexpr double kHeaviestLoad = 20.0;      // the same, in masses of all segments
constexpr Range kModulus{5e3, 5e9};         // Pa
constexpr Range kShearRatio{1.0 / 30, 3.0}; // shear modulus in Young's moduli; 1/3 if incompressible
constexpr Range kDensity{20.0, 23e3};       // foam to osmium, kg/m^3
constexpr Range kGravity{1.6, 25.0};        // Moon to Jupiter, m/s^2
constexpr double kFilled = 0.5;             // chambers reach beyond this share of the outer radius
constexpr double kThinnest = 0.05;          // wall outside the chambers, in their radii
constexpr double kStretched = 0.5;          // strain by what hangs or stands on a segment

// What is doubtful in the same way at several places is said once.
class Doubts {
 public:
  void add(const std::string& where, const std::string& what) {
    const auto same = std::find(whats_.begin(), whats_.end(), what);
    if (same == whats_.end()) whats_.push_back(what), places_.push_back({where});
    else places_[same - whats_.begin()].push_back(where);
  }
  void add(const std::string& where, const std::string& key, double value, const std::string& why) {
    add(where, key + " = " + numberText(value) + ": " + why);
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (size_t i = 0; i < whats_.size(); ++i) {
      const size_t more = places_[i].size() - 1;
      texts.push_back(places_[i].front() + (more > 0 ? " and " + std::to_string(more) + " more" : "") + ": " + whats_[i]);
    }
    return texts;
  }

 private:
  std::vector<std::string> whats_;
  std::vector<std::vector<std::string>> places_;  // of each
};

void checkLength(const std::string& where, double length, Doubts& doubts) {
  if (length > kLongest)
    doubts.add(where, "length_m", length, "longer than " + numberText(kLongest) + " m; if it is in mm, write " +
               numberText(1e-3 * length) + ", if in cm, " + numberText(1e-2 * length));
}

void checkSizes(const std::string& where, const Segment& segment, Doubts& doubts) {
  const CrossSection& section = segment.section;
  const Chambers& chambers = section.chambers;
  checkLength(where, segment.length, doubts);
  if (section.outer_radius > kWidest) {
    doubts.add(where, "outer_radius_m", section.outer_radius, "more than " + numberText(kWidest) +
               " m; if it is in mm, write " + numberText(1e-3 * section.outer_radius));
    return;
  }
  if (chambers.count() == 0) return;
  const double reach = chambers.pitch_radius + chambers.radius, wall = section.outer_radius - reach;
  if (chambers.pitch_radius > 0.0 && reach < kFilled * section.outer_radius)
    doubts.add(where, "outer_radius_m", section.outer_radius, "the chambers end at " + numberText(reach) +
               " m, less than half of it; if it is the diameter, write " + numberText(0.5 * section.outer_radius));
  else if (wall < kThinnest * chambers.radius)
    doubts.add(where, "chamber_radius_m", chambers.radius, "leaves a wall of " + numberText(1e3 * std::max(0.0, wall)) +
               " mm outside the chambers; if it is the diameter, write " + numberText(0.5 * chambers.radius));
  else if (segment.length <= 2.0 * section.outer_radius * (1.0 + 1e-9))
    doubts.add(where, "outer_radius_m", section.outer_radius, "the segment is no longer than it is wide, " +
               numberText(segment.length) + " m; if this and the other radii are diameters, halve them");
}

// In radians an angle between chambers is a multiple of 15 deg, rounded to two digits or better, or all of them are
// within one turn of 6.28.
bool areRadians(const std::vector<double>& azimuths_deg) {
  const auto [least, most] = std::minmax_element(azimuths_deg.begin(), azimuths_deg.end());
  constexpr double kTurn = 2.0 * kPi + 0.01;
  if (azimuths_deg.empty() || *most > kTurn || *least < -kTurn) return false;
  if (azimuths_deg.size() > 2) return *most - *least > 0.0;
  const double angle = std::abs(azimuths_deg.back() - (azimuths_deg.size() > 1 ? azimuths_deg.front() : 0.0));
  const double part = kPi / 12.0, times = std::round(angle / part);
  return times > 0.0 && std::abs(angle - times * part) < 0.006;
}

void checkAzimuths(const std::string& where, const Chambers& chambers, Doubts& doubts) {
  std::vector<double> azimuths_deg;
  for (double azimuth : chambers.azimuths) azimuths_deg.push_back(degrees(azimuth));
  if (areRadians(azimuths_deg)) {
    const double last = azimuths_deg.back();
    doubts.add(where, "chamber_azimuths_deg up to " + numberText(last) + " deg: all chambers are within a few degrees; if "
               "these are radians, write degrees, such as " + numberText(std::round(degrees(last))) + " for the last");
    return;
  }
  // Chambers in nearly one place may stand for a larger one, as the pairs of Shi et al. do, if there are others elsewhere and
  // all places have as many. What overlaps in part stands for nothing.
  const int count = chambers.count();
  std::vector<int> together(count, 1);  // chambers in the place of each
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      const double distance = (chambers.centre(i, 1.0) - chambers.centre(j, 1.0)).norm();
      if (distance < 0.5 * chambers.radius) {
        ++together[i], ++together[j];
      } else if (distance < 2.0 * chambers.radius * (1.0 - 1e-6)) {
        doubts.add(where, "chambers " + std::to_string(i + 1) + " and " + std::to_string(j + 1) + " overlap: their centres are " +
                   numberText(1e3 * distance) + " mm apart, less than two times chamber_radius_m = " +
                   numberText(chambers.radius) + "; is that the diameter, or an azimuth wrong?");
        return;
      }
    }
  const auto [least, most] = std::minmax_element(together.begin(), together.end());
  if (count > 1 && (*least != *most || *most == count))
    doubts.add(where, std::to_string(*most) + " of " + std::to_string(count) + " chambers are in one place; see "
               "chamber_azimuths_deg and chamber_pitch_radius_m = " + numberText(chambers.pitch_radius));
}

void checkMaterial(const std::string& where, const CrossSection& section, Doubts& doubts) {
  const double E = section.youngs_modulus;
  if (E < kModulus.low)
    doubts.add(where, "youngs_modulus_pa", E, std::string("softer than any elastomer, 5 kPa; ") +
               (E >= 5.0 ? "if it is in kPa, write " + numberText(1e3 * E) : E >= 5e-3 ? "if it is in MPa, write " +
                numberText(1e6 * E) : "if it is in GPa, write " + numberText(1e9 * E)));
  else if (E > kModulus.high)
    doubts.add(where, "youngs_modulus_pa", E, "stiffer than elastomers and plastics, 5 GPa; right for metal or fibres only. "
               "If a smaller unit was meant, write " + numberText(1e-3 * E));
  const double ratio = section.shear_modulus / E;
  if (!kShearRatio.contains(ratio))
    doubts.add(where, "shear_modulus_pa", section.shear_modulus, "youngs_modulus_pa is " + numberText(1.0 / ratio) +
               " times as much, and three times for an elastomer; are both in Pa?");
  if (section.density > 0.0 && !kDensity.contains(section.density))
    doubts.add(where, "density_kg_m3", section.density, section.density < kDensity.low
               ? "lighter than foam, 20 kg/m3; if it is in g/cm3, write " + numberText(1e3 * section.density)
               : "heavier than any metal; if it is in g/m3, write " + numberText(1e-3 * section.density));
}

// segments: mass of all; 0: not known.
void checkMass(const std::string& where, double mass, double segments, Doubts& doubts) {
  if (mass > kHeaviest || (segments > 0.0 && mass > kHeaviestLoad * segments))
    doubts.add(where, "mass_kg", mass, (segments > 0.0 ? numberText(mass / segments) + " times the mass of all segments, " +
               numberText(segments) + " kg" : "more than " + numberText(kHeaviest) + " kg") + "; if it is in g, write " +
               numberText(1e-3 * mass));
}

void checkGravity(const Vector3& gravity, Doubts& doubts) {
  const double g = gravity.norm();
  if (g == 0.0 || kGravity.contains(g)) return;
  doubts.add("gravity_m_s2", "its norm is " + numberText(g) + " m/s2, and 9.81 on Earth; " +
             (g > kGravity.high ? "if it is in mm/s2, divide it by 1000" : "if it is in multiples of g, multiply it by 9.81"));
}

}  // namespace

std::vector<std::string> doubtsAbout(const Scene& scene) {
  Doubts doubts;
  const bool has_weight = scene.hasWeight();
  double segments = 0.0;  // mass of all, kg; 0 where a density is doubtful or masses do not matter
  bool densities_fit = has_weight;
  walk(
      scene,
      [&](int, const Segment& segment) {
        segments += segment.mass();
        densities_fit &= kDensity.contains(segment.section.density);
      },
      [](const Link&) {});
  if (!densities_fit) segments = 0.0;
  if (scene.gravity) checkGravity(*scene.gravity, doubts);
  int links = 0;
  walk(
      scene,
      [&](int, const Segment& segment) {
        const std::string where = "segment " + segment.name;
        checkSizes(where, segment, doubts);
        checkAzimuths(where, segment.section.chambers, doubts);
        checkMaterial(where, segment.section, doubts);
      },
      [&](const Link& link) {
        const std::string where = "link " + std::to_string(++links);
        checkLength(where, link.length, doubts);
        checkMass(where, link.mass, segments, doubts);
      });
  checkMass("tip", scene.tip_mass, segments, doubts);
  const double offset = scene.tip_offset.norm();
  if (offset > std::max(1.0, 3.0 * scene.length()))
    doubts.add("tip", "offset_m: " + numberText(offset) + " m from the end of the arm, which is " + numberText(scene.length()) +
               " m long; if it is in mm, divide it by 1000");
  std::vector<std::string> texts = doubts.texts();
  if (!texts.empty() || !has_weight) return texts;
  // Nothing is odd alone; is all of it together?
  double beyond = scene.tip_mass;
  for (size_t i = scene.chain.size(); i-- > 0;) {
    if (const auto* link = std::get_if<Link>(&scene.chain[i])) beyond += link->mass;
    const auto* segment = std::get_if<Segment>(&scene.chain[i]);
    if (segment == nullptr) continue;
    beyond += segment->mass();
    const CrossSection& section = segment->section;
    const double force = beyond * scene.gravity->norm(), strain = force / (section.youngs_modulus * section.area(1.0));
    if (!(strain > kStretched)) continue;
    texts.push_back("segment " + segment->name + ": the weight from there to the tip, " + numberText(force) +
                    " N, would strain it by " + numberText(100.0 * strain) + " %; are masses in kg, lengths in m and " +
                    "youngs_modulus_pa = " + numberText(section.youngs_modulus) + " in Pa?");
    break;
  }
  return texts;
}

}  // namespace live_stiffness
