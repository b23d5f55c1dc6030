#pragma once
// Reads recordings for programs: CSV, and bags if the program was built with ROS. What the messages mean is told by the
// parameters of the node.

#include <boost/program_options.hpp>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "csv_table.h"
#include "estimation/input_parameters.h"
#include "estimation/measures_finder.h"
#include "estimation/pressure_levels.h"
#include "input_options.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/estimation/recording.h"
#include "live_stiffness/rod/scene.h"
#include "live_stiffness/section/channel_map.h"
#ifdef LIVE_STIFFNESS_WITH_BAGS
#include "bag_topics_options.h"
#include "bags/recorded_bag.h"
#endif

namespace live_stiffness {

class RecordingReader {
 public:
  // takes_file: --parameters is a file with the parameters of the node.
  void addOptionsTo(boost::program_options::options_description& options, bool takes_file = true) {
    if (takes_file) options_.addFile(options);
    options_.add<InputParameters>(
        options, [](auto& parameters, auto visit) { InputParameters::forEachParameter(parameters, visit); });
#ifdef LIVE_STIFFNESS_WITH_BAGS
    addOptions(options, topics_);
#endif
  }
  // Options of parameters that the program has besides, which values() then has.
  InputOptions& options() { return options_; }
  // To be called first. file: of parameters; empty: none. Throws ConfigurationError with every fault.
  void configure(const boost::program_options::variables_map& given, const std::string& file) {
    given_ = given;
    values_ = options_.values(given, file);
    FaultList faults("options");
    ParameterReader read(values_, faults);
    InputParameters::forEachParameter(parameters_, read);
    faults.checkAll(parameters_);
    parameters_.check(0, faults);
    faults.throwIfAny();
  }
  void configure(const boost::program_options::variables_map& given) { configure(given, InputOptions::file(given)); }
  const YAML::Node& values() const { return values_; }  // all that was given

  // A recording: a CSV file, a bag, or several bags, as a list or with commas between. scene: of the robot, for what is
  // plausible. Prints the recording's warnings on standard error. Throws ConfigurationError if it cannot be read.
  Recording load(const std::string& path, const Scene* scene = nullptr) const {
    const bool is_list = !std::filesystem::exists(path) && path.find(',') != std::string::npos;
    return load(is_list ? splitText(path, ',') : std::vector<std::string>{path}, scene);
  }
  Recording load(const std::vector<std::string>& paths, const Scene* scene) const {
    Recording recording = read(paths, scene);
    if (!parameters_.tracker_measures.empty()) recording.measures = trackerMeasuresNamed(parameters_.tracker_measures);
    else if (!recording.measures) findMeasures(recording);
    for (const std::string& warning : recording.warnings) std::cerr << recording.name << ": " << warning << '\n';
    return recording;
  }
  const InputParameters& parameters() const { return parameters_; }
  // Which of its channels feeds which chamber: as the parameters say, else one each, or equal groups of neighbours that are in
  // one segment. Throws ConfigurationError if that does not fit.
  ChannelMap channels(const Recording& recording, const Scene& scene) const { return channels(recording.channelCount(), scene); }
  ChannelMap channels(int count, const Scene& scene) const {
    const std::string fault = std::to_string(count) + " channels for " + std::to_string(scene.chamberCount()) + " chambers: ";
    if (!parameters_.channel_of_chamber.empty()) {
      FaultList faults("options");
      parameters_.check(scene.chamberCount(), faults);
      faults.throwIfAny();
      const ChannelMap map(parameters_.channel_of_chamber);
      if (map.channelCount() > count)
        throw ConfigurationError("channel_of_chamber", {fault + "must be at least " + std::to_string(map.channelCount())});
      return map;
    }
    bool is_even = count > 0 && scene.chamberCount() >= count && scene.chamberCount() % count == 0;
    if (is_even)
      walk(scene, [&](int, const Segment& segment) {
        is_even = is_even && segment.section.chambers.count() % (scene.chamberCount() / count) == 0;
      }, [](const Link&) {});
    if (!is_even)
      throw ConfigurationError("channel_of_chamber", {fault + "say which feeds which, such as --channel-of-chamber 0 0 1 1 2 2"});
    return ChannelMap::even(count, scene.chamberCount());
  }

 private:
  static void findMeasures(Recording& recording) {
    MeasuresFinder finder;
    for (const RecordedSample& sample : recording.samples)
      if (sample.unchanged_for == 0.0) finder.add(sample.tipPose());
    recording.measures = finder.found();
    if (recording.measures)
      recording.warnings.push_back("the tracker measures " + trackerMeasuresName(*recording.measures) +
                                   " only, by its data; --tracker-measures pose if it does not");
  }
  Recording read(const std::vector<std::string>& paths, const Scene* scene) const {
    const std::string& path = paths.front();
#ifdef LIVE_STIFFNESS_WITH_BAGS
    if (isBag(path)) return loadRecordedBags(paths, topics_, parameters_, scene);
#else
    if (std::filesystem::path(path).extension() == ".bag")
      throw ConfigurationError("recording " + path, {"this build reads no bags: build it with ROS (-DWITH_ROS=ON)"});
#endif
    for (const char* option : {"pressure-unit", "pressure-reference", "atmospheric-pressure-pa", "position-unit"})
      if (given_.count(option) > 0)
        throw ConfigurationError("options", {std::string("--") + option + " is for bags: the columns of a CSV recording are " +
                                             "named with their unit, such as pressure_1_kpa and tip_x_mm"});
    if (paths.size() > 1) throw ConfigurationError("recording " + path, {"only bags can be parts of one recording"});
    return loadRecording(path, scene != nullptr ? std::optional(fullRange(*scene)) : std::nullopt);
  }

  InputOptions options_;
  boost::program_options::variables_map given_;
  YAML::Node values_;
  InputParameters parameters_;
#ifdef LIVE_STIFFNESS_WITH_BAGS
  BagTopics topics_;
#endif
};

}  // namespace live_stiffness
