#include "yaml_map.h"

#include <cmath>
#include <map>

namespace live_stiffness {

std::string lineOf(const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? "" : " (line " + std::to_string(mark.line + 1) + ")";
}

YamlMap::YamlMap(const YAML::Node& node, std::string path, FaultList& faults)
    : node_(node), path_(std::move(path)), faults_(faults) {
  if (!node_.IsMap()) {
    fault("must be a mapping of keys to values");
    node_ = YAML::Node(YAML::NodeType::Map);
  }
}

YAML::Node YamlMap::child(const std::string& key) {
  asked_.insert(key);
  for (const auto& pair : node_)
    if (pair.first.IsScalar() && pair.first.Scalar() == key) return pair.second;
  return YAML::Node(YAML::NodeType::Undefined);
}

double YamlMap::readNumber(const YAML::Node& node, const std::string& name, const Range& range) {
  double value = std::nan("");
  const bool is_number = node.IsScalar() && YAML::convert<double>::decode(node, value);
  const std::string shown = node.IsScalar() ? node.Scalar() : node.IsNull() ? "nothing" : "a list or mapping";
  if (!is_number) faults_.add(name + " = " + shown + ": must be a number, " + range.text() + lineOf(node));
  else if (!range.contains(value)) faults_.add(name + " = " + shown + ": must be " + range.text() + lineOf(node));
  else return value;
  return std::nan("");
}

double YamlMap::number(const std::string& key, const Range& range, std::optional<double> default_value) {
  const YAML::Node node = child(key);
  if (node.IsDefined()) return readNumber(node, name(key), range);
  if (default_value) return *default_value;
  faults_.add(name(key) + " is missing: must be a number, " + range.text() + lineOf(node_));
  return std::nan("");
}

std::vector<double> YamlMap::numbers(const std::string& key, int size) {
  const std::string kind =
      size < 0 ? "a list of finite numbers" : "a list of " + std::to_string(size) + " finite numbers";
  const YAML::Node node = child(key);
  if (!node.IsDefined()) {
    faults_.add(name(key) + " is missing: must be " + kind + lineOf(node_));
    return {};
  }
  if (!node.IsSequence() || (size >= 0 && node.size() != static_cast<size_t>(size))) {
    const std::string shown = node.IsSequence() ? std::to_string(node.size()) + " entries" : "not a list";
    faults_.add(name(key) + " is " + shown + ": must be " + kind + lineOf(node));
    return {};
  }
  std::vector<double> values;
  for (size_t i = 0; i < node.size(); ++i)
    values.push_back(readNumber(node[i], name(key) + "[" + std::to_string(i) + "]", Range::finite()));
  return values;
}

Vector3 YamlMap::vector(const std::string& key) {
  const std::vector<double> values = numbers(key, 3);
  return values.size() == 3 ? Vector3(values[0], values[1], values[2]) : Vector3(Vector3::Zero());
}

std::string YamlMap::text(const std::string& key, const std::string& default_value) {
  const YAML::Node node = child(key);
  if (!node.IsDefined()) return default_value;
  if (node.IsScalar() && !node.Scalar().empty()) return node.Scalar();
  faults_.add(name(key) + ": must be a non-empty text" + lineOf(node));
  return default_value;
}

void YamlMap::fault(const std::string& message) {
  faults_.add((path_.empty() ? std::string("the file") : path_) + ": " + message + lineOf(node_));
}

void YamlMap::fault(const std::string& key, const std::string& message) {
  const YAML::Node node = child(key);
  faults_.add(name(key) + ": " + message + lineOf(node.IsDefined() ? node : node_));
}

void YamlMap::finish() {
  std::map<std::string, int> seen;
  std::string known;
  for (const std::string& key : asked_) known += (known.empty() ? "" : ", ") + key;
  for (const auto& pair : node_) {
    const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "(not a text)";
    if (++seen[key] == 2) faults_.add(name(key) + ": is given more than once" + lineOf(pair.first));
    if (asked_.count(key) == 0)
      faults_.add(name(key) + ": unknown key; known here: " + known + lineOf(pair.first));
  }
}

void readDocument(const std::string& yaml, FaultList& faults, const std::function<void(YamlMap&)>& read) {
  try {
    YamlMap map(YAML::Load(yaml), "", faults);
    read(map);
  } catch (const YAML::Exception& error) {
    const std::string line = error.mark.is_null() ? "" : " (line " + std::to_string(error.mark.line + 1) + ")";
    faults.add("not YAML: " + error.msg + line);
  }
}

bool isOfKind(YamlMap& map, const std::string& kind, const std::string& wanted, FaultList& faults) {
  const std::string found = map.text("kind", "serial");
  if (found == kind) return true;
  const bool exists = found == "serial" || found == "parallel";
  faults.add("kind = " + found + ": must be " + kind + " here, " + wanted +
             (!exists ? "" : found == "parallel" ? "; parallel_node and parallel_solve read parallel scenes"
                                                 : "; stiffness_node and stiffness_solve read serial scenes"));
  return false;
}

}  // namespace live_stiffness
