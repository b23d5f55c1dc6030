// orthonormality_report FOLDER: writes FOLDER/orthonormality.csv, the data of Fig. 17 of the paper and the same of this
// library. Columns: method, elements, fraction (of the arc length, 0 to 1), error (52).
//   rk4_figure_17    RK4 on rotation matrices, linear model without weight: what the paper shows
//   rk4_ncm          the same with the nonlinear model under weight
//   live_stiffness   this library, nonlinear model under weight
// RK4: at the tip (fraction 1) for 1 to 50 elements, and all along for 50. The library: all along.

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include "support/orthonormality.h"

namespace {

using namespace live_stiffness;

constexpr int kElements = 50;

void writeAlong(std::ostream& out, const std::string& method, int elements, const std::vector<double>& errors) {
  for (size_t i = 0; i < errors.size(); ++i)
    out << method << ',' << elements << ',' << i / (errors.size() - 1.0) << ',' << errors[i] << '\n';
}

void writeRungeKutta(std::ostream& out, const std::string& method, const OrthonormalityCase& which) {
  for (int elements = 1; elements < kElements; ++elements)
    out << method << ',' << elements << ",1," << rungeKuttaOrthonormality(which, elements).back() << '\n';
  writeAlong(out, method, kElements, rungeKuttaOrthonormality(which, kElements));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: orthonormality_report FOLDER\n";
    return EXIT_FAILURE;
  }
  const std::string path = std::string(argv[1]) + "/orthonormality.csv";
  std::ofstream out(path);
  try {
    out << "method,elements,fraction,error\n";
    writeRungeKutta(out, "rk4_figure_17", kFigure17);
    writeRungeKutta(out, "rk4_ncm", OrthonormalityCase());
    const SolverOrthonormality solver = solverOrthonormality(OrthonormalityCase(), kElements + 1);
    writeAlong(out, "live_stiffness", solver.elements, solver.errors);
  } catch (const std::exception& error) {
    std::cerr << "orthonormality_report: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
  if (!out.flush()) {
    std::cerr << "orthonormality_report: cannot write " << path << '\n';
    return EXIT_FAILURE;
  }
  std::cout << path << '\n';
  return EXIT_SUCCESS;
}
