// Registration files: refused with a ConfigurationError, or two poses that survive being written and read again.

#include "fuzz_target.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/estimation/registration.h"

using namespace live_stiffness;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  Registration registration;
  try {
    registration = parseRegistration(textOf(data, size), "fuzz");
  } catch (const ConfigurationError& error) {
    require(!error.faults().empty(), "a refusal has a reason");
    return 0;
  }
  for (const Pose& X : {registration.X_AB, registration.X_TS}) {
    require(X.p.allFinite(), "positions are finite");
    // Rounding of a normalised quaternion: a few 1e-16.
    require((X.R * X.R.transpose() - Matrix3::Identity()).norm() < 1e-12, "rotations are rotations");
  }
  const Registration again = parseRegistration(registrationText(registration, "a comment"), "fuzz");
  require(again.X_AB.p == registration.X_AB.p && again.X_TS.p == registration.X_TS.p, "positions survive");
  require((again.X_AB.R - registration.X_AB.R).norm() < 1e-12, "rotations survive");
  return 0;
}
