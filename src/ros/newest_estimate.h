#pragma once
// What a node knows about its robot at the moment, for those who ask it questions from another thread.

#include <ros/time.h>

#include <functional>
#include <memory>

#include "live_stiffness/estimation/stiffness_estimator.h"

namespace live_stiffness {

struct NewestEstimate {
  std::shared_ptr<const StiffnessModel> model;  // another one after ~reload
  std::shared_ptr<const Estimate> estimate;     // a copy of the last good one; nullptr before the first
  ros::Time stamp;                              // of its pressures
  bool stale = false;                           // it is not that of the newest pressures
};
using AskNewest = std::function<NewestEstimate()>;

// The newest model with a workspace of one's own, so that the live solver stays as it is.
class OwnSolver {
 public:
  // True if it is another model than before.
  bool follow(const std::shared_ptr<const StiffnessModel>& newest) {
    if (newest == model_) return false;
    model_ = newest;
    workspace_.reset(new StiffnessWorkspace(model_->makeWorkspace()));
    return true;
  }
  // Only after follow().
  const StiffnessModel& model() const { return *model_; }
  StiffnessWorkspace& workspace() const { return *workspace_; }

 private:
  std::shared_ptr<const StiffnessModel> model_;
  std::unique_ptr<StiffnessWorkspace> workspace_;
};

}  // namespace live_stiffness
