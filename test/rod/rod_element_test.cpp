#include "rod/rod_element.h"

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

const Vector3 kForce(0.2, -0.1, 0.25), kMoment(0.004, 0.008, -0.006), kLineLoad(-3.0, 1.5, 2.0);

RodElement loadedElement(const RestState& rest = softRest()) {
  RandomSource random(31);
  RodElement element;
  element.state.length = 0.02;
  element.setSection(rest);
  element.setStart({expSo3(random.vector(1.0)), random.vector(0.1)}, kForce, kMoment);
  element.setLoads(kLineLoad);
  return element;
}

// Every number of stages on both instruction sets (which may be the same here).
class EveryPasses : public ::testing::TestWithParam<std::tuple<int, Simd>> {
 protected:
  int stages() const { return std::get<0>(GetParam()); }
  const ElementKernel& kernel() const { return elementKernel(stages(), std::get<1>(GetParam())); }

  RodElement solved(RodElement element) const {
    EXPECT_TRUE(integrate(kernel(), true, element));
    return element;
  }

  // End of the same rod in `pieces` elements, one after the other.
  Pose endInPieces(RodElement element, int pieces) const {
    element.state.length /= pieces;
    for (int i = 0; i < pieces; ++i) {
      element = solved(element);
      element.setStart(element.X_end(), element.n_end(), element.m_end());
    }
    return element.X_start();
  }

  // How far one element is from the truth, by its order: (length / wave length)^(2 stages), with a factor to spare.
  double accuracy() const { return std::max(1e-14, 10.0 * std::pow(0.15, 2 * stages())); }
};

std::string nameOf(const ::testing::TestParamInfo<std::tuple<int, Simd>>& info) {
  return std::to_string(std::get<0>(info.param)) + (std::get<1>(info.param) == Simd::kBest ? "Best" : "Baseline");
}

INSTANTIATE_TEST_SUITE_P(Element, EveryPasses,
                         ::testing::Combine(::testing::ValuesIn(kStageCounts),
                                            ::testing::Values(Simd::kBest, Simd::kBaseline)),
                         nameOf);

TEST_P(EveryPasses, PlacesAnUnloadedElementByTheExponentialOfTheRestStrain) {
  RodElement element = loadedElement();
  for (double length : {0.0, 1e-12, 0.02, 0.065}) {  // up to 1.5 rad
    element.state.length = length;
    kernel().place_unloaded(element.state);
    const Pose expected = element.X_start() * expSe3(Vector3::UnitZ(), softRest().curvature, length);
    EXPECT_TRUE(matrixNear(element.X_end().p, expected.p, 3e-17));
    EXPECT_TRUE(matrixNear(element.X_end().R, expected.R, 1e-15));
  }
}

TEST_P(EveryPasses, WithoutLoadIntegratesToTheUnloadedShape) {
  RodElement element = loadedElement();
  element.setStart(element.X_start(), Vector3::Zero(), Vector3::Zero());
  element.setLoads(Vector3::Zero());
  RodElement exact = element;
  kernel().place_unloaded(exact.state);
  element = solved(element);
  EXPECT_TRUE(matrixNear(element.X_end().p, exact.X_end().p, 0.02 * accuracy()));
  EXPECT_TRUE(matrixNear(element.X_end().R, exact.X_end().R, accuracy()));
}

TEST_P(EveryPasses, HasTwiceTheOrderOfItsStages) {
  RodElement element = loadedElement();
  element.state.length = 0.16;  // long, so that the finer one is still above rounding
  const Pose exact = endInPieces(element, 96);
  const int coarse = stages() <= 3 ? 12 : 4, fine = stages() <= 3 ? 24 : stages() <= 5 ? 8 : 6;
  const double coarse_error = (endInPieces(element, coarse).p - exact.p).norm();
  const double fine_error = (endInPieces(element, fine).p - exact.p).norm();
  EXPECT_GT(fine_error, 1e-16);
  const double order = std::log(coarse_error / fine_error) / std::log(static_cast<double>(fine) / coarse);
  EXPECT_GT(order, 2 * stages() - 1.5);
}

TEST_P(EveryPasses, BalancesForceAndMoment) {
  const GaussLegendre& table = gaussLegendre(stages());
  for (const Vector3& follower : {Vector3(0.0, 0.0, 0.0), Vector3(3.0, -5.0, 1.0)}) {
    RodElement e = loadedElement();
    e.setLoads(kLineLoad, follower);
    e = solved(e);
    Vector3 force = e.n_end(), moment = e.m_end() + Vector3(e.state.offset_end).cross(e.n_end());
    for (int i = 0; i < stages(); ++i) {
      const Vector3 load = e.state.length * table.b[i] * (kLineLoad + e.X(i).R * follower);
      force += load;
      moment += (e.X(i).p - e.p_start()).cross(load);
    }
    EXPECT_TRUE(matrixNear(kForce, force, 1e-15));
    EXPECT_TRUE(matrixNear(kMoment, moment, 1e-15));  // exact at any number of stages: what Gauss methods conserve
  }
}

