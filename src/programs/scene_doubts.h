#pragma once
// Scenes of programs without a master.

#include <iostream>
#include <string>

#include "analysis/scene_description.h"
#include "live_stiffness/rod/scene_file.h"

namespace live_stiffness {

// loadSceneFile(), with what is doubtful in the scene as warnings on standard error.
inline Scene loadSceneWithDoubts(const std::string& path) {
  Scene scene = loadSceneFile(path);
  for (const std::string& doubt : doubtsAbout(scene)) std::cerr << "warning: scene " << path << ": " << doubt << '\n';
  return scene;
}

}  // namespace live_stiffness
