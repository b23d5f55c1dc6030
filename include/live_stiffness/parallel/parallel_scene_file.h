#pragma once
// Scene files of parallel robots (YAML, kind: parallel), see config/scenes/stewart_gough.yaml. Keys carry their units.

#include <string>

#include "live_stiffness/parallel/parallel_scene.h"

namespace live_stiffness {

// Reads a parallel scene. Throws ConfigurationError with every fault found, as loadSceneFile() does.
ParallelScene loadParallelSceneFile(const std::string& path);

// The same from text; `name` stands for the path in messages.
ParallelScene parseParallelScene(const std::string& yaml, const std::string& name);

}  // namespace live_stiffness
