// replay BAG: a recorded bag through the estimator without a master, as fast as it goes.

#include <ros/package.h>

#include <filesystem>
#include <iostream>

#include "command_line.h"
#include "bag_options.h"
#include "part_file.h"
#include "live_stiffness/rod/scene_file.h"
#include "bags/bag_replay.h"
#include "parameter_options.h"
#include "progress_bar.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

const char* const kHelp =
    "replay BAG [--scene SCENE.yaml] [options]\n\nWrites what stiffness_node would have published to a new "
    "bag, and prints a report.\n\n";

}  // namespace

int main(int argc, char** argv) {
  std::string bag, out, scene, registration, report_path, model = kModel.standard;
  ModelOptions model_options;
  ReplayOptions replay;
  BagOptions bag_options(replay.format);
  po::options_description options = helpOption();
  options.add_options()
    ("bag", po::value(&bag)->required(), "bag to read")
    ("scene", po::value(&scene), "scene file of the robot (default: the package's paper_one_segment.yaml)")
    ("registration", po::value(&registration), "registration file (default: identity)")
    ("output,o", po::value(&out), "bag to write (default: BAG with .estimates.bag)")
    ("report", po::value(&report_path), "also write the report here, as Markdown")
    ("channel-of-chamber", po::value(&replay.channel_of_chamber)->multitoken(),
     "channel of each chamber, such as 0 0 1 1 2 2 (default: the bag's channels feed neighbours evenly)");
  addOption(options, kModel, model);
  addOption(options, kAccuracy, model_options.accuracy);
  addOption(options, kUpdateThreshold, replay.estimator.update_threshold);
  bag_options.addTo(options);
  return runProgram({argv, argv + argc}, kHelp, options, {{"bag", 1}}, [&](const po::variables_map&) {
    FaultList faults("options");
    model_options = namedModelOptions(model, "", faults, model_options);
    faults.checkAll(model_options);
    faults.checkAll(replay.estimator);
    replay.format = bag_options.format(faults);
    faults.check(kChannelOfChamber, replay.channel_of_chamber);
    faults.throwIfAny();
    if (!registration.empty()) replay.registration = loadRegistrationFile(registration);
    if (scene.empty()) {
      const std::string package = ros::package::getPath("live_stiffness");
      if (package.empty()) throw ConfigurationError("--scene", {"must be given: rospack does not find live_stiffness"});
      scene = package + "/config/scenes/paper_one_segment.yaml";
    }
    if (out.empty()) out = std::filesystem::path(bag).replace_extension(".estimates.bag").string();
    std::unique_ptr<ProgressBar> bar;
    const ReplayReport report =
        replayBag(bag, out, loadSceneFile(scene), model_options, replay, [&](long done, long total) {
          if (!bar) bar = std::make_unique<ProgressBar>("replaying " + bag, total);
          bar->update(done);
        });
    std::cout << "scene: " << scene << "\n\n";
    const std::string text = report.text(bag, model_options.accuracy);
    std::cout << text << "\nestimates: " << out << "\n";
    if (!report_path.empty()) writeTextFile("report", report_path, text);
    return kExitOk;
  });
}
