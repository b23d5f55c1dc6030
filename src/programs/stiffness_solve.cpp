// stiffness_solve SCENE.yaml [options] < pressures.csv > results.csv: the model without a ROS master. Without a table it
// describes the scene.

#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>

#include "command_line.h"
#include "live_stiffness/analysis/deflection.h"
#include "parameter_options.h"
#include "scene_doubts.h"
#include "solve_table.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

using Clock = std::chrono::steady_clock;

// What the table has beyond the tip.
struct Further {
  std::vector<double> fractions;  // of the stations of every segment
  bool deflection = false;
};

std::vector<std::string> namesOf(const Further& further, int segments) {
  std::vector<std::string> names;
  for (int k = 1; k <= segments; ++k)
    for (double fraction : further.fractions) {
      const std::string place = "s" + std::to_string(k) + "_" + numberText(fraction) + "_";
      addPoseColumns(place, names);
      addMatrixColumns(place + "material_", names);
    }
  if (further.deflection)
    for (const char* compliance : {"tangent_", "material_"})
      for (const char* way : {"linear_", "exponential_"})
        for (const char* axis : {"x_m", "y_m", "z_m"}) names.push_back(std::string(compliance) + way + axis);
  return names;
}

// Stations of the last solve in the workspace.
void appendStations(const StiffnessModel& model, const StiffnessWorkspace& workspace, const Further& further,
                    std::vector<double>& numbers) {
  for (int k = 0; k < model.scene().segmentCount(); ++k) {
    for (double fraction : further.fractions) {
      const Station station = model.station(workspace, k, fraction);
      append(station.X_BQ, numbers);
      append(station.compliance, numbers);
    }
  }
}

// Solves every row; rows do not depend on one another. Returns the number that failed.
long solveAll(const StiffnessModel& model, const Further& further, InputTable& table) {
  StiffnessWorkspace workspace = model.makeWorkspace();
  return solveTable(table, namesOf(further, model.scene().segmentCount()), [&](const InputRow& input) {
    const auto solve = [&](const Wrench& wrench) {
      workspace.reset();
      return model.solve(input.values, wrench, workspace);
    };
    const auto start = Clock::now();
    const StiffnessSolution solution = solve(input.wrench);
    ResultRow row = resultRow(model, solution, solution.X_BT, start);
    if (row.status.ok() && !further.fractions.empty()) appendStations(model, workspace, further, row.numbers);
    if (row.status.ok() && further.deflection) {
      const StiffnessSolution free = solve(Wrench::Zero());
      row.status = free.status;
      if (!free.status.ok()) row.fault = model.describe(free.status);
      for (const Matrix6& C : {free.compliance, free.material_compliance}) {
        const PredictedDeflection predicted = predictDeflection(free.X_BT, C, input.wrench);
        append(predicted.linear.p, row.numbers);
        append(predicted.exponential.p, row.numbers);
      }
    }
    return row;
  });
}

// Fractions such as 0.5,1.
std::vector<double> readFractions(const std::string& text, FaultList& faults) {
  if (text.empty()) return {};
  const std::optional<std::vector<double>> fractions = numberList(text, ',');
  const auto isFraction = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (fractions && std::all_of(fractions->begin(), fractions->end(), isFraction)) return *fractions;
  faults.add("stations = " + text + ": must be fractions of a segment's length from 0 to 1, such as 0.5,0.75,1");
  return {};
}

const char* const kHelp =
    "stiffness_solve SCENE.yaml [options] < pressures.csv > results.csv\n"
    "stiffness_solve SCENE.yaml --describe\n\n"
    "In:  header p_1_pa,...,p_N_pa (gauge, one column per chamber, base to tip) and optionally\n"
    "     fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm (dead wrench at the tip point, base axes).\n"
    "Out: status,iterations,solve_us, tip position and quaternion, then the tangent (c_ij) and material\n"
    "     compliance (material_ij) of the tip point, row by row, SI, linear part first, base axes.\n"
    "     --stations: s1_0.5_x_m ... s1_0.5_qz, s1_0.5_material_11 ... of segment 1 at half its length\n"
    "     (of what lies between base and there). --deflection: tangent_linear_x_m ...,\n"
    "     tangent_exponential_x_m ..., material_linear_x_m ..., material_exponential_x_m ...\n"
    "--describe, or a table that is empty (< /dev/null): instead what the scene means: lengths, masses,\n"
    "     gravity, tip and compliance at rest, margin to buckling, where 1 bar in each chamber moves the tip;\n"
    "     and doubts, values that look like a slip. With a table these are warnings on standard error.\n"
    "Exit status: 0 all rows solved, 1 some failed (see standard error), 2 nothing could be done.\n\n";

}  // namespace

int main(int argc, char** argv) {
  std::string scene_path, model_name, stepping, stations;
  Further further;
  bool describes = false;
  ModelOptions model_options;
  po::options_description options = helpOption();
  options.add_options()
    ("stations", po::value(&stations), "also pose and material compliance there in every segment: fractions of its "
                                       "length, such as 0.5,1")
    ("deflection", po::bool_switch(&further.deflection),
     "also where (19) and its linear part predict the tip, from both compliances without the wrench")
    ("describe", po::bool_switch(&describes), "print what the scene means, and what in it is doubtful; no table is read")
    ("scene", po::value(&scene_path)->required(), "scene file");
  addOption(options, kModel, model_name);
  addOption(options, kStepping, stepping);
  addOptions(options, model_options);
  return runProgram({argv, argv + argc}, kHelp, options, {{"scene", 1}}, [&](const po::variables_map&) {
    FaultList faults("options");
    model_options = namedModelOptions(model_name, stepping, faults, model_options);
    further.fractions = readFractions(stations, faults);
    faults.throwIfAny();
    std::ios::sync_with_stdio(false);
    if (describes || std::cin.peek() == std::istream::traits_type::eof()) {
      std::cout << describeScene(loadSceneFile(scene_path));
      return kExitOk;
    }
    const StiffnessModel model(loadSceneWithDoubts(scene_path), model_options);
    InputTable table(std::cin, numberedColumns("p_", "_pa", model.scene().chamberCount()));
    return solveAll(model, further, table) > 0 ? kExitPartly : kExitOk;
  });
}
