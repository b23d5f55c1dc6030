// register_recording SCENE.yaml RECORDING OUT.yaml: where the base stands in the tracker's frame and where the sensor
// sits on the tip, from a recording, with residuals and a verdict whether the data determine it.

#include <iostream>

#include "command_line.h"
#include "calibration/base_sensor.h"
#include "calibration/calibration.h"
#include "calibration/calibration_report.h"
#include "calibration/pose_pairs.h"
#include "estimation/orientation_check.h"
#include "estimation/tracker_delay.h"
#include "live_stiffness/checks.h"
#include "recording_help.h"
#include "recording_reader.h"
#include "sample_options.h"
#include "scene_doubts.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

const char* const kHelp =
    "register_recording SCENE.yaml RECORDING.csv|.bag... OUT.yaml [--samples all|quasi_static] [--fit-delay]\n"
    "                   [--fix-orientation]\n\n"
    "Fits base in tracker and sensor on tip, and on demand how late the tracker is, and writes them for the node\n"
    "(`registration`). Samples under contact are left out. Orientations are tried against the positions: those that are not\n"
    "measured are not used, and a misread or mirrored one is named. Exit status 1: written, but these data do not determine\n"
    "it, or the orientations are misread.\n\n";

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
  std::string scene_path, output_path, samples = "all";
  std::vector<std::string> recordings;
  bool no_orientation = false, fit_delay = false, fix_orientation = false;
  double tracker_delay = 0.0;
  RecordingReader reader;
  po::options_description options = helpOption();
  options.add_options()
    ("scene", po::value(&scene_path)->required(), "scene of the recorded robot")
    ("recording", po::value(&recordings)->required(), "CSV recording, or the bags of one")
    ("output", po::value(&output_path), "registration file to write, if it is not the last of all")
    ("samples", po::value(&samples)->default_value(samples), "all (in motion too), or quasi_static (at rest only)")
    ("fix-orientation", po::bool_switch(&fix_orientation), "read misread or mirrored poses as the data say, and go on")
    ("no-orientation", po::bool_switch(&no_orientation), "use positions only; the sensor's rotation is then their mean")
    ("tracker-delay-s", po::value(&tracker_delay)->default_value(0.0), "delay of the tracker relative to the pressures")
    ("fit-delay", po::bool_switch(&fit_delay), "fit that delay too, to the samples in motion");
  reader.addOptionsTo(options);
  return runProgram({argv, argv + argc}, kHelp + kRecordingHelp, options, {{"scene", 1}, {"recording", -1}},
                    [&](const po::variables_map& given) {
    reader.configure(given);
    FaultList faults("options");
    if (output_path.empty() && recordings.size() > 1) {
      output_path = recordings.back();
      recordings.pop_back();
    }
    if (output_path.empty()) faults.add("OUT.yaml is missing: must be the registration file to write");
    faults.check("tracker-delay-s", tracker_delay, {-Registration::kLargestDelay, Registration::kLargestDelay});
    const SampleChoice choice = sampleChoice(samples, faults);
    faults.throwIfAny();
    CalibrationOptions fit_options;
    fit_options.model.stepping = Stepping::kContinuous;
    if (no_orientation) fit_options.rotation_sigma = 0.0;
    const Scene scene = loadSceneWithDoubts(scene_path);
    Recording recording = reader.load(recordings, &scene);
    const ChannelMap channels = reader.channels(recording, scene);
    const auto chosen = [&](double delay) {
      return CalibrationRecording(withTrackerDelay(recording, delay), choice, LoadedSamples::kIgnore);
    };
    PosePairs pairs = posePairs(scene, channels, chosen(tracker_delay), fit_options.model);
    OrientationCheck check;
    check.measures = recording.measures.value_or(TrackerMeasures::kPose);
    if (pairs.X_BT.size() >= 3) check = checkOrientations(pairs.X_BT, pairs.X_AS, recording.measures);
    std::string note = check.text().empty() ? "" : check.text() + "\n";
    if (fix_orientation && check.readings.size() == 1) {
      const PoseReading reading = check.readings.front();
      recording = apply(reading, std::move(recording));
      pairs = posePairs(scene, channels, chosen(tracker_delay), fit_options.model);
      check = checkOrientations(pairs.X_BT, pairs.X_AS, check.measures);
      note += "--fix-orientation: holds for poses " + reading.text() + "; the node needs the same: mend the driver\n";
      if (check.wrong()) note += check.text() + "\n";
    } else if (check.readings.size() == 1) {
      note += "(--fix-orientation applies it)\n";
    }
    recording.measures = check.measures;
    // Orientations that are wrong must not spoil the positions; single axes have no part in the fit.
    if (check.wrong() || check.measures != TrackerMeasures::kPose) fit_options.rotation_sigma = 0.0;
    const auto registered = [&](double delay) { return calibrate(scene, channels, {}, {chosen(delay)}, {}, fit_options); };
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
    Registration registration = result.recordings[0].registration;
    registration.tracker_delay = tracker_delay;
    if (check.measures != TrackerMeasures::kPose) {
      registration.X_TS.R = sensorRotation(registration.X_AB.R, pairs.X_BT, pairs.X_AS, check.measures);
      note += check.measures == TrackerMeasures::kPosition ? "the sensor's rotation" : "the sensor's turn about its z axis";
      note += " is not measured, and zero in the file; tell the node: tracker_measures: " +
              trackerMeasuresName(check.measures) + "\n";
    }
    if (result.recordings[0].relative_to_base)
      note += "the registration is relative to the base sensor: for estimate_wrench; the node has none and cannot use it\n";
    if (check.wrong()) {
      result.recordings[0].determined = false;
      result.recordings[0].verdict = "NOT determined: poses are misread, or told to measure what they do not; see below";
    }
    const std::string report = reportText(result) + (fit_delay ? found.text() + "\n" : "") + note;
    std::cout << report;
    saveRegistrationFile(output_path, registration,
                         "register_recording: " + recording.name + " with scene " + scene_path + "\n" + report);
    return result.recordings[0].determined && found.determined ? kExitOk : kExitPartly;
  });
}
