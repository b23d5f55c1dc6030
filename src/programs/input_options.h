#pragma once
// Command line options that are parameters of the node, over those of a parameter file.

#include <yaml-cpp/yaml.h>

#include <boost/program_options.hpp>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "parameter_options.h"
#include "parameter_reader.h"

namespace live_stiffness {

class InputOptions {
 public:
  // Of all parameters of a struct that has forEachParameter(). Options are called like the keys with dashes, and hold texts,
  // which are read just as the parameters are.
  template <class Parameters, class ForEach>
  void add(boost::program_options::options_description& options, ForEach for_each) {
    Parameters standard;
    for_each(standard, [&](const auto& parameter, auto&) { add(options, parameter); });
  }
  template <class Parameter>
  void add(boost::program_options::options_description& options, const Parameter& parameter) {
    constexpr bool is_list = std::is_same_v<Parameter, NumbersParameter> || std::is_same_v<Parameter, TextsParameter>;
    const std::string name = nameOf(parameter.key), standard = standardText(parameter);
    options_[name] = {parameter.key, is_list};
    const std::string text = parameter.meaning + (standard.empty() ? "" : " Default: " + standard + ".");
    auto* words = boost::program_options::value<std::vector<std::string>>();
    options.add_options()(name.c_str(), is_list ? words->multitoken() : words, text.c_str());
  }
  // Also takes what the node was given, from a file.
  void addFile(boost::program_options::options_description& options) {
    options.add_options()("parameters", boost::program_options::value<std::string>(),
                          "parameters of stiffness_node, as rosparam dump writes them; the options below go before");
  }

  // The parameters in the file (empty: none), with those options that were given in their place.
  YAML::Node values(const boost::program_options::variables_map& given, const std::string& file) const {
    YAML::Node values = file.empty() ? YAML::Node(YAML::NodeType::Map) : loadParameterFile(file);
    for (const auto& [name, option] : options_) {
      if (given.count(name) == 0) continue;
      const auto& words = given[name].as<std::vector<std::string>>();
      const bool is_text = words.size() == 1 && (!option.is_list || words.front().compare(0, 1, "[") == 0);
      values[option.key] = is_text ? YAML::Node(words.front()) : YAML::Node(words);
    }
    return values;
  }
  static std::string file(const boost::program_options::variables_map& given) {
    return given.count("parameters") > 0 ? given["parameters"].as<std::string>() : "";
  }

 private:
  // Shorter where the program has but one of the kind, and no Aurora.
  static std::string nameOf(const std::string& key) {
    if (key == kPositionUnit.key) return "position-unit";
    if (key == kSceneFile.key) return "scene";
    if (key == kRegistrationFile.key) return "registration";
    return optionName(key);
  }

  static std::string standardText(const NumberParameter& parameter) { return numberText(parameter.standard); }
  static std::string standardText(const BooleanParameter& parameter) { return parameter.standard ? "true" : "false"; }
  static std::string standardText(const ChoiceParameter& parameter) { return parameter.standard; }
  static std::string standardText(const TextParameter& parameter) { return parameter.standard; }
  static std::string standardText(const TextsParameter&) { return ""; }
  static std::string standardText(const NumbersParameter& parameter) {
    std::string text;
    for (double number : parameter.standard) text += (text.empty() ? "" : " ") + numberText(number);
    return text;
  }

  struct Option {
    std::string key;
    bool is_list = false;
  };
  std::map<std::string, Option> options_;  // by name
};

}  // namespace live_stiffness
