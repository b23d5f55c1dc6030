#pragma once
// Writes scenes as YAML.

#include <string>

#include "live_stiffness/rod/scene.h"

namespace live_stiffness {

// Text that parseScene() reads back to the same scene (17 digits; Poisson's ratio becomes shear_modulus_pa). Each
// line of `comment` becomes a comment on top.
std::string sceneText(const Scene& scene, const std::string& comment = "");

// Writes it to a file, whole and only if it reads back; throws ConfigurationError with the reason otherwise.
void saveSceneFile(const std::string& path, const Scene& scene, const std::string& comment = "");

}  // namespace live_stiffness
