#include "rod/kinematics.h"

#include "rod/shooting.h"

namespace live_stiffness {

void placeUnloaded(const Chain& chain, Backbone& backbone) {
  prepare(chain, DeadLoads(), backbone);
  sweep(chain, DeadLoads(), Vector3::Zero(), Pass::kUnloaded, backbone);
}

}  // namespace live_stiffness
