#pragma once
// The linearised rod: how the tip moves with the base moment and with what a segment is made of, along a known shape.

#include <vector>

#include "calibration/parametric_scene.h"
#include "live_stiffness/lie/so3.h"
#include "section/load_stepping.h"

namespace live_stiffness {

constexpr int kSeeds = 12;                  // columns of one pass: derivatives by so many numbers
constexpr int kSeededParameters = kSeeds - 3;  // the first three are the base moment's

using SeedColumns = Eigen::Matrix<double, 3, kSeeds>;
using SeedRow = Eigen::Matrix<double, 1, kSeeds>;

struct TipSensitivities {
  SeedColumns position;  // of T, base axes
  SeedColumns turn;      // small rotation of the tip, base axes
  SeedColumns residual;  // of the moment left over at T
};

// T: a number with kSeeds derivatives, Jet::a and Jet::v, the last kSeededParameters of them by parameters. rest: one
// per segment. base_moment: of the equilibrium, N m. tip: dead wrench at T, base axes. Columns 0 to 2 are by the base
// moment.
//
// Along the shape, shot from the base moment with five Runge-Kutta steps a segment (derivatives to some 1e-4), with
// delta R = hat(turn) R and everything per fraction x of the stretched length l:
//   turn' = R delta(l u),  delta p' = turn x p' + R delta(l v),  delta m' = n x delta p' + delta n x p',
//   delta v = delta c_se R^T n + c_se R^T (delta n - turn x n), and u alike with u_rest, c_bt and m.
template <class T>
TipSensitivities tipSensitivities(const ParametricScene<T>& scene, const std::vector<RestStateOf<T>>& rest,
                      const Vector3& base_moment, const Wrench& tip);

namespace rod_sensitivities {

// A segment's numbers and their columns.
struct SegmentColumns {
  double length = 0.0, mass = 0.0;
  Vector3 curvature, c_se;
  Matrix3 c_bt;
  SeedRow d_length, d_mass;
  SeedColumns d_curvature, d_c_se;  // c_se: of its diagonal
  SeedRow d_xx, d_xy, d_yy, d_zz;   // of c_bt
};

struct Section {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero(), m = Vector3::Zero();
  SeedColumns turn = SeedColumns::Zero(), dp = SeedColumns::Zero(), dm = SeedColumns::Zero();
};

// Weight and tip force beyond a section.
struct Beyond {
  Vector3 n;
  SeedColumns dn;
};

Section rate(const Section& at, const SegmentColumns& segment, const Beyond& beyond);
void integrateSegment(const SegmentColumns& segment, const Vector3& gravity, const Vector3& tip_force, double& mass_beyond,
                  SeedRow& d_mass_beyond, Section& at);
void passLink(double length, const Vector3& gravity, const Vector3& tip_force, double mass, const SeedRow& d_mass,
              double& mass_beyond, SeedRow& d_mass_beyond, Section& at);
TipSensitivities finish(const Section& at, const Vector3& tip_offset, const Beyond& beyond);

template <class T>
SegmentColumns sensitivitiesOf(const ParametricBody<T>& body, const RestStateOf<T>& rest) {
  SegmentColumns s;
  const T length = rest.stretch * body.length;
  const T mass = body.section.linearDensity() * body.length;
  s.length = length.a;
  s.d_length = length.v.transpose();
  s.mass = mass.a;
  s.d_mass = mass.v.transpose();
  s.c_bt.setZero();
  for (int i = 0; i < 3; ++i) {
    s.curvature[i] = rest.curvature[i].a;
    s.d_curvature.row(i) = rest.curvature[i].v.transpose();
    s.c_se[i] = rest.c.shear_elongation(i, i).a;
    s.d_c_se.row(i) = rest.c.shear_elongation(i, i).v.transpose();
    for (int j = 0; j < 3; ++j) s.c_bt(i, j) = rest.c.bending_torsion(i, j).a;
  }
  s.d_xx = rest.c.bending_torsion(0, 0).v.transpose();
  s.d_xy = rest.c.bending_torsion(0, 1).v.transpose();
  s.d_yy = rest.c.bending_torsion(1, 1).v.transpose();
  s.d_zz = rest.c.bending_torsion(2, 2).v.transpose();
  return s;
}

}  // namespace rod_sensitivities

template <class T>
TipSensitivities tipSensitivities(const ParametricScene<T>& scene, const std::vector<RestStateOf<T>>& rest,
                      const Vector3& base_moment, const Wrench& tip) {
  const Vector3 tip_force = tip.head<3>();
  double mass_beyond = scene.tip_mass.a;
  SeedRow d_mass_beyond = scene.tip_mass.v.transpose();
  for (const ParametricBody<T>& body : scene.chain) {
    const T mass = body.is_segment ? T(body.section.linearDensity() * body.length) : body.mass;
    mass_beyond += mass.a;
    d_mass_beyond += mass.v.transpose();
  }
  rod_sensitivities::Section at;
  at.m = base_moment;
  at.dm.leftCols<3>().setIdentity();
  size_t next = 0;
  for (const ParametricBody<T>& body : scene.chain) {
    if (body.is_segment)
      rod_sensitivities::integrateSegment(rod_sensitivities::sensitivitiesOf(body, rest[next++]), scene.gravity,
                                          tip_force, mass_beyond, d_mass_beyond, at);
    else
      rod_sensitivities::passLink(body.length.a, scene.gravity, tip_force, body.mass.a, body.mass.v.transpose(), mass_beyond,
                            d_mass_beyond, at);
  }
  return rod_sensitivities::finish(at, scene.tip_offset,
                             {tip_force + mass_beyond * scene.gravity, scene.gravity * d_mass_beyond});
}

}  // namespace live_stiffness
