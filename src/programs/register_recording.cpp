// register_recording SCENE.yaml RECORDING OUT.yaml: where the base stands in the tracker's frame and where the sensor
// sits on the tip, from a recording, with residuals and a verdict whether the data determine it.

#include <iostream>

#include "command_line.h"
#include "calibration/base_sensor.h"
#include "calibration/calibration.h"
#include "calibration/calibration_report.h"
#include "live_stiffness/checks.h"
#include "estimation/tracker_delay.h"
#include "live_stiffness/rod/scene_file.h"
#include "recording_reader.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

const char* const kHelp =
    "register_recording SCENE.yaml RECORDING.csv|.bag OUT.yaml [--samples all|quasi_static] [--fit-delay]\n\n"
    "Fits base in tracker and sensor on tip, and on demand how late the tracker is, and writes them for the node\n"
    "(`registration`). Samples under contact are left out. Exit status 1: written, but these data do not determine it.\n\n";

// What delay a registration still leaves, over all samples with an equilibrium that nothing touches, in motion or not.
TrackerDelay delayLeft(Recording recording, const RecordingFit& fit) {
  std::vector<Vector3> predicted;
  std::vector<RecordedSample> solved;
  for (size_t i = 0; i < recording.samples.size(); ++i) {
    if (!fit.position_residual[i].allFinite()) continue;
    predicted.push_back(recording.samples[i].tip_position + fit.registration.X_AB.R * fit.position_residual[i]);
    solved.push_back(recording.samples[i]);
  }
  recording.samples = solved;
  return fitTrackerDelay(recording, predicted);
}

}  // namespace

int main(int argc, char** argv) {
  std::string scene_path, recording_path, output_path, samples = "all";
  bool no_orientation = false, fit_delay = false;
  double tracker_delay = 0.0;
  RecordingReader reader;
  po::options_description options = helpOption();
  options.add_options()
    ("scene", po::value(&scene_path)->required(), "scene of the recorded robot")
    ("recording", po::value(&recording_path)->required(), "CSV recording, or a bag")
    ("output", po::value(&output_path)->required(), "registration file to write")
    ("samples", po::value(&samples)->default_value(samples), "all (in motion too), or quasi_static (at rest only)")
    ("no-orientation", po::bool_switch(&no_orientation), "use positions only; the sensor's rotation is then their mean")
    ("tracker-delay-s", po::value(&tracker_delay)->default_value(0.0), "delay of the tracker relative to the pressures")
    ("fit-delay", po::bool_switch(&fit_delay), "fit that delay too, to the samples in motion");
  reader.addOptionsTo(options);
  return runProgram({argv, argv + argc}, kHelp, options, {{"scene", 1}, {"recording", 1}, {"output", 1}},
                    [&](const po::variables_map&) {
    FaultList faults("options");
    faults.check("tracker-delay-s", tracker_delay, {-Registration::kLargestDelay, Registration::kLargestDelay});
    const SampleChoice choice = sampleChoice(samples, faults);
    faults.throwIfAny();
    CalibrationOptions fit_options;
    fit_options.model.stepping = Stepping::kContinuous;
    if (no_orientation) fit_options.rotation_sigma = 0.0;
    const Scene scene = loadSceneFile(scene_path);
    const Recording recording = reader.load(recording_path);
    const ChannelMap channels = ChannelMap::even(recording.channelCount(), scene.chamberCount());
    const auto registered = [&](double delay) {
      const CalibrationRecording data(withTrackerDelay(recording, delay), choice, LoadedSamples::kIgnore);
      return calibrate(scene, channels, {}, {data}, {}, fit_options);
    };
    CalibrationResult result = registered(tracker_delay);
    TrackerDelay found;
    found.determined = true;
    // Twice, as a registration by samples in motion is wrong by the delay at first.
    for (int round = 0; fit_delay && found.determined && round < 2; ++round) {
      const double rms_before = found.rms_before;
      found = delayLeft(relativeToBase(withTrackerDelay(recording, tracker_delay)), result.recordings[0]);
      if (round > 0) found.rms_before = rms_before;
      found.delay = tracker_delay += found.delay;
      result = registered(tracker_delay);
    }
    const std::string report = reportText(result) + (fit_delay ? found.text() + "\n" : "");
    std::cout << report;
    Registration registration = result.recordings[0].registration;
    registration.tracker_delay = tracker_delay;
    saveRegistrationFile(output_path, registration,
                         "register_recording: " + recording_path + " with scene " + scene_path + "\n" + report);
    return result.recordings[0].determined && found.determined ? kExitOk : kExitPartly;
  });
}
