#pragma once
// A YAML mapping whose every key must be asked for: reads values, collects faults, reports keys nobody asked for. Numbers
// have a decimal point whatever the locale of the process. `<<` takes over the keys of another mapping, or of a list of
// them, that are not there yet (YAML's merge key).

#include <yaml-cpp/yaml.h>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "live_stiffness/checks.h"
#include "live_stiffness/conventions.h"

namespace live_stiffness {

// " (line N)" of a node, N counted from 1; empty when unknown.
std::string lineOf(const YAML::Node& node);

class YamlMap {
 public:
  // path: where the mapping stands, such as "chain[0].segment"; empty for the document itself.
  YamlMap(const YAML::Node& node, std::string path, FaultList& faults);

  // A number in `range`; a fault and NaN otherwise. A missing key takes the default, or is a fault without one.
  double number(const std::string& key, const Range& range, std::optional<double> default_value = std::nullopt);
  // A list of finite numbers, of exactly `size` entries unless size is negative. Empty after a fault.
  std::vector<double> numbers(const std::string& key, int size);
  // Three finite numbers; zero after a fault.
  Vector3 vector(const std::string& key);
  std::string text(const std::string& key, const std::string& default_value);
  YAML::Node child(const std::string& key);  // undefined node when missing
  bool has(const std::string& key) { return child(key).IsDefined(); }

  // Adds a fault about the mapping itself, or about one of its keys.
  void fault(const std::string& message);
  void fault(const std::string& key, const std::string& message);
  // Call when all keys have been asked for: unknown and repeated keys become faults.
  void finish();

 private:
  std::string name(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  double readNumber(const YAML::Node& node, const std::string& name, const Range& range);
  void take(const YAML::Node& mapping, std::vector<YAML::Node>& taken);

  struct Entry {
    std::string key;
    YAML::Node key_node, value;
    bool repeated;  // in the mapping where it stands
  };

  YAML::Node node_;
  std::string path_;
  FaultList& faults_;
  std::vector<Entry> entries_;  // its own keys before those that << takes over
  std::set<std::string> keys_, asked_;
};

// Hands the first document of a text to `read`. A text that is not YAML becomes a fault. Keys of the document that hold what
// an alias stands for count as asked for.
void readDocument(const std::string& yaml, FaultList& faults, const std::function<void(YamlMap&)>& read);

// True if the key `kind` of a scene is the one that a loader reads: "serial" (also if missing) or "parallel". Else a
// fault, which says what this loader wants: then leave the other keys alone.
bool isOfKind(YamlMap& map, const std::string& kind, const std::string& wanted, FaultList& faults);

}  // namespace live_stiffness
