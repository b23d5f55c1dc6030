#pragma once
// Random hard cases of every kind, by class and number: the same everywhere and in every run.

#include <ostream>
#include <string>
#include <vector>

#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

struct HardDraw {
  Scene scene;
  ModelOptions options;
  Pressures pressures;
  Wrench wrench = Wrench::Zero();
  // Solved before in the same workspace, if any: a warm start from something else.
  std::vector<std::pair<Pressures, Wrench>> before;
};

struct HardDrawClass {
  const char* name;
  int weight;       // draws in proportion: classes that take long have fewer
  double least_ok;  // share of draws that the solver must bring to ok
};

const std::vector<HardDrawClass>& hardDrawClasses();
int totalHardDrawWeight();

inline std::ostream& operator<<(std::ostream& out, const HardDrawClass& c) { return out << c.name; }

HardDraw hardDraw(const std::string& draw_class, unsigned long number);

// What became of a draw. An ok result is accurate if a cold solve of the same to 1e-12 agrees and moments balance.
struct DrawOutcome {
  SolveCode code = SolveCode::kOk;
  double error = 0.0;       // of pose and both compliances, relative; of an ok result whose reference is ok
  double imbalance = 0.0;   // of moments at the base, over the load times the length
  double estimate = 0.0;
  int iterations = 0;
  bool finite = true;
  bool threw = false;
  bool reference_failed = false;  // the cold solve to 1e-12 gave no ok result: then the moments alone count
  double reference_estimate = 0.0;  // how far off the reference itself may be: near buckling 1e-12 is out of reach
  bool other_branch = false;      // of a warm start: in balance and stable, but not where a cold start ends

  bool isAccurate(double accuracy) const;
  bool isHonest(double accuracy) const;  // accurate, or with a status that says it is not
};

DrawOutcome runHardDraw(const HardDraw& draw);

}  // namespace live_stiffness
