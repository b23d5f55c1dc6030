// simulate_bag SCENE.yaml OUT.bag: what rig_simulator would publish, written to a bag without a master.

#include "command_line.h"
#include "rig/rig_model.h"
#include "bags/bag_reader.h"
#include "bags/output_bag.h"
#include "ros/conversions.h"
#include "parameter_options.h"
#include "progress_bar.h"
#include "scene_doubts.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

const char* const kHelp =
    "simulate_bag SCENE.yaml OUT.bag [options]\n\n";

}  // namespace

int main(int argc, char** argv) {
  std::string scene_path, bag_path, registration_path;
  double seconds = 20.0, rate = kSampleRate.standard;
  std::vector<double> push_n;
  int channels = 0;
  RigOptions rig_options;
  Contact& contact = rig_options.contact;
  po::options_description options = helpOption();
  options.add_options()
    ("scene", po::value(&scene_path)->required(), "scene file")
    ("bag", po::value(&bag_path)->required(), "bag to write")
    ("seconds", po::value(&seconds)->default_value(seconds), "length of the bag")
    ("channels", po::value(&channels), "pressure channels, each feeding as many neighbouring chambers (default: one "
                                       "per chamber)")
    ("push-n", po::value(&push_n)->multitoken(), "force that pushes the tip now and then, X Y Z in base axes; the bag "
                                                 "then has the truth on tip_force_torque, in axes of the tip")
    ("push-start-s", po::value(&contact.start)->default_value(contact.start), kPushStart.meaning)
    ("push-duration-s", po::value(&contact.duration)->default_value(contact.duration), kPushDuration.meaning)
    ("push-period-s", po::value(&contact.period)->default_value(contact.period),
     "from push to push, each turned by 90 deg about z; 0: one push only")
    ("registration", po::value(&registration_path), "where base and sensor are (default: identity)");
  addOption(options, kProgram, rig_options.program.kind);
  addOption(options, kSampleRate, rate);
  addOption(options, kAmplitude, rig_options.program.amplitude);
  addOption(options, kSeed, rig_options.seed);
  return runProgram({argv, argv + argc}, kHelp, options, {{"scene", 1}, {"bag", 1}}, [&](const po::variables_map&) {
    FaultList faults("options");
    faults.check(kProgram, rig_options.program.kind);
    faults.check("seconds", seconds, {0.1, 1e5});
    faults.check(kSampleRate, rate);
    if (!push_n.empty() && push_n.size() != 3)
      faults.add("push-n has " + std::to_string(push_n.size()) + " numbers: must be three, X Y Z");
    else if (!push_n.empty()) contact.wrench << push_n[0], push_n[1], push_n[2], 0.0, 0.0, 0.0;
    faults.throwIfAny();
    const Scene scene = loadSceneWithDoubts(scene_path);
    if (channels > 0) rig_options.channel_of_chamber = ChannelMap::even(channels, scene.chamberCount()).channelOfChamber();
    if (!registration_path.empty()) rig_options.registration = loadRegistrationFile(registration_path);
    RigModel rig(scene, rig_options);
    const BagTopics topics;
    OutputBag bag(bag_path);
    const long samples = static_cast<long>(seconds * rate);
    ProgressBar progress("simulating " + bag_path, samples);
    for (long i = 0; i < samples; ++i) {
      const RigSample sample = rig.step(i / rate);
      const ros::Time stamp = bagTime(sample.time);
      bag.write(topics.pressures, stamp, toPressures(sample.measured_channels, stamp));
      if (sample.X_AS) bag.write(topics.pose, stamp + kNextMessage, toPoseStamped(*sample.X_AS, stamp, kTrackerFrame.standard));
      if (!push_n.empty())
        bag.write(topics.wrench, stamp + kNextMessage, toWrenchStamped(sample.sensedContact(), stamp, kForceSensorFrame));
      progress.update(i + 1);
    }
    bag.finish();
    return kExitOk;
  });
}
