#pragma once
// Options of the tip wrench estimator: what an experimenter can know. docs/estimation.md says how to set them.

#include "live_stiffness/parameters.h"

namespace live_stiffness {

// Standard deviations unless stated; positions and forces for each axis.
struct TipWrenchOptions {
  int components = static_cast<int>(kWrenchComponents.standard);  // 3: a pure force at T; 6: force and moment
  double position_noise = kTrackerPositionNoise.si();  // white, per sample, of the tracker and of what the model does not
  double rotation_noise = kTrackerRotationNoise.si();  // follow from one sample to the next, m and rad
  double contact_force = kContactForce.si();           // size to expect in contact, N
  double model_error_position = kModelErrorPosition.si();  // of the slow twist between the model's tip and the real one:
  double model_error_rotation = kModelErrorRotation.si();  // creep that the model does not know, registration; m and rad
  double scale_deviation = kStiffnessScaleDeviation.si();  // of the logarithm of the stiffness scale at the start, -; 0: it
                                                           // stays 1
  double contact_on_force = kContactOnForce.si();          // above it contact begins, N

  template <class Options, class Visit>
  static void forEachParameter(Options& options, Visit&& visit) {
    visit(kWrenchComponents, options.components);
    visit(kTrackerPositionNoise, options.position_noise);
    visit(kTrackerRotationNoise, options.rotation_noise);
    visit(kContactForce, options.contact_force);
    visit(kModelErrorPosition, options.model_error_position);
    visit(kModelErrorRotation, options.model_error_rotation);
    visit(kStiffnessScaleDeviation, options.scale_deviation);
    visit(kContactOnForce, options.contact_on_force);
  }

  // Adds a fault unless there are 3 or 6 components; FaultList::checkAll() checks the ranges.
  void checkComponents(FaultList& faults) const;
};

}  // namespace live_stiffness
