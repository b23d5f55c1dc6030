// live_stiffness/StiffnessNodelet: stiffness_node in a nodelet manager. Estimates pass without a copy to nodelets of
// the same manager.

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "ros/node_process.h"
#include "ros/stiffness_node.h"

namespace live_stiffness {

class StiffnessNodelet : public nodelet::Nodelet {
 private:
  // The manager does not load a nodelet that throws here, but does not say why.
  void onInit() override try {
    node_ = std::make_unique<StiffnessNode>(getNodeHandle(), getPrivateNodeHandle());
    master_ = std::make_unique<MasterCheck>(false);
  } catch (const std::exception& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }

  std::unique_ptr<StiffnessNode> node_;
  std::unique_ptr<MasterCheck> master_;
};

}  // namespace live_stiffness

PLUGINLIB_EXPORT_CLASS(live_stiffness::StiffnessNodelet, nodelet::Nodelet)
