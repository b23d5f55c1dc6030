#include "live_stiffness/estimation/registration.h"

#include <locale>
#include <sstream>

#include "part_file.h"
#include "yaml_map.h"

namespace live_stiffness {
namespace {

Pose readPose(YamlMap& document, const std::string& key, FaultList& faults) {
  // Smaller quaternions have no direction after rounding; squares of larger ones may overflow.
  const Range norm{1e-3, 1e3};
  Pose X;
  const YAML::Node node = document.child(key);
  if (!node.IsDefined()) {
    document.fault(key + " is missing: must be {position_m: [x, y, z], quaternion_wxyz: [w, x, y, z]}");
    return X;
  }
  YamlMap map(node, key, faults);
  X.p = map.vector("position_m");
  const std::vector<double> wxyz = map.numbers("quaternion_wxyz", 4);
  if (wxyz.size() == 4) {
    const Eigen::Quaterniond q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    if (q.coeffs().allFinite()) {  // otherwise the fault was already reported
      if (norm.contains(q.norm())) X.R = q.normalized().toRotationMatrix();
      else map.fault("quaternion_wxyz", "norm is " + numberText(q.norm()) + ": must be 0.001 to 1000, should be 1");
    }
  }
  map.finish();
  return X;
}

void writePose(std::ostream& text, const std::string& key, const Pose& X) {
  const Eigen::Quaterniond q(X.R);
  text << key << ":\n"
       << "  position_m: [" << X.p.x() << ", " << X.p.y() << ", " << X.p.z() << "]\n"
       << "  quaternion_wxyz: [" << q.w() << ", " << q.x() << ", " << q.y() << ", " << q.z() << "]\n";
}

}  // namespace

Registration parseRegistration(const std::string& yaml, const std::string& name) {
  FaultList faults("registration " + name);
  Registration registration;
  readDocument(yaml, faults, [&](YamlMap& map) {
    registration.X_AB = readPose(map, "base_in_tracker", faults);
    registration.X_TS = readPose(map, "sensor_on_tip", faults);
    registration.tracker_delay =
        map.number("tracker_delay_s", {-Registration::kLargestDelay, Registration::kLargestDelay}, 0.0);
    map.finish();
  });
  faults.throwIfAny();
  return registration;
}

Registration loadRegistrationFile(const std::string& path) {
  return parseRegistration(readTextFile("registration", path), path);
}

std::string registrationText(const Registration& registration, const std::string& comment) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) text << "# " << line << "\n";
  writePose(text, "base_in_tracker", registration.X_AB);
  writePose(text, "sensor_on_tip", registration.X_TS);
  if (registration.tracker_delay != 0.0) text << "tracker_delay_s: " << registration.tracker_delay << "\n";
  return text.str();
}

void saveRegistrationFile(const std::string& path, const Registration& registration, const std::string& comment) {
  writeTextFile("registration", path, registrationText(registration, comment));
}

}  // namespace live_stiffness
