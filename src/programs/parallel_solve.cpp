// parallel_solve SCENE.yaml [options] < lengths.csv > results.csv: a parallel continuum robot without a ROS master.

#include <chrono>
#include <iostream>

#include "command_line.h"
#include "live_stiffness/parallel/parallel_model.h"
#include "live_stiffness/parallel/parallel_scene_file.h"
#include "parameter_options.h"
#include "solve_table.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

// Points of every rod, evenly from base to platform.
struct RodShapes {
  std::vector<double> fractions;

  void addColumns(int rods, std::vector<std::string>& names) const {
    for (int rod = 1; rod <= rods; ++rod)
      for (size_t i = 1; i <= fractions.size(); ++i)
        for (const char* axis : {"x", "y", "z"})
          names.push_back("r" + std::to_string(rod) + "_" + std::to_string(i) + "_" + axis + "_m");
  }
  void appendPoints(const ParallelModel& model, const ParallelWorkspace& workspace, std::vector<double>& numbers) const {
    if (fractions.empty()) return;
    std::vector<Pose> points;
    for (int rod = 0; rod < model.scene().rodCount(); ++rod) {
      model.stations(workspace, rod, fractions, points);
      for (const Pose& point : points) append(point.p, numbers);
    }
  }
};

// Rows do not depend on one another. Returns the number that failed. inverse: poses are given, and lengths found.
long solveAll(const ParallelModel& model, const RodShapes& shapes, bool inverse) {
  std::vector<std::string> inputs, further;
  if (inverse) addPoseColumns("", inputs);
  for (const std::string& length : numberedColumns("l_", "_m", model.scene().rodCount()))
    (inverse ? further : inputs).push_back(length);
  shapes.addColumns(model.scene().rodCount(), further);
  InputTable table(std::cin, inputs);
  ParallelWorkspace workspace = model.makeWorkspace();
  const auto solve = [&](const InputRow& input) {
    const auto& v = input.values;
    if (!inverse) return model.solve({v.data(), v.data() + v.size()}, input.wrench, workspace);
    const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
    Pose X_BP{q.normalized().toRotationMatrix(), v.head<3>()};
    if (!(std::abs(q.norm() - 1.0) < 1e-3)) X_BP.R.setConstant(std::nan(""));  // refused as no rotation
    return model.solveForLengths(X_BP, input.wrench, workspace);
  };
  return solveTable(table, further, [&](const InputRow& input) {
    workspace.reset();
    const auto start = std::chrono::steady_clock::now();
    const ParallelSolution solution = solve(input);
    ResultRow row = resultRow(model, solution, solution.X_BP, start);
    if (!row.status.ok()) return row;
    if (inverse)
      for (double length : workspace.lengths()) row.numbers.push_back(length);
    shapes.appendPoints(model, workspace, row.numbers);
    return row;
  });
}

const char* const kHelp =
    "parallel_solve SCENE.yaml [options] < lengths.csv > results.csv\n\n"
    "In:  header l_1_m,...,l_N_m (length of each rod between base and platform, in the order of the\n"
    "     scene) and optionally fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm (dead wrench on the platform at its\n"
    "     origin, base axes). With --inverse x_m,y_m,z_m,qw,qx,qy,qz instead of the lengths.\n"
    "Out: status,iterations,solve_us, platform position and quaternion, then the tangent (c_ij) and the\n"
    "     material compliance by (53) (material_ij) of the platform's origin, row by row, SI, linear part\n"
    "     first, base axes. With --inverse then l_1_m,...,l_N_m. With --points then\n"
    "     r1_1_x_m, ...: rod 1, point 1, in the base.\n"
    "Exit status: 0 all rows solved, 1 some failed (see standard error), 2 nothing could be done.\n\n";

}  // namespace

int main(int argc, char** argv) {
  std::string scene_path;
  ParallelOptions parallel_options;
  int points = 0;
  po::options_description options = helpOption();
  options.add_options()
    ("inverse", "read platform poses and find the lengths of six rods")
    ("points", po::value(&points)->default_value(points),
     "also this number of points of every rod, at equal distances from base to platform")
    ("scene", po::value(&scene_path)->required(), "scene file of kind parallel");
  addOption(options, kAccuracy, parallel_options.accuracy);
  return runProgram({argv, argv + argc}, kHelp, options, {{"scene", 1}}, [&](const po::variables_map& values) {
    if (points != 0 && (points < 2 || points > 1000))
      throw ConfigurationError("options", {"points = " + std::to_string(points) + ": must be 0 or from 2 to 1000"});
    RodShapes shapes;
    for (int i = 0; i < points; ++i) shapes.fractions.push_back(i / (points - 1.0));
    const ParallelModel model(loadParallelSceneFile(scene_path), parallel_options);
    std::ios::sync_with_stdio(false);
    return solveAll(model, shapes, values.count("inverse") > 0) > 0 ? kExitPartly : kExitOk;
  });
}
