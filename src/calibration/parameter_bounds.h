#pragma once
// Bounds of a calibration's parameters in Ceres, which creeps along them; so what has run into one is held there.

#include <ceres/problem.h>

#include <vector>

#include "calibration/scene_parameter.h"

namespace live_stiffness {

// Adds x, in units of prior sigmas from the start, as a block of the problem with the parameters' bounds.
void addBoundedBlock(ceres::Problem& problem, Eigen::VectorXd& x, const std::vector<SceneParameter>& parameters);

// Holds these entries of x where they are, and frees the others.
void hold(ceres::Problem& problem, Eigen::VectorXd& x, const std::vector<int>& entries);

// Frees x, and returns its entries at a bound of theirs, beyond which the cost would fall.
std::vector<int> pressedAgainstBounds(ceres::Problem& problem, Eigen::VectorXd& x,
                                      const std::vector<SceneParameter>& parameters);

}  // namespace live_stiffness
