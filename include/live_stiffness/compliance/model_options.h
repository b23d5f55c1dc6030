#pragma once
// Which of the paper's models to run, and how finely.

#include <string>

#include "live_stiffness/parameters.h"
#include "live_stiffness/section/stepping.h"

namespace live_stiffness {

// The paper's four models are two switches:
//
//                               external_loads = false      external_loads = true
//   stepping = kLinear                  LPCC                        LCM
//   stepping = kFixedStep               NPCC                        NCM
//
// kContinuous, the limit of small steps, can replace kFixedStep in both.
struct ModelOptions {
  bool external_loads = true;  // false: weight and tip wrench are ignored (piecewise constant curvature)
  Stepping stepping = Stepping::kFixedStep;
  double pressure_step = kPressureStep.standard;  // largest step of kFixedStep, Pa
  double accuracy = kAccuracy.standard;  // relative, of pose and compliance, by which stages and elements are chosen

  // Calls visit(parameter, field) for each field that is a parameter.
  template <class Options, class Visit>
  static void forEachParameter(Options& options, Visit&& visit) {
    visit(kPressureStep, options.pressure_step);
    visit(kAccuracy, options.accuracy);
  }
};

// Options from their names. model: lpcc, npcc, lcm, ncm or empty (external loads act); stepping: fixed_step,
// continuous, linear or empty (what the model implies, fixed_step without one). Unknown names and a stepping that
// contradicts the model become faults.
ModelOptions namedModelOptions(const std::string& model, const std::string& stepping, FaultList& faults,
                               ModelOptions others = {});

// "LPCC", "NPCC", "LCM" or "NCM".
std::string modelName(const ModelOptions& options);
std::string steppingName(Stepping stepping);  // as in namedModelOptions

}  // namespace live_stiffness
