#include "support/moment_balance.h"

#include "rod/statics.h"

namespace live_stiffness {

Vector3 momentOfLoads(const StiffnessModel& model, const StiffnessWorkspace& workspace, const Pose& X_BT,
                      const Wrench& tip, int panels) {
  constexpr double kNodes[] = {0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155, 0.953089922969332};
  constexpr double kWeights[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                 0.11846344252809454};
  const Scene& scene = model.scene();
  const Vector3 gravity = scene.gravity.value_or(Vector3::Zero());
  Vector3 moment = angular(tip) + X_BT.p.cross(linear(tip) + scene.tip_mass * gravity);
  Pose X;
  walk(
      scene,
      [&](int index, const Segment& segment) {
        for (int panel = 0; panel < panels; ++panel)
          for (int i = 0; i < 5; ++i) {
            const Station station = model.station(workspace, index, (panel + kNodes[i]) / panels);
            moment += station.X_BQ.p.cross(kWeights[i] / panels * segment.mass() * gravity);
          }
        X = model.station(workspace, index, 1.0).X_BQ;
      },
      [&](const Link& link) {
        moment += (X * Vector3(0.0, 0.0, 0.5 * link.length)).cross(link.mass * gravity);
        X.p = X * Vector3(0.0, 0.0, link.length);
      });
  return moment;
}

Vector3 baseMoment(const StiffnessModel& model, const StiffnessWorkspace& workspace, const Wrench& tip) {
  const Chain& chain = workspace.statics().chain();
  const DeadLoads loads{model.scene().gravity.value_or(Vector3::Zero()), tip};
  Vector3 moment(workspace.backbone().elements[0].state.m_start), n = loads.baseForce(chain);
  for (const Chain::Part& part : chain.parts) {
    if (part.segment >= 0) break;
    moment += part.length * Vector3::UnitZ().cross(n - 0.5 * part.mass * loads.gravity);
    n -= part.mass * loads.gravity;
  }
  return moment;
}

}  // namespace live_stiffness
