#include "analysis/scene_description.h"

#include <algorithm>
#include <cmath>

#include "live_stiffness/checks.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {
namespace {

constexpr double kBar = 1e5;              // Pa
constexpr int kMostChambers = 64;         // that are described
constexpr double kMostWeights = 1e6;      // by which buckling is looked for

std::string line(std::string title, const std::string& text) {
  title.resize(std::max<size_t>(title.size() + 1, 12), ' ');
  return title + text + "\n";
}

std::string millimetres(const Vector3& p) {
  const auto text = [](double length) { return fixedText(1e-2 * std::round(1e5 * length) + 0.0, 2); };  // no -0.00
  return "(" + text(p.x()) + ", " + text(p.y()) + ", " + text(p.z()) + ") mm";
}

std::string degreesText(double angle) { return fixedText(degrees(angle), 1) + " deg"; }

// "+x", or "40 deg from +x to +y".
std::string directionText(double x, double y) {
  const double azimuth = std::atan2(y, x), quarter = std::round(azimuth / (0.5 * kPi)), rest = azimuth - quarter * 0.5 * kPi;
  const char* const axes[] = {"+x", "+y", "-x", "-y"};
  const int axis = (static_cast<int>(quarter) + 4) % 4, next = (axis + (rest > 0.0 ? 1 : 3)) % 4;
  if (std::abs(rest) < radians(1.0)) return axes[axis];
  return fixedText(std::abs(degrees(rest)), 0) + " deg from " + axes[axis] + " to " + axes[next];
}

std::string lengthsText(const Scene& scene) {
  std::string parts;
  const auto add = [&](const std::string& name, double length) {
    parts += (parts.empty() ? "" : ", ") + name + " " + numberText(1e3 * length);
  };
  walk(
      scene, [&](int, const Segment& segment) { add(segment.name, segment.length); },
      [&](const Link& link) { add("link", link.length); });
  return numberText(1e3 * scene.length()) + " mm: " + parts + "; tip point " + millimetres(scene.tip_offset) + " from the end";
}

std::string massesText(const Scene& scene) {
  std::string parts;
  double sum = 0.0;
  const auto add = [&](const std::string& name, double mass) {
    parts += name + " " + numberText(1e3 * mass) + ", ";
    sum += mass;
  };
  walk(
      scene, [&](int, const Segment& segment) { add(segment.name, segment.mass()); },
      [&](const Link& link) { add("link", link.mass); });
  add("tip", scene.tip_mass);
  return numberText(1e3 * sum) + " g: " + parts.substr(0, parts.size() - 2);
}

std::string gravityText(const Scene& scene) {
  if (!scene.hasWeight()) return "none: masses do not matter";
  const Vector3& g = *scene.gravity;
  const double angle = std::atan2(std::hypot(g.x(), g.y()), g.z());
  const std::string norm = numberText(g.norm()) + " m/s2, ";
  if (angle < radians(1.0)) return norm + "along +z of the base: the arm hangs";
  if (angle > radians(179.0)) return norm + "along -z of the base: the arm stands";
  const std::string side = "to " + directionText(g.x(), g.y());
  if (std::abs(degrees(angle) - 90.0) < 1.0) return norm + side + " of the base: the arm is held out sideways";
  return norm + degreesText(angle) + " from +z of the base, " + side + ": the arm " +
         (g.z() > 0.0 ? "hangs" : "stands") + " at an angle";
}

// Solves from a cold start.
struct Solver {
  const StiffnessModel model;
  StiffnessWorkspace workspace;

  explicit Solver(const Scene& scene) : model(scene, ModelOptions{}), workspace(model.makeWorkspace()) {}

  StiffnessSolution solve(int chamber, double pressure) {
    Pressures pressures = Pressures::Zero(model.scene().chamberCount());
    if (chamber >= 0) pressures[chamber] = pressure;
    workspace.reset();
    return model.solve(pressures, Wrench::Zero(), workspace);
  }

