#include "yaml_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "csv_table.h"

namespace live_stiffness {
namespace {

// Positions in the text of all that aliases in `node` stand for. last: position of the node read before. A node of the text
// comes after that; an alias has the position of its anchor, which was read already.
void findAliased(const YAML::Node& node, int& last, std::vector<int>& aliased) {
  if (node.IsNull()) return;  // has no position of its own
  const int position = node.Mark().pos;
  if (position <= last) {
    aliased.push_back(position);
    return;
  }
  last = position;
  if (node.IsSequence())
    for (const YAML::Node& entry : node) findAliased(entry, last, aliased);
  if (!node.IsMap()) return;
  for (const auto& pair : node) {
    last = std::max(last, pair.first.Mark().pos);
    findAliased(pair.second, last, aliased);
  }
}

// Keys of a document that hold what an alias stands for: they may have any name.
std::vector<std::string> keysOfAnchors(const YAML::Node& document) {
  std::vector<std::string> keys;
  if (!document.IsMap()) return keys;
  std::vector<int> aliased;
  int last = -1;
  findAliased(document, last, aliased);
  for (auto pair = document.begin(); pair != document.end();) {
    const YAML::Node key = pair->first;
    const int begin = key.Mark().pos, end = ++pair == document.end() ? std::numeric_limits<int>::max() : pair->first.Mark().pos;
    const auto is_here = [&](int position) { return position > begin && position < end; };
    if (key.IsScalar() && std::any_of(aliased.begin(), aliased.end(), is_here)) keys.push_back(key.Scalar());
  }
  return keys;
}

}  // namespace

std::string lineOf(const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? "" : " (line " + std::to_string(mark.line + 1) + ")";
}

YamlMap::YamlMap(const YAML::Node& node, std::string path, FaultList& faults)
    : node_(node), path_(std::move(path)), faults_(faults) {
  if (!node_.IsMap()) {
    fault("must be a mapping of keys to values");
    return;
  }
  std::vector<YAML::Node> taken;
  take(node_, taken);
}

void YamlMap::take(const YAML::Node& mapping, std::vector<YAML::Node>& taken) {
  // Its keys are there already; also, an alias may stand for what it is part of.
  if (std::any_of(taken.begin(), taken.end(), [&](const YAML::Node& other) { return other.is(mapping); })) return;
  taken.push_back(mapping);
  std::set<std::string> own;
  std::vector<YAML::Node> merged;
  for (const auto& pair : mapping) {
    const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "(not a text)";
    const bool repeated = !own.insert(key).second;
    if (repeated) entries_.push_back({key, pair.first, pair.second, true});
    else if (key == "<<") merged.push_back(pair.second);
    else if (keys_.insert(key).second) entries_.push_back({key, pair.first, pair.second, false});
  }
  for (const YAML::Node& source : merged) {
    const bool is_list = source.IsSequence();
    for (size_t i = 0; i < (is_list ? source.size() : 1); ++i) {
      const YAML::Node from = is_list ? source[i] : source;
      if (from.IsMap()) take(from, taken);
      else fault("<< must be a mapping, or a list of mappings, whose keys are taken over");
    }
  }
}

YAML::Node YamlMap::child(const std::string& key) {
  asked_.insert(key);
  for (const Entry& entry : entries_)
    if (entry.key == key) return entry.value;
  return YAML::Node(YAML::NodeType::Undefined);
}

double YamlMap::readNumber(const YAML::Node& node, const std::string& name, const Range& range) {
  const std::string shown = node.IsScalar() ? node.Scalar() : node.IsNull() ? "nothing" : "a list or mapping";
  const double value = node.IsScalar() ? finiteNumber(shown).value_or(std::nan("")) : std::nan("");
  const bool is_number = !std::isnan(value);
  if (is_number && range.contains(value)) return value;
  faults_.add(name + " = " + shown + ": must be " + (is_number ? "" : "a number, ") + range.text() +
              (is_number ? "" : numberHint(shown)) + lineOf(node));
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
  std::string known;
  for (const std::string& key : asked_) known += (known.empty() ? "" : ", ") + key;
  for (const Entry& entry : entries_) {
    if (entry.repeated) faults_.add(name(entry.key) + ": is given more than once" + lineOf(entry.key_node));
    else if (asked_.count(entry.key) == 0)
      faults_.add(name(entry.key) + ": unknown key; known here: " + known + lineOf(entry.key_node));
  }
}

void readDocument(const std::string& yaml, FaultList& faults, const std::function<void(YamlMap&)>& read) {
  try {
    const YAML::Node document = YAML::Load(yaml);
    YamlMap map(document, "", faults);
    for (const std::string& key : keysOfAnchors(document)) map.child(key);
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
