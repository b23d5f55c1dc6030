// estimate_wrench SCENE RECORDING --registration FILE > OUT.csv: external tip wrench over a recording, as the live
// estimator would have seen it, beside the force sensor where there is one; and what one update costs.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <locale>
#include <sstream>

#include "command_line.h"
#include "force_sensor_options.h"
#include "calibration/base_sensor.h"
#include "calibration/calibration.h"
#include "contact_score.h"
#include "estimation/tracker_delay.h"
#include "live_stiffness/estimation/tip_wrench_estimator.h"
#include "part_file.h"
#include "recording_help.h"
#include "recording_reader.h"
#include "scene_doubts.h"

namespace po = boost::program_options;
using namespace live_stiffness;

namespace {

const char* const kHelp =
    "estimate_wrench SCENE.yaml RECORDING.csv|.bag --registration FILE [--output OUT.csv] ...\n\n"
    "Writes, per sample: estimated wrench at the tip point T in base axes, its standard deviation, contact, innovation,\n"
    "stiffness scale, and the recorded force (base axes, acting on the robot) if there is one. How well the estimate\n"
    "follows that, and the cost of an update, on standard error.\n\n";

struct WrenchParameters {
  ModelOptions model;
  TipWrenchOptions contact;
  std::string model_name = kModel.standard, stepping_name = "continuous";
};

template <class Parameters, class Visit>
void forEachParameter(Parameters& parameters, Visit visit) {
  visit(kModel, parameters.model_name);
  visit(kStepping, parameters.stepping_name);
  ModelOptions::forEachParameter(parameters.model, visit);
  TipWrenchOptions::forEachParameter(parameters.contact, visit);
}

WrenchParameters wrenchParameters(const YAML::Node& values) {
  FaultList faults("options");
  ParameterReader read(values, faults);
  WrenchParameters parameters;
  forEachParameter(parameters, read);
  faults.checkAll(parameters.contact);
  parameters.contact.checkComponents(faults);
  parameters.model = namedModelOptions(parameters.model_name, parameters.stepping_name, faults, parameters.model);
  faults.checkAll(parameters.model);
  faults.throwIfAny();
  return parameters;
}

void writeHeader(std::ostream& out) {
  out << "time_s";
  for (const char* prefix : {"estimated", "deviation", "measured"})
    for (const char* name : {"force_x_n", "force_y_n", "force_z_n", "moment_x_nm", "moment_y_nm", "moment_z_nm"})
      out << ',' << prefix << '_' << name;
  out << ",contact,status,innovation_sigmas,stiffness_scale,stiffness_scale_deviation,model_error_m,iterations\n";
}

void writeRow(std::ostream& out, double time, const TipWrenchEstimator& estimator, const std::optional<Wrench>& measured) {
  const TipWrenchEstimate* e = estimator.estimate();
  out << time;
  const auto cell = [&](bool known, double value) {
    out << ',';
    if (known) out << value;
  };
  for (int k = 0; k < 6; ++k) cell(e != nullptr, e ? e->wrench[k] : 0.0);
  for (int k = 0; k < 6; ++k) cell(e != nullptr, e ? std::sqrt(std::max(0.0, e->covariance(k, k))) : 0.0);
  for (int k = 0; k < 6; ++k) cell(measured.has_value(), measured ? (*measured)[k] : 0.0);
  out << ',' << (e != nullptr && e->contact) << ',' << codeName(estimator.code());
  cell(e != nullptr, e ? e->innovation : 0.0);
  cell(e != nullptr, e ? e->stiffness_scale : 0.0);
  cell(e != nullptr, e ? e->stiffness_scale_deviation : 0.0);
  cell(e != nullptr, e ? linear(e->model_error).norm() : 0.0);
  cell(e != nullptr, e ? e->iterations : 0);
  out << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  std::string scene_path, registration_path, output, score_path;
  std::vector<std::string> recording_paths;
  ForceSensorOptions force_sensor;
  RecordingReader reader;
  po::options_description options = helpOption();
  options.add_options()
    ("scene", po::value(&scene_path)->required(), "scene of the recorded robot")
    ("recording", po::value(&recording_paths)->required(), "CSV recording, or the bags of one")
    ("registration", po::value(&registration_path)->required(), "registration file, as register_recording writes it")
    ("output,o", po::value(&output), "CSV file to write (standard output)")
    ("score", po::value(&score_path), "CSV file to write how well the estimate follows the recorded force: quantity,value");
  force_sensor.addTo(options);
  reader.addOptionsTo(options);
  reader.options().add<WrenchParameters>(options, [](auto& fields, auto visit) { forEachParameter(fields, visit); });
  return runProgram({argv, argv + argc}, kHelp + kRecordingHelp, options, {{"scene", 1}, {"recording", -1}},
                    [&](const po::variables_map& given) {
    reader.configure(given);
    const WrenchParameters parameters = wrenchParameters(reader.values());
    const Scene scene = loadSceneWithDoubts(scene_path);
    const Recording recorded = reader.load(recording_paths, &scene);
    const ForceSensorMount mount = force_sensor.mountFor(recorded.wrench_frame, reader.parameters().frames);
    const Registration registration = loadRegistrationFile(registration_path);
    const Recording recording = relativeToBase(withTrackerDelay(recorded, registration.tracker_delay));
    const ForceReadings readings(recording);
    const ChannelMap channels = reader.channels(recording, scene);
    const std::vector<Pressures> gauge = gaugePressures(recording);
    TipWrenchEstimator estimator(scene, parameters.model, parameters.contact);
    const TrackerMeasures measures = recording.measures.value_or(TrackerMeasures::kPose);
    estimator.setMeasures(measures);
    StiffnessWorkspace workspace = estimator.model().makeWorkspace();
    const Pose at_rest = estimator.model().solve(Pressures::Zero(scene.chamberCount()), Wrench::Zero(), workspace).X_BT;
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(6);
    writeHeader(out);
    std::vector<double> microseconds;
    std::vector<ContactSample> scored;
    for (size_t i = 0; i < recording.samples.size(); ++i) {
      const RecordedSample& sample = recording.samples[i];
      const Pose expected = estimator.estimate() != nullptr ? estimator.estimate()->X_BT : at_rest;
      const Pose X_BT = registration.tipPose(
          completedPose(sample.tipPose(), registration.sensorPose(expected), measures));
      const Pressures chambers = channels.expand(gauge[i]);
      const auto start = std::chrono::steady_clock::now();
      if (sample.unchanged_for > 0.0) estimator.predict(chambers, sample.time);  // nothing was measured
      else estimator.update(chambers, X_BT, sample.time);
      microseconds.push_back(1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      std::optional<Wrench> measured;
      if (sample.tip_wrench) measured = readings.atTip(mount, sample.time, X_BT.R);
      writeRow(out, sample.time, estimator, measured);
      const TipWrenchEstimate* estimate = estimator.estimate();
      if (!measured || estimate == nullptr) continue;
      const Matrix3 C = estimate->solution.compliance.topLeftCorner<3, 3>();
      scored.push_back({sample.time, linear(*measured), linear(estimate->wrench), 0.5 * (C + C.transpose()),
                        estimate->contact, mount.seen(X_BT.R)});
    }
    if (!output.empty()) writeTextFile("output", output, out.str());
    else std::cout << out.str();
    if (!scored.empty()) {
      const ContactScore score = contactScore(scored);
      std::cerr << score.text() << "\n";
      if (!score_path.empty()) writeTextFile("output", score_path, score.table());
    }
    const auto text = [&](double share) { return numberText(quantile(microseconds, share)); };
    std::cerr << "one update: median " << text(0.5) << " us, 99 % below " << text(0.99) << " us, slowest " << text(1.0)
              << " us (" << microseconds.size() << " samples)\n";
    return kExitOk;
  });
}
