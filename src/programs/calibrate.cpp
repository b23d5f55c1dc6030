// calibrate SCENE.yaml RECORDING...: fits chosen parameters of a scene, and where base and sensor are, to recordings
// and to tables of measured compliance. Needs no ROS; built with it, it reads bags too.

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>

#include "command_line.h"
#include "csv_table.h"
#include "force_sensor_options.h"
#include "calibration/calibration.h"
#include "calibration/calibration_report.h"
#include "calibration/pose_pairs.h"
#include "calibration/scene_text.h"
#include "estimation/orientation_check.h"
#include "live_stiffness/checks.h"
#include "estimation/tracker_delay.h"
#include "parameter_options.h"
#include "part_file.h"
#include "live_stiffness/rod/scene_file.h"
#include "recording_help.h"
#include "recording_reader.h"
#include "sample_options.h"
#include "scene_doubts.h"
#include "progress_bar.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

const char* const kHelp =
    "calibrate SCENE.yaml [RECORDING.csv|.bag ...] [--compliance-table TABLE.csv ...] [--parameters NAME ...]\n\n"
    "Fits parameters of the scene, and the registration of each recording (base in tracker, sensor on tip), together.\n"
    "Prints estimates with standard errors, what the data do not determine, and errors with blocks left out.\n"
    "`--parameters none` registers only. Recordings of one set-up share a registration (--shared-registration); a known one is\n"
    "given by --registration FILE --fixed. `--list` prints the parameters of the scene and of a force sensor.\n\n";

struct Arguments {
  std::string scene, output, registration, residuals, model, stepping, samples = "all", loads = "ignore", rows;
  std::string node_parameters;  // the word of --parameters that is a YAML file: what the node is given
  std::vector<std::string> recordings, tables, parameters{"youngs_modulus_pa", "chamber_pitch_radius_m", "length_m"};
  std::vector<std::string> priors, bounds;
  int channels = 0;
  double position_mm = 0.5, rotation_deg = 1.0, tracker_delay = 0.0;
  CalibrationOptions fit;
  ForceSensorOptions force_sensor;
  RecordingReader reader;
  bool no_orientation = false, no_priors = false, list = false, quiet = false, shared = false, fixed = false;
};

po::options_description describe(Arguments& a) {
  po::options_description options = helpOption();
  a.force_sensor.addTo(options);
  a.reader.addOptionsTo(options, false);
  options.add_options()
    ("scene", po::value(&a.scene)->required(), "scene file; its values are the start and the priors' means")
    ("recordings", po::value(&a.recordings)->composing(), "CSV recordings (or bags)")
    ("compliance-table", po::value(&a.tables)->composing(),
     "CSV of measured compliances: pressure_K_pa per chamber, c11_m_per_n to c33_m_per_n")
    ("parameters,p", po::value(&a.parameters)->multitoken(),
     "names of parameters to fit, or none; and the node's parameter file, NAME.yaml")
    ("list", po::bool_switch(&a.list), "print the parameters of scene and force sensor with priors and bounds, and exit")
    ("prior", po::value(&a.priors)->composing(), "NAME=MEAN:SIGMA, in the parameter's unit")
    ("bounds", po::value(&a.bounds)->composing(), "NAME=LOW:HIGH, in the parameter's unit")
    ("no-priors", po::bool_switch(&a.no_priors), "let the data decide alone, within the bounds")
    ("samples", po::value(&a.samples)->default_value(a.samples), "all, or quasi_static")
    ("loads", po::value(&a.loads)->default_value(a.loads),
     "samples under contact: ignore; predict (with the force sensor's wrench, not fitted); or fit")
    ("tracker-delay-s", po::value(&a.tracker_delay)->default_value(0.0),
     "delay of the tracker relative to pressures and force sensor; register_recording --fit-delay finds it")
    ("channels", po::value(&a.channels), "pressure channels (default: those of the recording)")
    ("position-sigma-mm", po::value(&a.position_mm)->default_value(0.5), "first guess of model and tracker error")
    ("rotation-sigma-deg", po::value(&a.rotation_deg)->default_value(1.0), "the same")
    ("no-orientation", po::bool_switch(&a.no_orientation), "fit positions only")
    ("compliance-sigma", po::value(&a.fit.compliance_sigma)->default_value(0.05), "of measured compliances, relative")
    ("correlation-time-s", po::value(&a.fit.correlation_time)->default_value(1.0), "samples nearer than this share their error")
    ("huber", po::value(&a.fit.huber)->default_value(2.0), "residuals beyond this number of sigmas have linear weight")
    ("blocks", po::value(&a.fit.blocks)->default_value(8), "of each recording, left out in turn; 0: skip")
    ("output,o", po::value(&a.output), "write the calibrated scene here")
    ("registration", po::value(&a.registration), "write the first recording's registration here (the node loads it)")
    ("fixed", po::bool_switch(&a.fixed), "read --registration instead, with its delay, and hold it for all recordings")
    ("shared-registration", po::bool_switch(&a.shared), "the recordings are of one set-up: one registration for all of them")
    ("residuals", po::value(&a.residuals), "write a CSV of residuals here, for scripts/plot_calibration")
    ("rows", po::value(&a.rows), "write a CSV of the compliance tables' rows here, measured, fitted and left out")
    ("quiet,q", po::bool_switch(&a.quiet), "no progress display");
  addOption(options, kModel, a.model);
  addOption(options, kStepping, a.stepping);
  return options;
}