TEST_P(EveryPasses, BackwardsReturnsToTheStart) {
  RodElement there = loadedElement();
  there.setLoads(kLineLoad, Vector3(3.0, -5.0, 1.0));
  there = solved(there);
  RodElement back = there;
  back.setStart(there.X_end(), there.n_end(), there.m_end());
  back.state.length = -there.state.length;
  back = solved(back);
  // A Gauss method is its own adjoint, but a Cayley vector from the end is not one from the start.
  EXPECT_TRUE(matrixNear(back.X_end().p, there.p_start(), 0.05 * accuracy()));
  EXPECT_TRUE(matrixNear(back.X_end().R, there.X_start().R, accuracy()));
  EXPECT_TRUE(matrixNear(back.m_end(), kMoment, 0.05 * accuracy()));
}

TEST_P(EveryPasses, OfATooLongElementFailsInsteadOfReturningNonsense) {
  RodElement element = loadedElement();
  element.state.length = 2.0;
  EXPECT_FALSE(integrate(kernel(), true, element));
  element = loadedElement();
  element.setStart(element.X_start(), kForce, Vector3::Constant(std::nan("")));
  EXPECT_FALSE(integrate(kernel(), true, element));
}

ElementSensitivities unitColumns() {
  ElementSensitivities columns{};
  sensitivityMatrix(columns.m).leftCols<3>().setIdentity();
  return columns;
}

ElementSensitivities propagated(const ElementKernel& kernel, RodElement element, const ElementSensitivities& start) {
  ElementSensitivities end;
  EXPECT_LT(propagate(kernel, true, element, start, 1e-15, end), 1e-13);
  return end;
}

// Columns: base moment, and a force that is the same all along the rod.
TEST_P(EveryPasses, ColumnsEqualDifferences) {
  const RodElement element = loadedElement();
  const RodElement e = solved(element);
  const ElementSensitivities columns = propagated(kernel(), e, unitColumns());
  for (int i = 0; i < 6; ++i) {
    const auto moved = [&](double t) {
      RodElement other = element;
      const Vector3 step = t * Vector3::Unit(i % 3);
      other.setStart(element.X_start(), kForce + (i < 3 ? Vector3::Zero() : step), kMoment + (i < 3 ? step : Vector3::Zero()));
      return solved(other);
    };
    const double step = i < 3 ? 2e-4 : 2e-2;  // each turns the end by about 0.005 rad
    const auto p = [&](double t) { return Vector3(moved(t).X_end().p); };
    const auto m = [&](double t) { return Vector3(moved(t).m_end()); };
    const auto phi = [&](double t) { return Vector3(logSo3(moved(t).X_end().R * e.X_end().R.transpose())); };
    // 0.005^4 times fifth derivatives of truncation, 1e-15 / 0.005 of rounding: 1e-8 of the column is safe. Columns
    // collocate the linearised rod, differences linearise the collocated one: they differ by the element's own error.
    const double tolerance = 1e-8 + accuracy();
    const Vector3 dp = derivativeAtZero(p, step), dm = derivativeAtZero(m, step), dphi = derivativeAtZero(phi, step);
    EXPECT_TRUE(matrixNear(sensitivityMatrix(columns.p).col(i), dp, tolerance * dp.norm())) << i;
    EXPECT_TRUE(matrixNear(sensitivityMatrix(columns.m).col(i), dm, tolerance * dm.norm())) << i;
    EXPECT_TRUE(matrixNear(sensitivityMatrix(columns.phi).col(i), dphi, tolerance * dphi.norm())) << i;
  }
}

// A column that turns the whole rod about its start with its start, checked against differences, which covers phi and
// p given at the start.
TEST_P(EveryPasses, ColumnsCarryARotationAndAShiftOfTheStart) {
  const RodElement element = loadedElement();
  const RodElement e = solved(element);
  ElementSensitivities start{};
  sensitivityMatrix(start.phi).leftCols<3>().setIdentity();
  sensitivityMatrix(start.p).col(0) = Vector3(1.0, 2.0, 3.0);
  const ElementSensitivities columns = propagated(kernel(), e, start);
  for (int i = 0; i < 3; ++i) {
    const auto p = [&](double t) {
      RodElement other = element;
      other.setStart({expSo3(t * Vector3::Unit(i)) * element.X_start().R, element.p_start()}, kForce, kMoment);
      return Vector3(solved(other).X_end().p);
    };
    const Vector3 dp = derivativeAtZero(p, 0.01), shift = sensitivityMatrix(start.p).col(i);
    EXPECT_TRUE(matrixNear(sensitivityMatrix(columns.p).col(i), dp + shift, (1e-8 + accuracy()) * dp.norm() + 1e-15)) << i;
  }
}

