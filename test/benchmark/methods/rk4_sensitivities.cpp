#include "benchmark/methods/rk4_sensitivities.h"

namespace live_stiffness {
namespace {

// d/ds of the columns at a state whose rate is known:
//   phi' = B (dm + m^ phi),  dp' = -p'^ phi + S (dn + n^ phi),  dm' = n^ dp' - p'^ dn,
// with B = R c_bt R^T, S = R c_se R^T and dn = [0, I].
void columnsRate(const SoftPiece& piece, const RodState& at, const RodState& rate, const RodColumns& columns,
                 RodColumns& result) {
  const Matrix3& R = at.X.R;
  const Matrix3 n_hat = hat(at.n), tangent_hat = hat(rate.X.p);
  result.phi = R * (piece.rest.c.bending_torsion * (R.transpose() * (columns.m + hat(at.m) * columns.phi)));
  Matrix3X6 dn = n_hat * columns.phi;
  dn.rightCols<3>() += Matrix3::Identity();
  result.p = R * (piece.rest.c.shear_elongation * (R.transpose() * dn)) - tangent_hat * columns.phi;
  result.m = n_hat * result.p;
  result.m.rightCols<3>() -= tangent_hat;
}

void addScaled(const RodColumns& columns, double factor, const RodColumns& rate, RodColumns& sum) {
  sum.phi = columns.phi + factor * rate.phi;
  sum.p = columns.p + factor * rate.p;
  sum.m = columns.m + factor * rate.m;
}

}  // namespace

Rk4Sensitivities::Rk4Sensitivities(const Scene& scene, int steps)
    : BaseMomentShooting("RK4 N=" + std::to_string(steps) + ", sensitivities", scene), steps_(steps) {}

bool Rk4Sensitivities::integrate(int, const SoftPiece& piece, RodState& state) {
  Rk4Stages stages;
  for (int i = 0; i < steps_; ++i) rk4Step(piece, piece.length / steps_, state, stages);
  return true;
}

bool Rk4Sensitivities::integrate(int, const SoftPiece& piece, RodState& state, RodColumns& columns, MaterialSum& sum) {
  const double h = piece.length / steps_;
  Rk4Stages stages;
  RodColumns at, rate[4];
  sum.add(state.X, piece.rest.c, piece.length * simpsonWeight(0, steps_));
  for (int i = 0; i < steps_; ++i) {
    rk4Step(piece, h, state, stages);
    columnsRate(piece, stages.at[0], stages.rate[0], columns, rate[0]);
    for (int k = 1; k < 4; ++k) {
      addScaled(columns, (k == 3 ? 1.0 : 0.5) * h, rate[k - 1], at);
      columnsRate(piece, stages.at[k], stages.rate[k], at, rate[k]);
    }
    columns.phi += h / 6.0 * (rate[0].phi + 2.0 * (rate[1].phi + rate[2].phi) + rate[3].phi);
    columns.p += h / 6.0 * (rate[0].p + 2.0 * (rate[1].p + rate[2].p) + rate[3].p);
    columns.m += h / 6.0 * (rate[0].m + 2.0 * (rate[1].m + rate[2].m) + rate[3].m);
    sum.add(state.X, piece.rest.c, piece.length * simpsonWeight(i + 1, steps_));
  }
  return true;
}

}  // namespace live_stiffness