// Bounds beyond what a scene may have end there, and are said; at the usual one where that is no number that a scene may have.
void keepLegal(SceneParameter& p, const Range& usual) {
  const Range given{p.low, p.high};
  if (!p.legal.contains(p.low)) p.low = p.legal.low_open ? usual.low : p.legal.low;
  if (!p.legal.contains(p.high)) p.high = p.legal.high_open ? usual.high : p.legal.high;
  if (p.low != given.low || p.high != given.high)
    std::cerr << "--bounds " << p.name << ": a scene may have " << p.legal.text() << "; " << numberText(p.low / p.unit) << " to "
              << numberText(p.high / p.unit) << " is used\n";
}

// "NAME=A:B" of one of the parameters, in its unit.
void readPair(const std::string& text, const std::string& option, std::vector<SceneParameter>& parameters,
              FaultList& faults, double SceneParameter::*first, double SceneParameter::*second) {
  const size_t equals = std::min(text.find('='), text.size());
  const auto numbers = numberList(equals < text.size() ? text.substr(equals + 1) : "", ':');
  const auto parameter = std::find_if(parameters.begin(), parameters.end(), [&](const SceneParameter& known) {
    return known.name == text.substr(0, equals);
  });
  if (!numbers || numbers->size() != 2) {
    faults.add("--" + option + " " + text + ": must be NAME=NUMBER:NUMBER");
  } else if (parameter == parameters.end()) {
    faults.add("--" + option + " " + text + ": '" + text.substr(0, equals) + "' is not among --parameters");
  } else {
    const Range usual{parameter->low, parameter->high};
    (*parameter).*first = (*numbers)[0] * parameter->unit;
    (*parameter).*second = (*numbers)[1] * parameter->unit;
    if (option == "prior" && !(parameter->prior_sigma > 0.0)) faults.add("--prior " + text + ": SIGMA must be > 0");
    if (option == "bounds" && !(parameter->low < parameter->high))
      faults.add("--bounds " + text + ": LOW must be below HIGH");
    else if (option == "bounds") keepLegal(*parameter, usual);
  }
}

std::optional<LoadedSamples> loadsNamed(const std::string& name) {
  if (name == "ignore") return LoadedSamples::kIgnore;
  if (name == "predict") return LoadedSamples::kPredict;
  if (name == "fit") return LoadedSamples::kFit;
  return std::nullopt;
}

ChannelMap channelsFor(const Arguments& a, const std::vector<CalibrationRecording>& recordings, const Scene& scene) {
  if (a.channels > 0) return a.reader.channels(a.channels, scene);
  return a.reader.channels(recordings.empty() ? scene.chamberCount() : recordings.front().recording.channelCount(), scene);
}

// Takes the names of YAML files out of --parameters; without other names the default ones are fitted.
void splitParameters(Arguments& a, FaultList& faults) {
  const auto is_file = [](const std::string& word) {
    const std::string extension = std::filesystem::path(word).extension().string();
    return extension == ".yaml" || extension == ".yml";
  };
  std::vector<std::string> names;
  for (const std::string& word : a.parameters) {
    if (!is_file(word)) names.push_back(word);
    else if (a.node_parameters.empty()) a.node_parameters = word;
    else faults.add("--parameters " + word + ": one file of the node's parameters at most");
  }
  a.parameters = names.empty() ? Arguments().parameters : names;
}

