// stiffness_solve SCENE.yaml [options] < pressures.csv > results.csv: the model without a ROS master.

#include <unistd.h>

#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>

#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/rod/scene_file.h"
#include "pressure_table.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kExitOk = 0, kExitRowFailed = 1, kExitUsage = 2;

void printHeader() {
  std::string header = "status,iterations,solve_us,x_m,y_m,z_m,qw,qx,qy,qz";
  for (const char* matrix : {"c_", "material_"})
    for (int i = 1; i <= 6; ++i)
      for (int j = 1; j <= 6; ++j) header += "," + (matrix + std::to_string(i)) + std::to_string(j);
  std::puts(header.c_str());
}

void printNumber(double value) { std::printf(",%.17g", value); }

// A failed row keeps its columns, empty.
void printRow(const StiffnessSolution& solution, double solve_us) {
  std::fputs(codeName(solution.status.code), stdout);
  if (!solution.status.ok()) {
    for (int column = 0; column < 9 + 72; ++column) std::putchar(',');
  } else {
    std::printf(",%d,%.3f", solution.iterations, solve_us);
    for (int i = 0; i < 3; ++i) printNumber(solution.X_BT.p[i]);
    const Eigen::Quaterniond q(solution.X_BT.R);
    for (double value : {q.w(), q.x(), q.y(), q.z()}) printNumber(value);
    for (const Matrix6* matrix : {&solution.compliance, &solution.material_compliance})
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) printNumber((*matrix)(i, j));
  }
  std::putchar('\n');
}

// Solves every row; rows do not depend on one another. Returns the number that failed.
long solveAll(const StiffnessModel& model, PressureTable& table) {
  StiffnessWorkspace workspace = model.makeWorkspace();
  const bool shows_progress = isatty(STDERR_FILENO) && !isatty(STDOUT_FILENO);
  auto last_progress = Clock::now();
  long rows = 0, failed = 0;
  PressureRow row;
  while (table.next(row)) {
    StiffnessSolution solution;
    double solve_us = 0.0;
    std::string fault = row.fault;
    if (fault.empty()) {
      workspace.reset();
      const auto start = Clock::now();
      solution = model.solve(row.pressures, row.tip_wrench, workspace);
      solve_us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
      if (!solution.status.ok()) fault = model.describe(solution.status);
    } else {
      solution.status.code = SolveCode::kInvalidInput;
    }
    printRow(solution, solve_us);
    ++rows;
    if (!fault.empty()) {
      ++failed;
      std::cerr << "line " << row.line << ": " << fault << '\n';
    }
    if (std::cin.rdbuf()->in_avail() <= 0) std::fflush(stdout);
    if (shows_progress && Clock::now() - last_progress > std::chrono::seconds(1)) {
      last_progress = Clock::now();
      std::cerr << rows << " rows solved, " << failed << " failed\r" << std::flush;
    }
  }
  return failed;
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
    PressureTable table(std::cin, model.scene().chamberCount());
    printHeader();
    return solveAll(model, table) > 0 ? kExitRowFailed : kExitOk;
  } catch (const std::exception& error) {
    std::cerr << "stiffness_solve: " << error.what() << "\nSee stiffness_solve --help.\n";
    return kExitUsage;
  }
}
