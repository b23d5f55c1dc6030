#include "live_stiffness/parallel/parallel_model.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "live_stiffness/analysis/ellipsoid.h"
#include "parallel/parallel_cases.h"
#include "parallel/parallel_statics.h"
#include "support/differences.h"
#include "support/errors.h"
#include "support/matrix_near.h"
#include "support/random_source.h"
#include "support/rod_march.h"

namespace live_stiffness {
namespace {

const Wrench kForce = (Wrench() << 0.8, -0.5, -1.5, 0.0, 0.0, 0.0).finished();
const Wrench kWrench = (Wrench() << 0.8, -0.5, -1.5, 0.05, -0.06, 0.1).finished();
constexpr double kLength = 0.4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Case {
  const char* name;
  ParallelScene scene;
  Wrench wrench;
};

std::vector<Case> cases() {
  return {{"Stewart-Gough", stewartGough(), Wrench::Zero()},
          {"Stewart-Gough under a wrench", stewartGough(), kWrench},
          {"awkward", awkwardRobot(), Wrench::Zero()},
          {"awkward under a wrench", awkwardRobot(), kWrench}};
}

TEST(ParallelFig18, HasThePapersRatios) {
  const ParallelModel model(stewartGough(), {});
  ParallelWorkspace workspace = model.makeWorkspace();
  const auto solve = [&](char configuration) {
    const ParallelSolution solution = model.solveForLengths(figure18Pose(configuration), Wrench::Zero(), workspace);
    EXPECT_TRUE(solution.status.ok()) << configuration << ": " << model.describe(solution.status);
    const Vector3 axes = ellipsoidOf(solution.material_compliance.topLeftCorner<3, 3>()).half_axes;
    std::cout << "Fig. 18 (" << configuration << "): x, y, z by (53) "
              << 1e6 * solution.material_compliance.diagonal().head<3>().transpose() << ", by the tangent "
              << 1e6 * solution.compliance.diagonal().head<3>().transpose() << " um/N; half axes "
              << 1e6 * axes.transpose() << '\n';
    return solution;
  };
  const ParallelSolution a = solve('a'), b = solve('b'), c = solve('c');
  // "isotropic and around 110 times higher than along the z-axis": the same in both matrices here.
  for (const Matrix6& C : {a.material_compliance, a.compliance}) {
    EXPECT_NEAR(C(0, 0) / C(1, 1), 1.0, 1e-9);
    EXPECT_NEAR(C(0, 0) / C(2, 2), 110.0, 5.0);
  }
  // "about 2 times higher than that along the y-axis"; "overall compliance increases".
  for (const Matrix6& C : {b.material_compliance, b.compliance}) EXPECT_NEAR(C(0, 0) / C(1, 1), 2.0, 0.2);
  const auto largest = [](const ParallelSolution& s) {
    return ellipsoidOf(s.material_compliance.topLeftCorner<3, 3>()).half_axes.z();
  };
  EXPECT_GT(largest(b), largest(a));
  EXPECT_GT(largest(c), largest(b));  // "further increases"
}

TEST(ParallelTangent, EqualsDifferencesOfTheResolvedPlatform) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const ParallelModel model(c.scene, {1e-12});
    ParallelWorkspace workspace = model.makeWorkspace();
    const ParallelSolution solution = model.solve(unevenLengths(), c.wrench, workspace);
    ASSERT_TRUE(solution.status.ok()) << model.describe(solution.status);
    const auto platform = [&](const Wrench& wrench) {
      const ParallelSolution there = model.solve(unevenLengths(), wrench, workspace);
      EXPECT_TRUE(there.status.ok());
      return there.X_BP;
    };
    // Steps as for a robot that is fifty times softer: the rods feel a push much more than the platform moves.
    const Matrix6 differences = complianceByDifferences(platform, c.wrench, 50.0 * solution.compliance, kLength);
    EXPECT_LT(complianceError(solution.compliance, differences, kLength), 1e-6)
        << solution.compliance << "\ndifferences\n" << differences;
  }
}

