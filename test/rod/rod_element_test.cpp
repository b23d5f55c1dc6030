#include "live_stiffness/rod/rod_element.h"

#include <gtest/gtest.h>

#include "support/differences.h"
#include "support/matrix_near.h"
#include "support/random_source.h"

namespace live_stiffness {
namespace {

// A soft piece of rod, curved at rest, of the size of the paper's segment.
RestState softRest() {
  RestState rest;
  rest.stretch = 1.2;
  rest.curvature = Vector3(10.0, -20.0, 4.0);
  rest.c.shear_elongation.diagonal() << 0.1, 0.11, 0.04;
  rest.c.bending_torsion.diagonal() << 900.0, 1000.0, 1200.0;
  rest.c.bending_torsion(0, 1) = rest.c.bending_torsion(1, 0) = 80.0;
  return rest;
}

RodElement loadedElement() {
  RandomSource random(31);
  RodElement element;
  element.length = 0.02;
  element.X_start = {expSo3(random.vector(1.0)), random.vector(0.1)};
  element.n_start = random.vector(0.3);
  element.m_start = random.vector(0.01);
  element.line_load = random.vector(4.0);
  return element;
}

RodElement solved(const RestState& rest, RodElement element) {
  resetGuess(rest, element);
  EXPECT_TRUE(integrate(rest, element));
  return element;
}

// The same rod in `pieces` elements, one after the other.
RodElement solvedInPieces(const RestState& rest, RodElement element, int pieces) {
  element.length /= pieces;
  for (int i = 0; i < pieces; ++i) {
    element = solved(rest, element);
    element.X_start = element.X_end;
    element.n_start = element.n_end;
    element.m_start = element.m_end;
  }
  return element;
}

TEST(PlaceUnloaded, IsTheExponentialOfTheRestStrain) {
  const RestState rest = softRest();
  RodElement element = loadedElement();
  placeUnloaded(rest, element);
  const Pose expected = element.X_start * expSe3(Vector3::UnitZ(), rest.curvature, element.length);
  EXPECT_TRUE(matrixNear(element.X_end.p, expected.p, 1e-17));
  EXPECT_TRUE(matrixNear(element.X_end.R, expected.R, 1e-15));
}

TEST(Integrate, WithoutLoadIsTheExponentialOfTheRestStrain) {
  const RestState rest = softRest();
  RodElement element = loadedElement();
  element.n_start = element.m_start = element.line_load = Vector3::Zero();
  RodElement exact = element;
  placeUnloaded(rest, exact);
  element = solved(rest, element);
  // Half a radian in one element of order 12: (0.5 / 2)^13 over the constant of Gauss quadrature is below rounding.
  EXPECT_TRUE(matrixNear(element.X_end.p, exact.X_end.p, 1e-15));
  EXPECT_TRUE(matrixNear(element.X_end.R, exact.X_end.R, 1e-13));
}

TEST(Integrate, HasOrderTwelve) {
  const RestState rest = softRest();
  RodElement element = loadedElement();
  element.length = 0.16;  // long, so that eight pieces are still above rounding
  const Pose exact = solvedInPieces(rest, element, 64).X_end;
  const double coarse = (solvedInPieces(rest, element, 2).X_end.p - exact.p).norm();
  const double fine = (solvedInPieces(rest, element, 8).X_end.p - exact.p).norm();
  EXPECT_GT(fine, 1e-16);
  EXPECT_GT(std::log2(coarse / fine) / 2.0, 11.0);  // 12 in the limit; two pieces of 2 rad are not there yet
}

TEST(Integrate, BalancesForceAndMoment) {
  const RestState rest = softRest();
  const RodElement e = solved(rest, loadedElement());
  const Vector3 weight = e.length * e.line_load;
  EXPECT_TRUE(matrixNear(e.n_start, e.n_end + weight, 1e-16));
  Vector3 moment = e.m_end + (e.X_end.p - e.X_start.p).cross(e.n_end);
  for (int i = 0; i < kStages; ++i) moment += e.weight(i) * (e.X[i].p - e.X_start.p).cross(e.line_load);
  EXPECT_TRUE(matrixNear(e.m_start, moment, 1e-15));  // N m, of 0.01
}

TEST(Integrate, WithFollowerLoadBalancesForceAndMoment) {
  const RestState rest = softRest();
  RodElement element = loadedElement();
  element.follower_load = Vector3(3.0, -5.0, 1.0);
  const RodElement e = solved(rest, element);
  Vector3 force = e.n_end, moment = e.m_end + (e.X_end.p - e.X_start.p).cross(e.n_end);
  for (int i = 0; i < kStages; ++i) {
    const Vector3 load = e.weight(i) * (e.line_load + e.X[i].R * e.follower_load);
    force += load;
    moment += (e.X[i].p - e.X_start.p).cross(load);
  }
  EXPECT_TRUE(matrixNear(e.n_start, force, 1e-15));
  EXPECT_TRUE(matrixNear(e.m_start, moment, 1e-15));
}

TEST(Integrate, BackwardsReturnsToTheStart) {
  const RestState rest = softRest();
  RodElement there = loadedElement();
  there.follower_load = Vector3(3.0, -5.0, 1.0);
  there = solved(rest, there);
  RodElement back = there;
  back.X_start = there.X_end;
  back.n_start = there.n_end;
  back.m_start = there.m_end;
  back.length = -there.length;
  back = solved(rest, back);
  EXPECT_TRUE(matrixNear(back.X_end.p, there.X_start.p, 1e-14));  // Gauss collocation is symmetric: rounding only
  EXPECT_TRUE(matrixNear(back.X_end.R, there.X_start.R, 1e-13));
  EXPECT_TRUE(matrixNear(back.m_end, there.m_start, 1e-14));
}

TEST(Integrate, OfATooLongElementFailsInsteadOfReturningNonsense) {
  RestState rest = softRest();
  RodElement element = loadedElement();
  element.length = 2.0;
  resetGuess(rest, element);
  EXPECT_FALSE(integrate(rest, element));
  element.length = 0.02;
  element.m_start = Vector3::Constant(std::nan(""));
  resetGuess(rest, element);
  EXPECT_FALSE(integrate(rest, element));
}

// Columns: base moment, and a force that is the same all along the rod.
TEST(Propagate, EqualsDifferencesOfIntegrate) {
  const RestState rest = softRest();
  const RodElement element = loadedElement();
  const RodElement e = solved(rest, element);
  StateColumns columns;
  columns.m.leftCols<3>().setIdentity();
  columns.n.rightCols<3>().setIdentity();
  propagate(rest, e, columns);
  for (int i = 0; i < 6; ++i) {
    const auto moved = [&](double t) {
      RodElement other = element;
      (i < 3 ? other.m_start : other.n_start)[i % 3] += t;
      return solved(rest, other);
    };
    const double step = i < 3 ? 2e-4 : 2e-2;  // each turns the end by about 0.005 rad
    const auto p = [&](double t) { return Vector3(moved(t).X_end.p); };
    const auto m = [&](double t) { return Vector3(moved(t).m_end); };
    const auto phi = [&](double t) { return Vector3(logSo3(moved(t).X_end.R * e.X_end.R.transpose())); };
    // 0.005^4 times fifth derivatives of truncation, 1e-15 / 0.005 of rounding: 1e-8 of the column is safe.
    const Vector3 dp = derivativeAtZero(p, step), dm = derivativeAtZero(m, step), dphi = derivativeAtZero(phi, step);
    EXPECT_TRUE(matrixNear(columns.p.col(i), dp, 1e-8 * dp.norm())) << i;
    EXPECT_TRUE(matrixNear(columns.m.col(i), dm, 1e-8 * dm.norm())) << i;
    EXPECT_TRUE(matrixNear(columns.phi.col(i), dphi, 1e-8 * dphi.norm())) << i;
  }
}

TEST(Propagate, IsLinearInTheColumnsItIsGiven) {
  RandomSource random(32);
  const RestState rest = softRest();
  const RodElement e = solved(rest, loadedElement());
  StateColumns columns;
  for (auto* part : {&columns.phi, &columns.p, &columns.m, &columns.n})
    for (int i = 0; i < 18; ++i) (*part)(i) = random.uniform(-1.0, 1.0);
  columns.m *= 0.01;
  StateColumns doubled = columns;
  for (auto* part : {&doubled.phi, &doubled.p, &doubled.m, &doubled.n}) *part *= 2.0;
  propagate(rest, e, columns);
  propagate(rest, e, doubled);
  EXPECT_TRUE(matrixNear(doubled.phi, 2.0 * columns.phi, 1e-13 * columns.phi.norm()));
  EXPECT_TRUE(matrixNear(doubled.p, 2.0 * columns.p, 1e-13 * columns.p.norm()));
  EXPECT_TRUE(matrixNear(doubled.m, 2.0 * columns.m, 1e-13 * columns.m.norm()));
}

// A column that turns the whole rod about its start with its start: a rigid motion when the loads turn too, so here
// it is checked against differences, which covers phi and p given at the start.
TEST(Propagate, CarriesARotationOfTheStart) {
  const RestState rest = softRest();
  const RodElement element = loadedElement();
  const RodElement e = solved(rest, element);
  StateColumns columns;
  columns.phi.leftCols<3>().setIdentity();
  columns.p.rightCols<3>().setIdentity();
  propagate(rest, e, columns);
  for (int i = 0; i < 3; ++i) {
    const auto p = [&](double t) {
      RodElement other = element;
      other.X_start.R = expSo3(t * Vector3::Unit(i)) * element.X_start.R;
      return Vector3(solved(rest, other).X_end.p);
    };
    const Vector3 dp = derivativeAtZero(p, 0.01);
    EXPECT_TRUE(matrixNear(columns.p.col(i), dp, 1e-8 * dp.norm())) << i;
  }
  EXPECT_TRUE(matrixNear(columns.p.rightCols<3>(), Matrix3::Identity(), 0.0));
  EXPECT_TRUE(matrixNear(columns.m.rightCols<3>(), Matrix3::Zero(), 0.0));
}

}  // namespace
}  // namespace live_stiffness
