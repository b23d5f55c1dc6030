#pragma once
// Bounds of a calibration's parameters in Ceres. Ceres makes very small steps along a bound, so parameters at one are held.

#include <ceres/problem.h>

#include <vector>

#include "calibration/scene_parameter.h"

namespace live_stiffness {

// Adds x, in units of prior sigmas from the start, as a block of the problem with the parameters' bounds.
void addBoundedBlock(ceres::Problem& problem, Eigen::VectorXd& x, const std::vector<SceneParameter>& parameters);

// Holds these entries of x where they are, and frees the others.
void hold(ceres::Problem& problem, Eigen::VectorXd& x, const std::vector<int>& entries);

// Frees x; returns its entries that are at a bound beyond which the cost would fall.
std::vector<int> pressedAgainstBounds(ceres::Problem& problem, Eigen::VectorXd& x,
                                      const std::vector<SceneParameter>& parameters);

}  // namespace live_stiffness
