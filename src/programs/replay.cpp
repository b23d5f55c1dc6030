// replay BAG...: a recorded bag through what the node runs, without a master, as fast as it goes.

#include <filesystem>
#include <iostream>
#include <memory>

#include "analysis/scene_description.h"
#include "bag_topics_options.h"
#include "bags/bag_replay.h"
#include "command_line.h"
#include "input_options.h"
#include "part_file.h"
#include "progress_bar.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

const char* const kHelp =
    "replay BAG... --scene SCENE.yaml [--registration FILE] [--parameters NODE.yaml] [options]\n\n"
    "Writes to a new bag what stiffness_node would have published, and prints a report. Several bags are the parts of one\n"
    "recording. Without --scene it takes the scene of --parameters.\n\n";

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> bags;
  std::string out, report_path;
  BagTopics topics;
  topics.wrench = "tip_wrench";
  InputOptions parameter_options;
  po::options_description options = helpOption();
  options.add_options()
    ("bag", po::value(&bags)->required(), "bags to read")
    ("output,o", po::value(&out), "bag to write (default: the first BAG with .estimates.bag)")
    ("report", po::value(&report_path), "also write the report here, as Markdown");
  addOptions(options, topics);
  parameter_options.addFile(options);
  parameter_options.add(options, kSceneFile);
  parameter_options.add(options, kRegistrationFile);
  parameter_options.add<NodeParameters>(options, [](auto& parameters, auto visit) {
    NodeParameters::forEachOfModel(parameters, visit);
    InputParameters::forEachParameter(parameters, visit);
  });
  return runProgram({argv, argv + argc}, kHelp, options, {{"bag", -1}}, [&](const po::variables_map& given) {
    std::vector<std::string> unknown;
    const NodeParameters parameters =
        readNodeParameters(parameter_options.values(given, InputOptions::file(given)), "options", "", unknown);
    for (const std::string& key : unknown)
      if (!isReadByOthers(key)) std::cerr << "warning: parameter " << key << " is not known\n";
    for (const std::string& doubt : doubtsAbout(parameters.scene)) std::cerr << "warning: scene: " << doubt << "\n";
    if (out.empty()) out = std::filesystem::path(bags.front()).replace_extension(".estimates.bag").string();
    std::unique_ptr<ProgressBar> bar;
    const ReplayReport report = replayBags(bags, out, parameters, topics, [&](long done, long total) {
      if (!bar) bar = std::make_unique<ProgressBar>("replaying " + bags.front(), total);
      bar->update(done);
    });
    const std::string text = report.text(oneLine(bags), parameters);
    std::cout << text << "\nestimates: " << out << "\n";
    if (!report_path.empty()) writeTextFile("report", report_path, text);
    return kExitOk;
  });
}