TEST(ParallelTangent, IsSymmetricUnlessADeadMomentActs) {
  for (const ParallelScene& scene : {stewartGough(), awkwardRobot()}) {
    const ParallelModel model(scene, {1e-12});
    const auto asymmetry = [&](const Wrench& wrench) {
      const ParallelSolution solution = solveCold(model, unevenLengths(), wrench);
      EXPECT_TRUE(solution.status.ok());
      const Matrix6 C = scaledCompliance(solution.compliance, kLength);
      return (C - C.transpose()).norm() / C.norm();
    };
    EXPECT_LT(asymmetry(Wrench::Zero()), 1e-9);
    EXPECT_LT(asymmetry(kForce), 1e-9);
    EXPECT_GT(asymmetry(kWrench), 1e-4);
  }
}

TEST(ParallelEquilibrium, IsConfirmedByRungeKutta) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const ParallelModel model(c.scene, {1e-11});
    ParallelWorkspace workspace = model.makeWorkspace();
    const ParallelSolution solution = model.solve(unevenLengths(), c.wrench, workspace);
    ASSERT_TRUE(solution.status.ok());
    const Vector3 gravity = c.scene.gravity.value_or(Vector3::Zero());
    const Vector3 p = solution.X_BP.p;
    Wrench load = c.wrench;
    linear(load) += c.scene.platformWeight();
    angular(load) += (solution.X_BP.R * c.scene.platform_centre).cross(c.scene.platformWeight());
    double size = linear(load).norm(), weight = c.scene.platform_mass;
    Vector3 reaction = Vector3::Zero();
    for (int i = 0; i < c.scene.rodCount(); ++i) {
      const ClampedRod& rod = workspace.statics().rods()[i];
      const ParallelRod& data = c.scene.rods[i];
      const RodEnd end = marchRod(data.section, data.X_BD, rod.length(), rod.baseWrench(), gravity, 400);
      EXPECT_LT(poseError(end.X, solution.X_BP * data.X_PE, kLength), 1e-9) << "rod " << i;  // RK4: (1/400)^4
      linear(load) -= linear(end.wrench);
      angular(load) -= angular(end.wrench) + (end.X.p - p).cross(linear(end.wrench));
      size += linear(end.wrench).norm();
      reaction += linear(rod.baseWrench());
      weight += data.section.linearDensity() * rod.length();
    }
    // The stiff direction of a rod makes 1e4 times more force of a misfit than bending does.
    EXPECT_LT(linear(load).norm(), 1e-6 * size);
    EXPECT_LT(angular(load).norm(), 1e-6 * size * kLength);
    EXPECT_TRUE(matrixNear(reaction, linear(c.wrench) + weight * gravity, 1e-8 * size));
  }
}

TEST(ParallelEquilibrium, OfOneRodIsThatOfASerialRobot) {
  ParallelScene one = stewartGough();
  one.rods.resize(1);
  one.rods[0].X_BD = one.rods[0].X_PE = Pose();
  one.gravity = Vector3(1.0, 2.0, -9.0);
  one.platform_mass = 0.02;
  const ParallelModel model(one, {1e-11});
  Scene serial;
  Segment segment;
  segment.length = kLength;
  segment.section = one.rods[0].section;
  serial.chain.push_back(segment);
  serial.gravity = one.gravity;
  serial.tip_mass = 0.02;
  ModelOptions options;
  options.accuracy = 1e-11;
  const StiffnessModel serial_model(serial, options);
  StiffnessWorkspace workspace = serial_model.makeWorkspace();
  const Wrench wrench = (Wrench() << 0.1, -0.1, -0.1, 0.02, -0.01, 0.02).finished();
  const StiffnessSolution expected = serial_model.solve(Pressures(), wrench, workspace);
  const ParallelSolution actual = solveCold(model, {kLength}, wrench);
  ASSERT_TRUE(expected.status.ok());
  ASSERT_TRUE(actual.status.ok()) << model.describe(actual.status);
  EXPECT_LT(poseError(actual.X_BP, expected.X_BT, kLength), 1e-9);
  EXPECT_LT(complianceError(actual.compliance, expected.compliance, kLength), 1e-8);
  EXPECT_LT(complianceError(actual.material_compliance, expected.material_compliance, kLength), 1e-8);
}

