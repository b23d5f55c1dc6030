#include "compliance/material_compliance.h"

#include "rod/shooting.h"

namespace live_stiffness {

double accumulateMaterial(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance) {
  const Vector3& p = backbone.X_BT.p;
  PackedRow tip;
  const double error = backbone.kernel->accumulate(stateOf(chain, DeadLoads(), Vector3::Zero(), backbone), accuracy,
                                                   {p.x(), p.y(), p.z()}, tip);
  unpack(tip, tip_compliance);
  return error;
}

double solveUnloaded(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance) {
  MarchResult result;
  PackedRow tip;
  const double error = backbone.kernel->place_chain(stateOf(chain, DeadLoads(), Vector3::Zero(), backbone), accuracy,
                                                    result, tip);
  backbone.setTip(result.R_tip, result.p_tip);
  unpack(tip, tip_compliance);
  return error;
}

}  // namespace live_stiffness
