#include "compliance/material_compliance.h"

#include "rod/shooting.h"

namespace live_stiffness {

void accumulateMaterial(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance) {
  const Vector3& p = backbone.X_BT.p;
  PackedRow tip;
  backbone.kernel->accumulate(stateOf(chain, DeadLoads(), Vector3::Zero(), backbone), accuracy, {p.x(), p.y(), p.z()}, tip);
  unpack(tip, tip_compliance);
}

double solveUnloaded(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance) {
  MarchResult result;
  PackedRow tip;
  const int beyond = backbone.kernel->place_chain(stateOf(chain, DeadLoads(), Vector3::Zero(), backbone), accuracy, result, tip);
  backbone.setTip(result.R_tip, result.p_tip);
  unpack(tip, tip_compliance);
  return beyond;
}

}  // namespace live_stiffness
