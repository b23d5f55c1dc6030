#pragma once
// Scene files (YAML), see config/scenes/ for commented examples. Keys carry their units.

#include <string>

#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

// Reads a scene. Throws ConfigurationError with every fault found (key, value, legal range, line): missing, unknown
// and repeated keys, values out of range, geometry that does not fit, malformed YAML, unreadable file.
Scene loadSceneFile(const std::string& path);

// The same from text; `name` stands for the path in messages.
Scene parseScene(const std::string& yaml, const std::string& name);

}  // namespace live_stiffness
