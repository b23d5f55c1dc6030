#pragma once
// What every program without a master does around its work.

#include <boost/program_options.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace live_stiffness {

constexpr int kExitOk = 0, kExitPartly = 1, kExitFailed = 2;

// Only --help.
boost::program_options::options_description helpOption();

// Reads a command line (words[0]: the program's path; positional: options whose names may be left out, each so many times, -1:
// any) and does the work. Returns its exit status; kExitOk after --help, which prints `help` and the options; kExitFailed, with
// what was wrong on standard error, when an option is not understood, an exception is thrown or standard output cannot take
// all that was written.
int runProgram(const std::vector<std::string>& words, const std::string& help,
               const boost::program_options::options_description& options,
               const std::vector<std::pair<const char*, int>>& positional,
               const std::function<int(const boost::program_options::variables_map&)>& work);

}  // namespace live_stiffness
