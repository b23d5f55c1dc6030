// stiffness_solve SCENE.yaml [options] < pressures.csv > results.csv: the model without a ROS master.

#include <boost/program_options.hpp>
#include <chrono>
#include <iostream>

#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/rod/scene_file.h"
#include "result_table.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kExitOk = 0, kExitRowFailed = 1, kExitUsage = 2;

// Solves every row; rows do not depend on one another. Returns the number that failed.
long solveAll(const StiffnessModel& model, InputTable& table) {
  StiffnessWorkspace workspace = model.makeWorkspace();
  return solveTable(table, {}, [&](const InputRow& input) {
    workspace.reset();
    const auto start = Clock::now();
    const StiffnessSolution solution = model.solve(input.values, input.wrench, workspace);
    ResultRow row;
    row.solve_us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
    row.status = solution.status;
    if (!row.status.ok()) row.fault = model.describe(row.status);
    row.iterations = solution.iterations;
    row.X = solution.X_BT;
    row.compliance = solution.compliance;
    row.material_compliance = solution.material_compliance;
    return row;
  });
}

}  // namespace

int main(int argc, char** argv) {
  std::string scene_path, model_name, stepping;
  ModelOptions defaults;
  double pressure_step_pa = defaults.pressure_step;
  double accuracy = defaults.accuracy;
  po::options_description options("Options");
  options.add_options()
    ("help,h", "print this and exit")
    ("model", po::value(&model_name), "lpcc, npcc, lcm or ncm: the paper's shorthand for the two switches; the PCC "
                                      "pair ignores external loads, the linear pair steps once (default: ncm)")
    ("stepping", po::value(&stepping), "fixed_step, continuous or linear (default: as the model says)")
    ("pressure-step-pa", po::value(&pressure_step_pa)->default_value(pressure_step_pa, "15000"),
     "largest step of fixed_step, Pa")
    ("accuracy", po::value(&accuracy)->default_value(accuracy, "1e-9"), "relative, of pose and compliance")
    ("scene", po::value(&scene_path)->required(), "scene file");
  po::positional_options_description positional;
  positional.add("scene", 1);
  try {
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options).positional(positional).run(), values);
    if (values.count("help")) {
      std::cout << "stiffness_solve SCENE.yaml [options] < pressures.csv > results.csv\n\n"
                   "In:  header p_1_pa,...,p_N_pa (gauge, one column per chamber, base to tip) and optionally\n"
                   "     fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm (dead wrench at the tip point, base axes).\n"
                   "Out: status,iterations,solve_us, tip position and quaternion, then the tangent (c_ij) and material\n"
                   "     compliance (material_ij) of the tip point, row by row, SI, linear part first, base axes.\n"
                   "Exit status: 0 all rows solved, 1 some failed (see standard error), 2 nothing could be done.\n\n"
                << options;
      return kExitOk;
    }
    po::notify(values);
    FaultList faults("options");
    ModelOptions model_options = namedModelOptions(model_name, stepping, faults);
    faults.throwIfAny();
    model_options.pressure_step = pressure_step_pa;
    model_options.accuracy = accuracy;
    const StiffnessModel model(loadSceneFile(scene_path), model_options);
    std::ios::sync_with_stdio(false);
    InputTable table(std::cin, numberedColumns("p_", "_pa", model.scene().chamberCount()));
    return solveAll(model, table) > 0 ? kExitRowFailed : kExitOk;
  } catch (const std::exception& error) {
    std::cerr << "stiffness_solve: " << error.what() << "\nSee stiffness_solve --help.\n";
    return kExitUsage;
  }
}
