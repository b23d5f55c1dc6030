// Tables on standard input: refused with a ConfigurationError, or rows that are complete or have a fault.

#include <sstream>

#include "fuzz_target.h"
#include "live_stiffness/checks.h"
#include "programs/solve_table.h"

using namespace live_stiffness;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  std::istringstream text(textOf(data, size));
  try {
    InputTable table(text, numberedColumns("p_", "_pa", 2));
    InputRow row;
    long line = 0;
    while (table.next(row)) {
      require(row.line > line, "rows come in order");
      require(row.values.size() == 2, "a value for each input");
      line = row.line;
    }
  } catch (const ConfigurationError& error) {
    require(!error.faults().empty(), "a refusal has a reason");
  }
  return 0;
}
