// register_recording SCENE.yaml RECORDING OUT.yaml: where the base stands in the tracker's frame and where the sensor
// sits on the tip, from a recording, with residuals and a verdict whether the data determine it.

#include <boost/program_options.hpp>
#include <iostream>

#include "any_recording.h"
#include "live_stiffness/calibration/calibration.h"
#include "live_stiffness/calibration/calibration_report.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/rod/scene_file.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

constexpr int kExitOk = 0, kExitNotDetermined = 1, kExitUsage = 2;

const char* const kHelp =
    "register_recording SCENE.yaml RECORDING.csv|.bag OUT.yaml [--samples all|quasi_static] [--no-orientation]\n\n"
    "Fits base in tracker and sensor on tip and writes them for the node (`registration`). Samples under contact are left\n"
    "out. Exit status 1: written, but these data do not determine it.\n\n";

int run(const std::string& scene_path, const std::string& recording_path, const std::string& output_path,
        const std::string& samples, bool orientation) {
  FaultList faults("options");
  if (samples != "all" && samples != "quasi_static")
    faults.add("samples '" + samples + "': must be all or quasi_static");
  faults.throwIfAny();
  CalibrationOptions options;
  options.model.stepping = Stepping::kContinuous;
  if (!orientation) options.rotation_sigma = 0.0;
  const Scene scene = loadSceneFile(scene_path);
  const CalibrationRecording recording(loadAnyRecording(recording_path),
                                       samples == "all" ? SampleChoice::kAll : SampleChoice::kQuasiStatic,
                                       LoadedSamples::kIgnore);
  const ChannelMap channels = ChannelMap::even(recording.recording.channelCount(), scene.chamberCount());
  const CalibrationResult result = calibrate(scene, channels, {}, {recording}, {}, options);
  const std::string report = reportText(result);
  std::cout << report;
  saveRegistrationFile(output_path, result.recordings[0].registration,
                       "register_recording: " + recording_path + " with scene " + scene_path + "\n" + report);
  return result.recordings[0].determined ? kExitOk : kExitNotDetermined;
}

}  // namespace

int main(int argc, char** argv) {
  std::string scene, recording, output, samples = "all";
  bool no_orientation = false;
  po::options_description options("Options");
  options.add_options()
    ("help,h", "print this and exit")
    ("scene", po::value(&scene)->required(), "scene of the recorded robot")
    ("recording", po::value(&recording)->required(), "CSV recording, or a bag")
    ("output", po::value(&output)->required(), "registration file to write")
    ("samples", po::value(&samples)->default_value(samples), "all (in motion too), or quasi_static (at rest only)")
    ("no-orientation", po::bool_switch(&no_orientation), "use positions only; the sensor's rotation is then their mean");
  po::positional_options_description positional;
  positional.add("scene", 1).add("recording", 1).add("output", 1);
  try {
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options).positional(positional).run(), values);
    if (values.count("help")) {
      std::cout << kHelp << options;
      return kExitOk;
    }
    po::notify(values);
    return run(scene, recording, output, samples, !no_orientation);
  } catch (const std::exception& error) {
    std::cerr << "register_recording: " << error.what() << "\nSee register_recording --help.\n";
    return kExitUsage;
  }
}