// Of the base moment alone they are the same, and so are those of the force that are asked for afterwards.
TEST_P(EveryPasses, ColumnsOfTheBaseMomentNeedNoOthers) {
  RodElement e = solved(loadedElement());
  const ElementSensitivities start = unitColumns(), all = propagated(kernel(), e, start);
  ElementSensitivities some, others;
  EXPECT_LT(kernel().propagate(e.state, true, start, SensitivitySet::kBaseMoment, 1e-15, true, some), 1e-13);
  EXPECT_LT(kernel().propagate(e.state, false, start, SensitivitySet::kAll, 1e-15, false, others), 1e-13);
  const auto same = [](const double(&a)[6][3], const double(&b)[6][3], int count) {
    const double size = sensitivityMatrix(b).leftCols(count).norm();
    return matrixNear(sensitivityMatrix(a).leftCols(count), sensitivityMatrix(b).leftCols(count), 1e-12 * size);
  };
  EXPECT_TRUE(same(some.p, all.p, 3) && same(some.phi, all.phi, 3) && same(some.m, all.m, 3));
  EXPECT_TRUE(same(others.p, all.p, 6) && same(others.phi, all.phi, 6) && same(others.m, all.m, 6));
  EXPECT_EQ(sensitivityMatrix(some.phi).rightCols<3>().norm(), 0.0);
}

// Columns are linear in where they start, so that a start that moves on as before leaves the first pass nothing to do.
TEST_P(EveryPasses, PredictsColumnsWhoseStartMovesSteadily) {
  RodElement e = solved(loadedElement());
  ElementSensitivities start = unitColumns(), end;
  const Matrix3X6 step = 3.0 * Matrix3X6::Ones();
  const double same[3] = {};
  ASSERT_LT(propagate(kernel(), true, e, start, 1e-15, end), 1e-13);
  kernel().predict(e.state, same, 0.0, true);
  sensitivityMatrix(start.phi) += step;
  ASSERT_LT(propagate(kernel(), false, e, start, 1e-15, end), 1e-13);
  kernel().predict(e.state, same, 1.0, true);
  sensitivityMatrix(start.phi) += step;
  const double left = propagate(kernel(), false, e, start, 1.0, end);  // one pass
  EXPECT_LT(left, 1e-12);
}

TEST_P(EveryPasses, FollowMovesTheGuessToFirstOrder) {
  RodElement e = solved(loadedElement());
  ElementSensitivities unused;
  propagate(kernel(), true, e, unitColumns(), 1e-15, unused);
  const Vector3 step(1e-5, -2e-5, 1.5e-5);
  RodElement moved = e;
  moved.setStart(e.X_start(), kForce, kMoment + step);
  kernel().iterate(moved.state);
  const double without = moved.state.change;
  moved = e;
  moved.setStart(e.X_start(), kForce, kMoment + step);
  kernel().follow(moved.state, {step.x(), step.y(), step.z()});
  kernel().iterate(moved.state);
  EXPECT_LT(moved.state.change, without * (1e-3 + 10.0 * accuracy()));
}

TEST(ElementKernel, BothInstructionSetsAgreeToRounding) {
  for (int stages : kStageCounts) {
    std::vector<Pose> ends;
    std::vector<ElementSensitivities> columns;
    for (Simd simd : {Simd::kBest, Simd::kBaseline}) {
      RodElement e = loadedElement();
      ASSERT_TRUE(integrate(elementKernel(stages, simd), true, e));
      ends.push_back(e.X_end());
      columns.push_back(propagated(elementKernel(stages, simd), e, unitColumns()));
    }
    EXPECT_TRUE(matrixNear(ends[0].p, ends[1].p, 1e-16)) << stages;
    EXPECT_TRUE(matrixNear(ends[0].R, ends[1].R, 2e-15)) << stages;
    const auto best = sensitivityMatrix(columns[0].p), baseline = sensitivityMatrix(columns[1].p);
    EXPECT_TRUE(matrixNear(best, baseline, 1e-13 * baseline.norm()));
  }
}

}  // namespace
}  // namespace live_stiffness
