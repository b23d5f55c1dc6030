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
  element.setLoad(kLineLoad);
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
  element.setLoad(Vector3::Zero());
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
  const int coarse = 4, fine = stages() <= 5 ? 8 : 6;
  const double coarse_error = (endInPieces(element, coarse).p - exact.p).norm();
  const double fine_error = (endInPieces(element, fine).p - exact.p).norm();
  EXPECT_GT(fine_error, 1e-16);
  const double order = std::log(coarse_error / fine_error) / std::log(static_cast<double>(fine) / coarse);
  EXPECT_GT(order, 2 * stages() - 1.5);
}

TEST_P(EveryPasses, BalancesForceAndMoment) {
  const GaussLegendre& table = gaussLegendre(stages());
  const RodElement e = solved(loadedElement());
  Vector3 force = e.n_end(), moment = e.m_end() + Vector3(e.state.offset_end).cross(e.n_end());
  for (int i = 0; i < stages(); ++i) {
    const Vector3 load = e.state.length * table.b[i] * kLineLoad;
    force += load;
    moment += Vector3(e.state.offset[0][i], e.state.offset[1][i], e.state.offset[2][i]).cross(load);
  }
  EXPECT_TRUE(matrixNear(kForce, force, 1e-15));
  EXPECT_TRUE(matrixNear(kMoment, moment, 1e-15));  // exact at any number of stages: what Gauss methods conserve
}

TEST_P(EveryPasses, OfATooLongElementFailsInsteadOfReturningNonsense) {
  RodElement element = loadedElement();
  element.state.length = 2.0;
  EXPECT_FALSE(integrate(kernel(), true, element));
  element = loadedElement();
  element.setStart(element.X_start(), kForce, Vector3::Constant(std::nan("")));
  EXPECT_FALSE(integrate(kernel(), true, element));
}

// With sensitivities that have converged to rounding.
RodElement propagated(const ElementKernel& kernel, RodElement element) {
  EXPECT_LT(propagate(kernel, 1e-15, element), 1e-13);
  return element;
}

using Columns = Eigen::Matrix<double, 3, kColumns>;
Columns columnsOf(const double (&part)[kColumns][3]) { return Eigen::Map<const Columns>(part[0]); }

// The same element with its start turned, its moment and its force changed by t in what a column is of.
RodElement startedApart(RodElement element, int column, double t) {
  const Vector3 step = t * Vector3::Unit(column % 3);
  Pose X = element.X_start();
  Vector3 n = kForce, m = kMoment;
  if (column < kOfForce) m += step;
  else if (column < kOfRotation) n += step;
  else X.R = expSo3(step) * X.R;
  element.setStart(X, n, m);
  return element;
}

// By the moment and the orientation of the start, and by a force that is the same all along the element; of a rotation the
// moment stays as it is, in base axes.
TEST_P(EveryPasses, TransferEqualsDifferences) {
  const RodElement element = loadedElement(), e = propagated(kernel(), solved(element));
  const Columns phi = columnsOf(e.state.transfer.phi), p = columnsOf(e.state.transfer.p), m = columnsOf(e.state.transfer.m);
  for (int i = 0; i < kColumns; ++i) {
    const auto moved = [&](double t) { return solved(startedApart(element, i, t)); };
    const double step = i < kOfForce ? 2e-4 : i < kOfRotation ? 2e-2 : 5e-3;  // each turns the end by about 0.005 rad
    const Vector3 dp = derivativeAtZero([&](double t) { return Vector3(moved(t).state.offset_end); }, step);
    const Vector3 dm = derivativeAtZero([&](double t) { return moved(t).m_end(); }, step);
    const Vector3 dphi =
        derivativeAtZero([&](double t) { return logSo3(moved(t).X_end().R * e.X_end().R.transpose()); }, step);
    // 0.005^4 times fifth derivatives of truncation, 1e-15 / 0.005 of rounding: 1e-8 of the column is safe. Columns
    // collocate the linearised rod, differences linearise the collocated one: they differ by the element's own error.
    const double tolerance = 1e-8 + accuracy();
    EXPECT_TRUE(matrixNear(p.col(i), dp, tolerance * dp.norm())) << i;
    EXPECT_TRUE(matrixNear(m.col(i), dm, tolerance * dm.norm())) << i;
    EXPECT_TRUE(matrixNear(phi.col(i), dphi, tolerance * dphi.norm())) << i;
  }
}

// What multiple shooting iterates with: a rotation turns the moment, too, so that of an element without loads it turns all.
TEST_P(EveryPasses, ARotationOfTheKernelTurnsTheMomentWithTheSection) {
  RodElement e = solved(loadedElement());
  ASSERT_LT(kernel().propagate(e.state, true, true, true, 1e-15, false), 1e-13);
  const Columns raw = columnsOf(e.state.transfer.phi), fixed = columnsOf(propagated(kernel(), e).state.transfer.phi);
  EXPECT_TRUE(matrixNear(raw.leftCols<6>(), fixed.leftCols<6>(), 1e-12 * fixed.leftCols<6>().norm()));
  const Matrix3 with_moment = fixed.rightCols<3>() + fixed.leftCols<3>() * -hat(kMoment);
  EXPECT_TRUE(matrixNear(raw.rightCols<3>(), with_moment, 1e-12));

  RodElement free = loadedElement();
  free.setStart(free.X_start(), Vector3::Zero(), kMoment);
  free.setLoad(Vector3::Zero());
  free = solved(free);
  ASSERT_LT(kernel().propagate(free.state, true, true, true, 1e-15, false), 1e-13);
  const ElementTransfer& t = free.state.transfer;
  EXPECT_TRUE(matrixNear(sensitivityMatrix(t.phi, kOfRotation), Matrix3::Identity(), 1e-14));
  EXPECT_TRUE(matrixNear(sensitivityMatrix(t.m, kOfRotation), -hat(kMoment), 1e-16));
  EXPECT_TRUE(matrixNear(sensitivityMatrix(t.p, kOfRotation), -hat(Vector3(free.state.offset_end)), 1e-16));
}

