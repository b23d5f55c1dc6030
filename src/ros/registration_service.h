#pragma once
// ~register: registration of base and sensor from the recent past of the running robot. Also publishes tf tracker -> base.

#include <live_stiffness/Register.h>
#include <ros/node_handle.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "estimation/registration_buffer.h"
#include "ros/node_parameters.h"

namespace live_stiffness {

class RegistrationService {
 public:
  using OnApply = std::function<void(const Registration& registration)>;

  // Advertises ~register and publishes the transform of the parameters' registration, if there is one. Calls on_apply with a
  // new registration to use. parameters must outlive this. Requests may come in another thread than pressures and poses.
  RegistrationService(ros::NodeHandle private_node, std::shared_ptr<const StiffnessModel> model,
                      const NodeParameters& parameters, OnApply on_apply);

  // As in RegistrationBuffer. time: s, on the clock of the pressures. Pressures come from one thread, which never waits here.
  void addPressures(PressuresRef pressures, const ros::Time& stamp);
  void addPose(const Pose& X_AS, const Wrench& tip_wrench, bool in_contact, double time) {
    const std::lock_guard<std::mutex> lock(mutex_);
    buffer_->addPose(X_AS, tip_wrench, in_contact, time);
  }

  // Forgets the past; call it with a new model, too, and while no pressures come.
  void restart(std::shared_ptr<const StiffnessModel> model);

  // Always returns true; a request that cannot be fulfilled gets success = false.
  bool answer(Register::Request& request, Register::Response& response);

 private:
  void sendTransform(const Registration& registration);
  bool save(const std::string& path, const Registration& registration, const std::string& comment,
            Register::Response& response) const;

  const NodeParameters& parameters_;
  OnApply on_apply_;
  std::vector<std::pair<double, Pressures>> waiting_;  // time, s, and pressures that came while the past was copied
  std::mutex mutex_;  // of these two
  std::shared_ptr<const StiffnessModel> model_;
  std::unique_ptr<RegistrationBuffer> buffer_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::ServiceServer server_;
};

}  // namespace live_stiffness