TEST(ParallelEquilibrium, DoesNotDependOnNumbering) {
  const ParallelScene scene = awkwardRobot();
  ParallelScene reversed = scene;
  std::vector<double> lengths = unevenLengths();
  const ParallelSolution expected = solveCold(ParallelModel(scene, {1e-11}), lengths, kWrench);
  std::reverse(reversed.rods.begin(), reversed.rods.end());
  std::reverse(lengths.begin(), lengths.end());
  const ParallelSolution actual = solveCold(ParallelModel(reversed, {1e-11}), lengths, kWrench);
  ASSERT_TRUE(expected.status.ok() && actual.status.ok());
  EXPECT_LT(poseError(actual.X_BP, expected.X_BP, kLength), 1e-9);
  EXPECT_LT(complianceError(actual.compliance, expected.compliance, kLength), 1e-8);
}

TEST(ParallelEquilibrium, TurnsWithTheWholeRobot) {
  const ParallelScene scene = awkwardRobot();
  const Matrix3 Q = expSo3(Vector3(0.7, -1.1, 0.4));
  ParallelScene turned = scene;
  turned.gravity = Q * *scene.gravity;
  turned.platform_centre = Q * scene.platform_centre;
  for (ParallelRod& rod : turned.rods)
    for (Pose* X : {&rod.X_BD, &rod.X_PE}) *X = {Q * X->R, Q * X->p};
  Matrix6 Q6 = Matrix6::Zero();
  Q6.topLeftCorner<3, 3>() = Q6.bottomRightCorner<3, 3>() = Q;
  const ParallelSolution expected = solveCold(ParallelModel(scene, {1e-11}), unevenLengths(), kWrench);
  const ParallelSolution actual = solveCold(ParallelModel(turned, {1e-11}), unevenLengths(), Q6 * kWrench);
  ASSERT_TRUE(expected.status.ok() && actual.status.ok());
  EXPECT_LT(poseError(actual.X_BP, {Q * expected.X_BP.R * Q.transpose(), Q * expected.X_BP.p}, kLength), 1e-9);
  for (const auto matrix : {&ParallelSolution::compliance, &ParallelSolution::material_compliance})
    EXPECT_LT(complianceError(actual.*matrix, Q6 * expected.*matrix * Q6.transpose(), kLength), 1e-8);
}

TEST(ParallelModel, LeadsFromPoseToLengthsAndBack) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const ParallelModel model(c.scene, {1e-11});
    ParallelWorkspace workspace = model.makeWorkspace();
    for (const Vector3& turn : {Vector3(0.0, 0.0, 0.0), Vector3(0.1, 0.2, -0.1)}) {
      const Pose wanted{expSo3(turn), Vector3(0.03, -0.02, 0.42)};
      const ParallelSolution inverse = model.solveForLengths(wanted, c.wrench, workspace);
      ASSERT_TRUE(inverse.status.ok()) << model.describe(inverse.status);
      const ParallelSolution forward = solveCold(model, workspace.lengths(), c.wrench);
      ASSERT_TRUE(forward.status.ok()) << model.describe(forward.status);
      EXPECT_LT(poseError(forward.X_BP, wanted, kLength), 1e-9);
      EXPECT_LT(complianceError(forward.compliance, inverse.compliance, kLength), 1e-8);
    }
  }
}