// Does what writes an output file, unless there is none to be written. What fails is said, so that the others are still written.
bool written(const std::string& path, const std::function<void()>& write) {
  try {
    if (!path.empty()) write();
    return true;
  } catch (const std::exception& error) {
    std::cerr << "calibrate: " << error.what() << "\n";
    return false;
  }
}

// Reads a file again that has just been written; what is no regular file (a pipe, /dev/stdout) cannot be.
template <class Read>
void readAgain(const std::string& path, const Read& read) {
  if (std::filesystem::is_regular_file(path)) read(path);
}

// Finds what the tracker of a recording measures. Of poses that are misread the positions alone are used; adds what is wrong.
void judgeOrientations(const Scene& scene, const ChannelMap& channels, const ModelOptions& model, CalibrationRecording& data,
                       std::string& misread) {
  const PosePairs pairs = posePairs(scene, channels, data, model);
  if (pairs.X_BT.size() < 3) return;
  const OrientationCheck check = checkOrientations(pairs.X_BT, pairs.X_AS, data.recording.measures);
  data.recording.measures = check.wrong() ? TrackerMeasures::kPosition : check.measures;
  if (check.wrong()) misread += "\nNOT determined: " + data.recording.name + ": " + check.text() + "; positions only are used\n";
  else if (!check.text().empty()) std::cerr << data.recording.name << ": " << check.text() << "\n";
}

