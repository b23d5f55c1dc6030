#include "command_line.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace po = boost::program_options;

namespace live_stiffness {

po::options_description helpOption() {
  po::options_description options("Options");
  options.add_options()("help,h", "print this and exit");
  return options;
}

int runProgram(const std::vector<std::string>& words, const std::string& help, const po::options_description& options,
               const std::vector<std::pair<const char*, int>>& positional,
               const std::function<int(const po::variables_map&)>& work) {
  const std::string name = std::filesystem::path(words.front()).filename().string();
  po::positional_options_description places;
  for (const auto& [option, count] : positional) places.add(option, count);
  try {
    po::variables_map values;
    po::store(po::command_line_parser(std::vector<std::string>(words.begin() + 1, words.end()))
                  .options(options)
                  .positional(places)
                  .run(),
              values);
    if (values.count("help")) {
      std::cout << help << options;
      return kExitOk;
    }
    po::notify(values);
    const int status = work(values);
    if (!(std::cout << std::flush) || std::fflush(stdout) != 0 || std::ferror(stdout))
      throw std::runtime_error("standard output could not be written in full: is the disk full?");
    return status;
  } catch (const po::error& error) {
    std::cerr << name << ": " << error.what() << "\nSee " << name << " --help.\n";
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << "\n";
  }
  return kExitFailed;
}

}  // namespace live_stiffness
