#include "live_stiffness/compliance/model_options.h"

namespace live_stiffness {

ModelOptions namedModelOptions(const std::string& model, const std::string& stepping, FaultList& faults,
                               ModelOptions options) {
  const bool is_linear_model = model == "lpcc" || model == "lcm";
  const bool is_nonlinear_model = model == "npcc" || model == "ncm";
  if (!model.empty()) faults.check(kModel, model);
  faults.check(kStepping, stepping);
  options.external_loads = model != "lpcc" && model != "npcc";

  if (stepping == "fixed_step" || (stepping.empty() && !is_linear_model)) options.stepping = Stepping::kFixedStep;
  else if (stepping == "continuous") options.stepping = Stepping::kContinuous;
  else if (stepping == "linear" || stepping.empty()) options.stepping = Stepping::kLinear;

  const bool steps_linearly = options.stepping == Stepping::kLinear;
  if ((is_linear_model && !steps_linearly) || (is_nonlinear_model && steps_linearly))
    faults.add("stepping = " + stepping + ": contradicts model = " + model + "; leave one of them out, or use " +
               (is_linear_model ? "linear" : "fixed_step or continuous"));
  return options;
}

std::string modelName(const ModelOptions& options) {
  const std::string prefix = options.stepping == Stepping::kLinear ? "L" : "N";
  return prefix + (options.external_loads ? "CM" : "PCC");
}

std::string steppingName(Stepping stepping) {
  switch (stepping) {
    case Stepping::kFixedStep: return "fixed_step";
    case Stepping::kContinuous: return "continuous";
    case Stepping::kLinear: return "linear";
  }
  return "unknown";
}

}  // namespace live_stiffness
