#pragma once
// The present state of a node, for other threads.

#include <ros/time.h>

#include <functional>
#include <memory>

#include "live_stiffness/estimation/stiffness_estimator.h"

namespace live_stiffness {

struct EstimateSnapshot {
  std::shared_ptr<const StiffnessModel> model;  // changes with ~reload
  std::shared_ptr<const Estimate> estimate;     // a copy of the last good one; nullptr before the first
  ros::Time stamp;                              // of its pressures
  bool stale = false;                           // it is not that of the newest pressures
};
using GetSnapshot = std::function<EstimateSnapshot()>;

// The newest model with its own workspace, for solves that must not change the live estimate.
class ModelWorkspace {
 public:
  // True if the model has changed.
  bool setModel(const std::shared_ptr<const StiffnessModel>& model) {
    if (model == model_) return false;
    model_ = model;
    workspace_.reset(new StiffnessWorkspace(model_->makeWorkspace()));
    return true;
  }
  // Only after setModel().
  const StiffnessModel& model() const { return *model_; }
  StiffnessWorkspace& workspace() const { return *workspace_; }

 private:
  std::shared_ptr<const StiffnessModel> model_;
  std::unique_ptr<StiffnessWorkspace> workspace_;
};

}  // namespace live_stiffness
