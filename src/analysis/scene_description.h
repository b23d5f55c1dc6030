#pragma once
#include <string>
#include <vector>
#include "live_stiffness/rod/scene.h"
namespace live_stiffness {
std::vector<std::string> doubtsAbout(const Scene& scene);
std::string describeScene(const Scene& scene);
}  // namespace live_stiffness
