#include "live_stiffness/estimation/registration_fit.h"

#include <algorithm>

#include "estimation/orientation_check.h"
#include "estimation/position_fit.h"
#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

void checkSamples(const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS) {
  FaultList faults("registration fit");
  if (X_BT.size() != X_AS.size())
    faults.add(std::to_string(X_BT.size()) + " predicted and " + std::to_string(X_AS.size()) +
               " measured poses: must be the same number");
  if (X_BT.size() < 3) faults.add(std::to_string(X_BT.size()) + " samples: must be at least 3");
  const auto count_bad = [&](const std::vector<Pose>& poses, const std::string& what) {
    const auto bad = std::count_if(poses.begin(), poses.end(),
                                   [](const Pose& X) { return !X.p.allFinite() || !X.R.allFinite(); });
    if (bad > 0) faults.add(std::to_string(bad) + " " + what + " poses are not finite");
  };
  count_bad(X_BT, "predicted");
  count_bad(X_AS, "measured");
  faults.throwIfAny();
}

}  // namespace

RegistrationFit fitRegistration(const std::vector<Pose>& X_BT, const std::vector<Pose>& X_AS,
                                std::optional<TrackerMeasures> measures) {
  checkSamples(X_BT, X_AS);
  RegistrationFit fit;
  const OrientationCheck check = checkOrientations(X_BT, X_AS, measures);
  fit.measures = check.measures;
  fit.orientations = check.text();
  fit.orientations_fit = !check.wrong();
  PositionFit best = fitPositions(X_BT, X_AS, fit.measures != TrackerMeasures::kPosition);
  fit.base_rotation_determined = best.base_rotation_determined;
  fit.sensor_offset_determined = best.sensor_offset_determined;
  fit.weakest_sensitivity = best.weakest_sensitivity;
  fit.registration.X_AB = best.X_AB;
  fit.registration.X_TS = {sensorRotation(best.X_AB.R, X_BT, X_AS, fit.measures), best.offset};
  fit.residuals = std::move(best.residuals);
  fit.position = summarizeErrors(fit.residuals);
  std::vector<double> angles;
  for (size_t i = 0; i < X_BT.size() && fit.measures != TrackerMeasures::kPosition; ++i)
    angles.push_back(rotationBetween(fit.registration.sensorPose(X_BT[i]).R, X_AS[i].R, fit.measures));
  fit.rotation = summarizeErrors(std::move(angles));
  return fit;
}

std::string RegistrationFit::advice() const {
  std::string what;
  if (!base_rotation_determined) what = "the base's rotation";
  if (!sensor_offset_determined) what += (what.empty() ? "" : " and ") + std::string("the sensor's offset");
  std::string advice = orientations_fit ? "" : orientations;
  if (what.empty()) return advice;
  return advice + (advice.empty() ? "" : "; ") + "the motion does not determine " + what + " (sensitivity " +
         numberText(weakest_sensitivity) + " < " + numberText(kWeakSensitivity) +
         "): bend the robot far in at least two directions, or measure the offset";
}

std::string RegistrationFit::unmeasured() const {
  if (measures == TrackerMeasures::kPose) return "";
  return std::string(measures == TrackerMeasures::kPosition ? "the sensor's rotation" : "the sensor's turn about its z axis") +
         " is not measured (tracker_measures: " + trackerMeasuresName(measures) + ")";
}

}  // namespace live_stiffness