// Warm along a path and cold, against a far finer solve; the error is estimated from above but for a factor of ten.
TEST(ParallelModel, IsAsAccurateAsAskedForWarmAndCold) {
  for (const Case& c : cases())
    for (double accuracy : {1e-6, 1e-9}) {
      const ParallelModel model(c.scene, {accuracy}), fine(c.scene, {1e-13});
      ParallelWorkspace warm = model.makeWorkspace(), reference = fine.makeWorkspace();
      RandomSource random(7);
      std::vector<double> lengths = unevenLengths();
      for (int i = 0; i < 60; ++i) {
        for (double& length : lengths) length += random.uniform(-5e-4, 5e-4);
        const ParallelSolution actual = model.solve(lengths, c.wrench, warm);
        const ParallelSolution expected = fine.solve(lengths, c.wrench, reference);
        ASSERT_TRUE(actual.status.ok() && expected.status.ok()) << c.name << i;
        const double error =
            std::max({poseError(actual.X_BP, expected.X_BP, kLength),
                      complianceError(actual.compliance, expected.compliance, kLength),
                      complianceError(actual.material_compliance, expected.material_compliance, kLength)});
        EXPECT_LT(error, 2.0 * accuracy) << c.name << " update " << i;
        EXPECT_LT(error, 10.0 * actual.numerical_error + 1e-11) << c.name << " update " << i;
        if (i % 20 == 0) {
          const ParallelSolution cold = solveCold(model, lengths, c.wrench);
          EXPECT_LT(complianceError(cold.compliance, expected.compliance, kLength), 2.0 * accuracy) << c.name << i;
        }
      }
    }
}

// Four equal rods, upright: the platform sways at 4 pi^2 E I / L^2.
TEST(ParallelStability, EndsAtEulersLoad) {
  ParallelScene frame = stewartGough();
  frame.rods.resize(4);
  for (int i = 0; i < 4; ++i) {
    frame.rods[i].X_BD = frame.rods[i].X_PE = Pose();
    frame.rods[i].X_BD.p = frame.rods[i].X_PE.p = Vector3(i < 2 ? 0.1 : -0.1, i % 2 ? 0.1 : -0.1, 0.0);
  }
  const double EI = frame.rods[0].section.youngs_modulus * kPi / 4.0 * std::pow(0.001, 4);
  const double euler = 4.0 * kPi * kPi * EI / (kLength * kLength);
  const ParallelModel model(frame, {});
  const auto push = [&](double share) {
    const Wrench down = (Wrench() << 0.0, 0.0, -share * euler, 0.0, 0.0, 0.0).finished();
    return solveCold(model, std::vector<double>(4, kLength), down);
  };
  const ParallelSolution free = push(0.0), below = push(0.98), above = push(1.02);
  ASSERT_TRUE(free.status.ok());
  ASSERT_TRUE(below.status.ok()) << model.describe(below.status);
  // 1 / (1 - 0.98), but for the elongation of the rods, the tilt of the platform and the column's other shapes.
  EXPECT_NEAR(below.compliance(0, 0) / free.compliance(0, 0), 50.0, 5.0);
  EXPECT_EQ(above.status.code, SolveCode::kUnstable);
}

// A thin rod between thick ones, too long by e: it buckles between held ends at e = pi^2 r^2 / L^2, and no stiffness of
// the platform shows it.
TEST(ParallelStability, SeesARodBuckleBetweenHeldEnds) {
  ParallelScene robot = stewartGough();
  robot.rods.resize(4);
  for (int i = 0; i < 4; ++i) {
    robot.rods[i].X_BD = robot.rods[i].X_PE = Pose();
    robot.rods[i].section.outer_radius = i == 0 ? 0.001 : 0.02;
    if (i == 0) continue;
    robot.rods[i].X_BD.p = robot.rods[i].X_PE.p = 0.1 * Vector3(std::cos(2.1 * i), std::sin(2.1 * i), 0.0);
  }
  const double strain = std::pow(kPi * 0.001 / kLength, 2);
  const ParallelModel model(robot, {1e-7});
  const auto solve = [&](double share) {
    return solveCold(model, {kLength * (1.0 + share * strain), kLength, kLength, kLength});
  };
  EXPECT_TRUE(solve(0.9).status.ok());
  EXPECT_EQ(solve(1.1).status.code, SolveCode::kUnstable);
}