  // Of the last solve: how far the arm turns from base to tip, rad; more than a turn where it coils up.
  double turn() const {
    constexpr int kParts = 8;  // of a segment
    double sum = 0.0;
    Vector3 before = Vector3::UnitZ();
    for (int segment = 0; segment < model.scene().segmentCount(); ++segment)
      for (int part = 1; part <= kParts; ++part) {
        const Vector3 axis = model.station(workspace, segment, part / static_cast<double>(kParts)).X_BQ.R.col(2);
        sum += std::atan2(before.cross(axis).norm(), before.dot(axis));
        before = axis;
      }
    return sum;
  }
};

// True if the robot, which has all weight on its axis, is straight at rest under so many times that.
bool staysStraight(Scene scene, double weights) {
  *scene.gravity *= weights;
  const StiffnessSolution rest = Solver(scene).solve(-1, 0.0);
  return rest.status.ok() && rest.X_BT.p.head<2>().norm() < 1e-6 * scene.length();
}

std::string bucklingText(Scene scene) {
  if (!scene.hasWeight() || scene.gravity->z() >= 0.0) return "none: no weight presses along the arm";
  scene.gravity->head<2>().setZero();
  scene.tip_offset.head<2>().setZero();
  double low = 1.0, high = 1.0;
  while (low > 1.0 / kMostWeights && !staysStraight(scene, low)) high = low, low *= 0.5;
  while (high <= low && high < kMostWeights)
    if (high *= 2.0; staysStraight(scene, high)) low = high;
  if (low >= kMostWeights) return "at more than " + numberText(kMostWeights) + " times the weight along its axis";
  while (high > 1.0002 * low) {
    const double middle = std::sqrt(low * high);
    (staysStraight(scene, middle) ? low : high) = middle;
  }
  const std::string factor = fixedText(low, low < 10.0 ? 2 : 0);
  return "the straight arm buckles at about " + factor + " times the weight along its axis" +
         (low < 1.0 ? ": IT CANNOT STAND" : "");
}

std::string complianceText(const StiffnessSolution& rest) {
  const Matrix6& C = rest.compliance;
  const auto text = [&](int i) { return numberText(1e3 * C(i, i)); };
  return "x " + text(0) + ", y " + text(1) + ", z " + text(2) + " mm/N; twist about z " + numberText(degrees(C(5, 5))) +
         " deg/(N m)";
}

// What a pressure in one chamber does; less than 1 bar where that is too much for it, or coils it up.
std::string chamberText(Solver& solver, const StiffnessSolution& rest, int chamber) {
  double pressure = kBar;
  StiffnessSolution bent = solver.solve(chamber, pressure);
  std::string text;
  const auto is_too_much = [&] { return !bent.status.ok() || solver.turn() > kPi; };
  for (; is_too_much() && pressure > 1e-3 * kBar; bent = solver.solve(chamber, pressure)) {
    if (text.empty())
      text = bent.status.ok() ? "coils up by " + degreesText(solver.turn()) : std::string(codeName(bent.status.code));
    pressure *= 0.5;
  }
  if (!text.empty()) text += " at 1 bar; ";
  if (!bent.status.ok()) return text + "as at less";
  if (!text.empty()) text += "at " + numberText(pressure / kBar) + " bar ";
  const Vector3 moved = bent.X_BT.p - rest.X_BT.p;
  const double turn = std::acos(std::clamp(bent.X_BT.R.col(2).dot(rest.X_BT.R.col(2)), -1.0, 1.0));
  const bool bends = turn > radians(0.05) || moved.head<2>().norm() > 1e-4 * solver.model.scene().length();
  if (!bends) text += "does not bend; the tip moves by " + fixedText(1e3 * moved.norm(), 2) + " mm";
  else text += "bends by " + degreesText(turn) + " towards " + directionText(moved.x(), moved.y()) + "; the tip moves by " +
               fixedText(1e3 * moved.norm(), 2) + " mm";
  return text + " to " + millimetres(bent.X_BT.p);
}

std::string chambersText(const Scene& scene, Solver& solver, const StiffnessSolution& rest) {
  std::string text;
  int chamber = 0;
  walk(
      scene,
      [&](int, const Segment& segment) {
        for (double azimuth : segment.section.chambers.azimuths)
          if (chamber++ < kMostChambers)
            text += line("chamber " + std::to_string(chamber), "(" + segment.name + ", azimuth " +
                         numberText(degrees(azimuth)) + " deg) " + chamberText(solver, rest, chamber - 1));
      },
      [](const Link&) {});
  if (chamber > kMostChambers) text += "and " + std::to_string(chamber - kMostChambers) + " more chambers\n";
  return text.empty() ? text : "With 1 bar in one chamber:\n" + text;
}

}  // namespace

std::string describeScene(const Scene& scene) {
  std::string text = line("lengths", lengthsText(scene)) + line("masses", massesText(scene)) +
                     line("gravity", gravityText(scene)) + line("buckling", bucklingText(scene));
  Solver solver(scene);
  const StiffnessSolution rest = solver.solve(-1, 0.0);
  if (rest.status.ok()) {
    const Vector3 unloaded = Vector3(0.0, 0.0, scene.length()) + scene.tip_offset;
    text += line("at rest", "tip at " + millimetres(rest.X_BT.p) + ", " +
                 fixedText(1e3 * (rest.X_BT.p - unloaded).norm(), 2) + " mm from where it is without weight");
    text += line("compliance", complianceText(rest)) + chambersText(scene, solver, rest);
  } else {
    text += line("at rest", solver.model.describe(rest.status));
  }
  const std::vector<std::string> doubts = doubtsAbout(scene);
  text += doubts.empty() ? "No doubts.\n" : "Doubts:\n";
  for (const std::string& doubt : doubts) text += "  - " + doubt + "\n";
  return text;
}

}  // namespace live_stiffness
