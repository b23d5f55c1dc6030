#include "ros/reconfiguration.h"

namespace live_stiffness {
namespace {

void checkEnd(const char* off_key, double off, const char* on_key, double on, FaultList& faults) {
  if (off > on)
    faults.add(std::string("~") + off_key + " = " + numberText(off) + ": must be from 0 to ~" + on_key + " = " +
               numberText(on));
}

}  // namespace

void apply(const StiffnessConfig& config, NodeParameters& parameters, FaultList& faults) {
  FaultList names("model");
  parameters.model = namedModelOptions(config.model, config.stepping, names);
  for (const std::string& fault : names.faults()) faults.add("~" + fault);
  parameters.model.pressure_step = config.pressure_step_pa;
  parameters.model.accuracy = config.accuracy;
  parameters.estimator.update_threshold = config.update_threshold_pa;
  ContactThresholds& contact = parameters.contact.contact;
  checkEnd("contact_off_force_n", config.contact_off_force_n, "contact_on_force_n", config.contact_on_force_n, faults);
  checkEnd("contact_off_sigmas", config.contact_off_sigmas, "contact_on_sigmas", config.contact_on_sigmas, faults);
  contact.on_force = config.contact_on_force_n;
  contact.off_force = config.contact_off_force_n;
  contact.on_sigmas = config.contact_on_sigmas;
  contact.off_sigmas = config.contact_off_sigmas;
  parameters.style.ellipsoid_scale = config.ellipsoid_scale_m_per_m_n;
  parameters.contact_arrow_scale = config.contact_arrow_n_per_m;
  parameters.show_eigenscrews = config.show_eigenscrews;
  parameters.eigenscrew_length = config.eigenscrew_length_m;
}

}  // namespace live_stiffness