TEST(ParallelModel, RefusesBadInputAndRecovers) {
  const ParallelModel model(stewartGough(), {});
  ParallelWorkspace workspace = model.makeWorkspace();
  const std::vector<double> good = unevenLengths();
  const ParallelSolution expected = model.solve(good, Wrench::Zero(), workspace);
  ASSERT_TRUE(expected.status.ok());
  const auto statusOf = [&](std::vector<double> lengths, const Wrench& wrench) {
    const ParallelSolution solution = model.solve(lengths, wrench, workspace);
    EXPECT_TRUE(solution.compliance.allFinite() && solution.X_BP.p.allFinite());
    EXPECT_FALSE(model.describe(solution.status).empty());
    const ParallelSolution again = model.solve(good, Wrench::Zero(), workspace);
    EXPECT_TRUE(again.status.ok());
    EXPECT_LT(poseError(again.X_BP, expected.X_BP, kLength), 1e-8);
    return solution.status;
  };
  EXPECT_EQ(statusOf({0.4, 0.4}, Wrench::Zero()).code, SolveCode::kInvalidInput);
  for (double bad : {-0.4, 0.0, std::nan(""), kInfinity}) {
    const SolveStatus status = statusOf({0.4, 0.4, bad, 0.4, 0.4, 0.4}, Wrench::Zero());
    EXPECT_EQ(status.code, SolveCode::kInvalidInput);
    EXPECT_EQ(status.index, 2);
  }
  EXPECT_EQ(statusOf(good, std::nan("") * kWrench).code, SolveCode::kInvalidInput);
  EXPECT_FALSE(statusOf({0.1, 3.0, 0.1, 3.0, 0.1, 3.0}, Wrench::Zero()).ok());
  EXPECT_FALSE(statusOf(good, 1e6 * kWrench).ok());
  Pose skewed;
  skewed.R *= 1.1;
  EXPECT_EQ(model.solveForLengths(skewed, Wrench::Zero(), workspace).status.code, SolveCode::kInvalidInput);
  ParallelScene five = stewartGough();
  five.rods.pop_back();
  const ParallelModel fewer(five, {});
  ParallelWorkspace other = fewer.makeWorkspace();
  EXPECT_EQ(fewer.solveForLengths(Pose(), Wrench::Zero(), other).status.code, SolveCode::kInvalidInput);
  EXPECT_THROW(ParallelModel(ParallelScene(), {}), ConfigurationError);
  EXPECT_THROW(ParallelModel(stewartGough(), {std::nan("")}), ConfigurationError);
}

TEST(ParallelModel, PlacesStationsAlongItsRods) {
  const ParallelScene scene = awkwardRobot();
  const ParallelModel model(scene, {});
  ParallelWorkspace workspace = model.makeWorkspace();
  const ParallelSolution solution = model.solve(unevenLengths(), kWrench, workspace);
  ASSERT_TRUE(solution.status.ok());
  std::vector<Pose> stations;
  for (int i = 0; i < scene.rodCount(); ++i) {
    model.stations(workspace, i, {0.0, 0.5, 1.0}, stations);
    const ClampedRod& rod = workspace.statics().rods()[i];
    EXPECT_LT(poseError(stations[0], scene.rods[i].X_BD, kLength), 1e-12);
    EXPECT_LT(poseError(stations[2], solution.X_BP * scene.rods[i].X_PE, kLength), 1e-8);
    // Half the rod, under the same base wrench.
    const RodEnd middle = marchRod(scene.rods[i].section, scene.rods[i].X_BD, 0.5 * rod.length(), rod.baseWrench(),
                                   *scene.gravity, 400);
    EXPECT_LT(poseError(stations[1], middle.X, kLength), 1e-7);
  }
}

}  // namespace
}  // namespace live_stiffness
