#include "ros/registration_service.h"

#include <ros/console.h>

#include "ros/conversions.h"

namespace live_stiffness {

RegistrationService::RegistrationService(ros::NodeHandle private_node, std::shared_ptr<const StiffnessModel> model,
                                         const NodeParameters& parameters, OnApply on_apply)
    : parameters_(parameters),
      on_apply_(std::move(on_apply)),
      server_(private_node.advertiseService("register", &RegistrationService::answer, this)) {
  restart(std::move(model));
  if (parameters_.is_registered) sendTransform(parameters_.registration);
}

void RegistrationService::restart(std::shared_ptr<const StiffnessModel> model) {
  auto buffer =
      std::make_unique<RegistrationBuffer>(*model, parameters_.registration_buffer, parameters_.pressure_timeout);
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.clear();
  buffer_ = std::move(buffer);
  model_ = std::move(model);
}

// Copying the past takes milliseconds, which must not delay an estimate.
void RegistrationService::addPressures(PressuresRef pressures, const ros::Time& stamp) {
  waiting_.emplace_back(stamp.toSec(), pressures);
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  for (const auto& [time, of_then] : waiting_) buffer_->addPressures(of_then, time);
  waiting_.clear();
}

void RegistrationService::sendTransform(const Registration& registration) {
  broadcaster_.sendTransform(
      toTransform(registration.X_AB, ros::Time::now(), parameters_.tracker_frame, parameters_.frames.base));
}

bool RegistrationService::save(const std::string& path, const Registration& registration, const std::string& comment,
                               Register::Response& response) const {
  if (path.empty()) {
    response.message += "; not saved: neither file nor ~registration_file says where";
    return false;
  }
  try {
    saveRegistrationFile(path, registration, comment);
  } catch (const ConfigurationError& error) {
    response.message += "; not saved to " + path + ": " + error.faults().front();
    return false;
  }
  response.saved_to = path;
  response.message += "; saved to " + path;
  return true;
}

bool RegistrationService::answer(Register::Request& request, Register::Response& response) {
  FaultList faults("register");
  if (request.duration != 0.0) faults.check("duration", request.duration, {0.0, parameters_.registration_buffer, true});
  if (!faults.empty()) {
    response.message = faults.faults().front() + " (~registration_buffer_s)";
    return true;
  }
  RegistrationWindow window;
  window.duration = request.duration == 0.0 ? parameters_.registration_buffer : request.duration;
  window.quasi_static_only = request.quasi_static_only;
  window.leave_out_contact = request.leave_out_contact;
  if (!parameters_.tracker_measures.empty()) window.measures = trackerMeasuresNamed(parameters_.tracker_measures);
  std::shared_ptr<const StiffnessModel> model;  // kept while it is in use
  std::unique_ptr<const RegistrationBuffer> past;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    model = model_;
    past = std::make_unique<const RegistrationBuffer>(*buffer_);
  }
  LiveRegistration result = past->fit(window);
  if (!result.fault.empty()) {
    response.message = result.fault;
    return true;
  }
  result.fit.registration.tracker_delay = parameters_.registration.tracker_delay;  // the poses were already corrected for it
  fillRegistration(result, response);
  response.success = true;
  response.message = result.text();
  const bool wants_file = request.save || !request.file.empty();
  if ((request.apply || wants_file) && !result.fit.determined() && !request.even_if_undetermined) {
    response.success = false;
    response.message += "; neither applied nor saved (even_if_undetermined would)";
    return true;
  }
  if (request.apply) {
    on_apply_(result.fit.registration);
    sendTransform(result.fit.registration);
    response.applied = true;
    response.message += "; applied";
  }
  if (wants_file)
    response.success =
        save(request.file.empty() ? parameters_.registration_file : request.file, result.fit.registration,
             "Fitted by ~register of stiffness_node:\n" + result.text(), response);
  ROS_INFO_STREAM("registration: " << response.message);
  return true;
}

}  // namespace live_stiffness
