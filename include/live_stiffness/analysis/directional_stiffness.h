#pragma once
// Stiffness along a line and about a line. It depends on the other five directions of motion: they are all free, or all
// constrained. The constrained stiffness is never less than the free one.

#include "live_stiffness/conventions.h"

namespace live_stiffness {

// A line in space, in the axes of the matrix.
struct Line {
  Vector3 point = Vector3::Zero();           // on it, from the point that the matrix is about, m
  Vector3 direction = Vector3::UnitX();      // not zero; its length does not matter
};

// free:        the wrench acts along the line only, and the robot may move in every way: wrench divided by motion along
//              the line, 1 / (w^T C w). This is what a hand feels that pushes (or twists) without guiding.
// constrained: the robot can only move along (or turn about) the line: the component of the wrench along the line divided
//              by the motion, t^T K t. This is what a drive needs on a rigid guide along the line.
// Never NaN for a positive definite matrix; a compliance of zero along the line gives infinity.
//
// Along a line: force at `point` over the displacement of `point`, N/m. The constrained one is the same for all
// parallel lines, since all points of a body that does not turn have the same displacement.
double freeStiffnessAlong(const Matrix6& C, const Line& line);
double constrainedStiffnessAlong(const Matrix6& K, const Line& line);
// About a line: moment over rotation, N m/rad. The free one is the same for all parallel lines, since a pure moment has
// no point of action; constrained: a hinge along the line.
double freeStiffnessAbout(const Matrix6& C, const Line& line);
double constrainedStiffnessAbout(const Matrix6& K, const Line& line);

}  // namespace live_stiffness
