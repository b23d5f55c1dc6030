// recording_to_bag RECORDING.csv OUT.bag [--scene SCENE.yaml --registration OUT.yaml]: CSV recording to bag, no master.

#include <iostream>

#include "command_line.h"
#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/estimation/recording.h"
#include "live_stiffness/estimation/registration_fit.h"
#include "estimation/creep.h"
#include "bags/output_bag.h"
#include "progress_bar.h"
#include "recording_help.h"
#include "recording_reader.h"
#include "ros/conversions.h"
#include "scene_doubts.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

void writeBag(const Recording& recording, const std::vector<Pressures>& channels, const std::string& path) {
  const BagTopics topics;
  OutputBag bag(path);
  ProgressBar progress("writing " + path, static_cast<long>(recording.samples.size()));
  const double start = recording.samples.front().time;
  for (size_t i = 0; i < recording.samples.size(); ++i) {
    const RecordedSample& sample = recording.samples[i];
    const ros::Time stamp = bagTime(sample.time - start);
    bag.write(topics.pressures, stamp, toPressures(channels[i], stamp));
    bag.write(topics.pose, stamp + kNextMessage, toPoseStamped(sample.tipPose(), stamp, kTrackerFrame.standard));
    if (sample.tip_wrench)
      bag.write(topics.wrench, stamp + kNextMessage, toWrenchStamped(*sample.tip_wrench, stamp, kForceSensorFrame));
    progress.update(static_cast<long>(i) + 1);
  }
  bag.finish();
}

// Fits where base and sensor are from the whole recording, and says how well the model then agrees. False: not determined.
bool registerRecording(const Recording& recording, const std::vector<Pressures>& channels, const RecordingReader& reader,
                       const std::string& scene_path, const std::string& registration_path) {
  const StiffnessModel model(loadSceneWithDoubts(scene_path), ModelOptions());
  const ChannelMap map = reader.channels(recording, model.scene());
  SceneCreep creep(model.scene());
  StiffnessWorkspace workspace = model.makeWorkspace();
  std::vector<Pose> predicted, measured;
  ProgressBar progress("solving " + recording.name, static_cast<long>(channels.size()));
  for (size_t i = 0; i < channels.size(); ++i) {
    progress.update(static_cast<long>(i) + 1);
    const Pressures& effective = creep.update(channels[i], recording.samples[i].time);
    if (recording.samples[i].unchanged_for > 0.0) continue;  // no measurement
    const StiffnessSolution solution = model.solve(map.expand(effective), Wrench::Zero(), workspace);
    if (!solution.status.ok())
      throw ConfigurationError(recording.name, {"line " + std::to_string(recording.samples[i].line) + ": " +
                                                model.describe(solution.status)});
    predicted.push_back(solution.X_BT);
    measured.push_back(recording.samples[i].tipPose());
  }
  const RegistrationFit fit = fitRegistration(predicted, measured, recording.measures);
  const std::string error = "tip error after registration: " + millimetreText(fit.position);
  std::cout << error << "\n";
  if (!fit.determined()) std::cout << fit.advice() << '\n';
  saveRegistrationFile(registration_path, fit.registration,
                       "Fitted by recording_to_bag to " + recording.name + " with scene " + scene_path + ":\n" + error);
  return fit.determined();
}

const char* const kHelp =
    "recording_to_bag RECORDING.csv OUT.bag [--scene SCENE.yaml --registration OUT.yaml]\n\n"
    "Topics: chamber_pressures (gauge: less the mean of the first 0.5 s when absolute), aurora_pose,\n"
    "tip_force_torque when there is a force sensor. Exit status 1: all is written, but the registration is not determined.\n\n";

}  // namespace

int main(int argc, char** argv) {
  std::string recording_path, bag_path, scene_path, registration_path;
  RecordingReader reader;
  po::options_description options = helpOption();
  reader.addOptionsTo(options);
  options.add_options()
    ("recording", po::value(&recording_path)->required(), "CSV recording, or a bag with other topics and units")
    ("bag", po::value(&bag_path)->required(), "bag to write")
    ("scene", po::value(&scene_path), "scene of the recorded robot, for --registration")
    ("registration", po::value(&registration_path), "also fit base and sensor to the recording and write them here");
  return runProgram({argv, argv + argc}, kHelp + kRecordingHelp, options, {{"recording", 1}, {"bag", 1}},
                    [&](const po::variables_map& values) {
    reader.configure(values);
    if (values.count("scene") != values.count("registration"))
      throw ConfigurationError("options", {"--scene and --registration belong together: give both or none"});
    const Recording recording = reader.load(recording_path);
    const std::vector<Pressures> channels = gaugePressures(recording);
    writeBag(recording, channels, bag_path);
    const bool is_good =
        scene_path.empty() || registerRecording(recording, channels, reader, scene_path, registration_path);
    return is_good ? kExitOk : kExitPartly;
  });
}