// Those of the moment alone are the same, and so are the others when they are asked for afterwards.
TEST_P(EveryPasses, ColumnsOfTheMomentNeedNoOthers) {
  RodElement e = solved(loadedElement());
  RodElement all = e;
  ASSERT_LT(kernel().propagate(all.state, true, true, true, 1e-15, false), 1e-13);
  e.state.transfer = ElementTransfer{};
  const auto same = [&](int count) {
    const auto near = [&](const double (&a)[kColumns][3], const double (&b)[kColumns][3]) {
      const double size = columnsOf(b).leftCols(count).norm();
      return matrixNear(columnsOf(a).leftCols(count), columnsOf(b).leftCols(count), 1e-12 * size);
    };
    const ElementTransfer &t = e.state.transfer, &u = all.state.transfer;
    return near(t.p, u.p) && near(t.phi, u.phi) && near(t.m, u.m);
  };
  EXPECT_LT(kernel().propagate(e.state, true, false, false, 1e-15, false), 1e-13);
  EXPECT_TRUE(same(3));
  EXPECT_EQ(columnsOf(e.state.transfer.phi).rightCols<6>().norm(), 0.0);
  EXPECT_LT(kernel().propagate(e.state, true, true, true, 1e-15, false), 1e-13);
  EXPECT_TRUE(same(9));
}

// A warm element that goes on bending as before: what is left of extrapolated columns is of second order in the step.
TEST_P(EveryPasses, PredictsShapeAndColumnsOfACurvatureThatChangesSteadily) {
  const auto leftAfter = [&](double step, bool extrapolate) {
    RestState rest = softRest();
    RodElement e = loadedElement();
    const double turn = step * e.state.length;
    for (int i = 0; i < 3; ++i) {
      e.setSection(rest);
      if (i < 2) {
        e = solved(e);
        EXPECT_LT(kernel().propagate(e.state, i == 0, true, true, 1e-15, false), 1e-13);
        kernel().predict(e.state, {turn, -turn, 0.0}, i == 1 && extrapolate ? 1.0 : 0.0, kColumns);
        // The extrapolated start belongs to a robot: here it stays where it is.
        e.setStart(loadedElement().X_start(), kForce, kMoment);
      }
      rest.curvature += Vector3(step, -step, 0.0);
    }
    const Vector3 guess = e.g_end(kernel().stages);
    EXPECT_TRUE(integrate(kernel(), false, e));
    const double change = (e.g_end(kernel().stages) - guess).norm();
    return std::max(change, kernel().propagate(e.state, false, true, true, 1.0, true));  // one iteration
  };
  EXPECT_LT(leftAfter(0.5, true), 0.05 * leftAfter(0.5, false));
  EXPECT_NEAR(leftAfter(0.5, true) / leftAfter(0.25, true), 4.0, 1.0);
}

TEST_P(EveryPasses, FollowMovesTheGuessToFirstOrder) {
  // A force at the end is one all along. Here a rotation turns the moment, too.
  const double change[kColumns] = {1e-5, -2e-5, 1.5e-5, 2e-3, 1e-3, -1e-3, 1e-3, 2e-3, -1e-3};
  RodElement e = solved(loadedElement());
  ASSERT_LT(kernel().propagate(e.state, true, true, true, 1e-15, false), 1e-13);
  const Vector3 turn(change + kOfRotation);
  const auto changeAfter = [&](double share, bool follow) {
    double by[kColumns];
    for (int i = 0; i < kColumns; ++i) by[i] = share * change[i];
    const Matrix3 turned = expSo3(share * turn);
    RodElement moved = e;
    if (follow) kernel().follow(moved.state, by);
    moved.setStart({turned * e.X_start().R, e.p_start()}, kForce + share * Vector3(change + kOfForce),
                   turned * kMoment + share * Vector3(change + kOfMoment));
    RodElement found = moved;
    EXPECT_TRUE(integrate(kernel(), false, found));
    return (found.g_end(kernel().stages) - moved.g_end(kernel().stages)).norm();
  };
  EXPECT_LT(changeAfter(1.0, true), changeAfter(1.0, false) * (1e-2 + 10.0 * accuracy()));
  if (accuracy() > 1e-6) return;  // columns of few stages are not accurate enough to see the second order
  EXPECT_NEAR(changeAfter(1.0, true) / changeAfter(0.5, true), 4.0, 0.2);
}

TEST(ElementKernel, BothInstructionSetsAgreeToRounding) {
  for (int stages : kStageCounts) {
    std::vector<Pose> ends;
    std::vector<Columns> columns;
    for (Simd simd : {Simd::kBest, Simd::kBaseline}) {
      RodElement e = loadedElement();
      ASSERT_TRUE(integrate(elementKernel(stages, simd), true, e));
      ends.push_back(e.X_end());
      columns.push_back(columnsOf(propagated(elementKernel(stages, simd), e).state.transfer.p));
    }
    EXPECT_TRUE(matrixNear(ends[0].p, ends[1].p, 1e-16)) << stages;
    EXPECT_TRUE(matrixNear(ends[0].R, ends[1].R, 2e-15)) << stages;
    for (int k = 0; k < kColumns; ++k)
      EXPECT_TRUE(matrixNear(columns[0].col(k), columns[1].col(k), 1e-13 * columns[1].col(k).norm())) << k;
  }
}

}  // namespace
}  // namespace live_stiffness
