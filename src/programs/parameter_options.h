#pragma once
// Options of programs that are parameters of the node: called like them with dashes, with their meaning. The default is
// what the field holds; ranges are checked with the field's struct.

#include <algorithm>
#include <boost/program_options.hpp>
#include <string>
#include <type_traits>

#include "live_stiffness/parameters.h"

namespace live_stiffness {

inline std::string optionName(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return key;
}

// A field that is no whole number is in SI, while the option has the unit of its key.
template <class Field>
void addOption(boost::program_options::options_description& options, const NumberParameter& parameter, Field& field) {
  auto* option = boost::program_options::value<Field>();
  if constexpr (std::is_floating_point_v<Field>) {
    const double unit = parameter.unit, value = field / unit;
    option->default_value(value, numberText(value))->notifier([&field, unit](double given) { field = given * unit; });
  } else {
    option->default_value(field)->notifier([&field](Field given) { field = given; });
  }
  options.add_options()(optionName(parameter.key).c_str(), option, parameter.meaning);
}

// An empty field is no default: the option then need not be among the choices.
inline void addOption(boost::program_options::options_description& options, const ChoiceParameter& parameter,
                      std::string& field) {
  auto* option = boost::program_options::value(&field);
  if (!field.empty()) option->default_value(field);
  const std::string meaning = parameter.meaning + (" One of " + parameter.text() + ".");
  options.add_options()(optionName(parameter.key).c_str(), option, meaning.c_str());
}

// Options for all parameters of a struct that has forEachParameter().
template <class Options>
void addOptions(boost::program_options::options_description& options, Options& fields) {
  Options::forEachParameter(fields, [&](const auto& parameter, auto& field) { addOption(options, parameter, field); });
}

}  // namespace live_stiffness