int run(Arguments& a, const po::variables_map& given, const std::string& command) {
  const Scene scene = loadSceneWithDoubts(a.scene);
  FaultList faults("options");
  splitParameters(a, faults);
  a.reader.configure(given, a.node_parameters);
  CalibrationOptions options = a.fit;
  options.model = namedModelOptions(a.model, a.stepping, faults);
  if (a.stepping.empty() && options.model.stepping == Stepping::kFixedStep)
    options.model.stepping = Stepping::kContinuous;
  const SampleChoice samples = sampleChoice(a.samples, faults);
  faults.check("position-sigma-mm", a.position_mm, Range::positive());
  faults.check("rotation-sigma-deg", a.rotation_deg, Range::positive());
  faults.check("compliance-sigma", options.compliance_sigma, Range::positive());
  faults.check("correlation-time-s", options.correlation_time, Range::nonnegative());
  faults.check("huber", options.huber, Range::positive());
  faults.check("blocks", options.blocks, {0.0, 1000.0});
  const auto loads = loadsNamed(a.loads);
  if (!loads) faults.add("loads '" + a.loads + "': must be ignore, predict or fit");
  faults.check("tracker-delay-s", a.tracker_delay, {-Registration::kLargestDelay, Registration::kLargestDelay});
  if (a.recordings.empty() && a.tables.empty() && !a.list) faults.add("give recordings, or compliance tables, or both");
  if (a.fixed && a.registration.empty()) faults.add("--fixed needs --registration FILE, the registration to hold");
  faults.throwIfAny();
  options.shared_registration = a.shared;
  if (a.fixed) options.given = loadRegistrationFile(a.registration);
  if (a.fixed && given["tracker-delay-s"].defaulted()) a.tracker_delay = options.given->tracker_delay;
  options.position_sigma = 1e-3 * a.position_mm;
  options.rotation_sigma = a.no_orientation ? 0.0 : radians(a.rotation_deg);
  options.use_priors = !a.no_priors;
  options.force_sensor = a.force_sensor.mount();

  std::vector<CalibrationRecording> recordings;
  for (const std::string& path : a.recordings) {
    Recording recording = withTrackerDelay(a.reader.load(path, &scene), a.tracker_delay);
    if (*loads != LoadedSamples::kIgnore) {
      const ForceSensorMount mount = a.force_sensor.mountFor(recording.wrench_frame, a.reader.parameters().frames);
      if (!recordings.empty() && mount.in_base_axes != options.force_sensor.in_base_axes)
        throw ConfigurationError("recordings", {"wrenches are in base axes and in the sensor's: fit them one by one"});
      options.force_sensor = mount;
    }
    recordings.emplace_back(std::move(recording), samples, *loads);
  }
  const ChannelMap channels = channelsFor(a, recordings, scene);
  std::string misread;  // what is wrong with the orientations of recordings
  for (CalibrationRecording& data : recordings) judgeOrientations(scene, channels, options.model, data, misread);
  std::vector<SceneParameter> parameters;
  bool fits_sensor = false;
  const auto named = [&](const std::string& name) {
    const auto of_sensor = forceSensorParameter(name, options.force_sensor);
    fits_sensor = fits_sensor || of_sensor;
    if (of_sensor) return *of_sensor;
    if (name.compare(0, 6, "force_") != 0) return sceneParameter(name, scene, channels);
    std::string legal;
    for (const std::string& other : forceSensorParameterNames()) legal += (legal.empty() ? "" : ", ") + other;
    throw ConfigurationError("parameters", {"'" + name + "' is none of a force sensor: must be one of " + legal});
  };
  if (a.list) {
    std::vector<std::string> names = sceneParameterNames(scene, channels);
    for (const std::string& name : forceSensorParameterNames()) names.push_back(name);
    for (const std::string& name : names) {
      const SceneParameter p = named(name);
      std::cout << name << ": " << numberText(p.start / p.unit) << " +- " << numberText(p.prior_sigma / p.unit) << ", "
                << numberText(p.low / p.unit) << " to " << numberText(p.high / p.unit) << "\n";
    }
    return kExitOk;
  }
  if (!(a.parameters.size() == 1 && a.parameters[0] == "none"))
    for (const std::string& name : a.parameters) parameters.push_back(named(name));
  for (const std::string& text : a.priors)
    readPair(text, "prior", parameters, faults, &SceneParameter::prior_mean, &SceneParameter::prior_sigma);
  for (const std::string& text : a.bounds)
    readPair(text, "bounds", parameters, faults, &SceneParameter::low, &SceneParameter::high);
  if (fits_sensor && *loads != LoadedSamples::kFit)
    faults.add("parameters of the force sensor need samples under contact: give --loads fit");
  faults.throwIfAny();
  std::vector<ComplianceRow> rows;
  for (const std::string& path : a.tables)
    for (ComplianceRow& row : loadComplianceTable(path, scene.chamberCount())) rows.push_back(std::move(row));

  std::unique_ptr<ProgressBar> bar;
  std::string shown;
  if (!a.quiet)
    options.progress = [&](const std::string& stage, int done, int total) {
      if (stage != shown) bar = std::make_unique<ProgressBar>(stage, total);
      shown = stage;
      bar->update(done);
    };
  const CalibrationResult result = calibrate(scene, channels, parameters, recordings, rows, options);
  // First of all what was found, whatever becomes of the files.
  std::cout << reportText(result) << misread;
  if (fits_sensor) std::cout << "\nthe force sensor as found: " << ForceSensorOptions::text(result.force_sensor) << "\n";
  std::cout << std::flush;
  const std::string header = "Calibrated: " + command + "\n" + reportText(result) + misread;
  bool all_written = written(a.output, [&] {
    saveSceneFile(a.output, result.scene, header);
    readAgain(a.output, loadSceneFile);
  });
  all_written &= written(a.fixed || recordings.empty() ? "" : a.registration, [&] {
    Registration registration = result.recordings.front().registration;
    registration.tracker_delay = a.tracker_delay;
    parseRegistration(registrationText(registration, header), a.registration);
    saveRegistrationFile(a.registration, registration, header);
    readAgain(a.registration, loadRegistrationFile);
  });
  all_written &= written(a.residuals, [&] { writeTextFile("output", a.residuals, residualTable(result, recordings)); });
  all_written &= written(a.rows, [&] { writeTextFile("output", a.rows, complianceTableOf(result)); });
  if (!all_written) return kExitFailed;
  return result.converged && misread.empty() ? kExitOk : kExitPartly;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  const po::options_description options = describe(a);
  return runProgram({argv, argv + argc}, kHelp + kRecordingHelp, options, {{"scene", 1}, {"recordings", -1}},
                    [&](const po::variables_map& given) {
    std::string command = "calibrate";
    for (int k = 1; k < argc; ++k) command += std::string(" ") + argv[k];
    return run(a, given, command);
  });
}
