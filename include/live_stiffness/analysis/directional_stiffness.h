#pragma once
// Stiffness along a line and about a line. What it is depends on what the other five directions may do: nothing holds
// them (free), or everything does (constrained). Constrained is never less than free.

#include "live_stiffness/conventions.h"

namespace live_stiffness {

// A line in space, in the axes of the matrix.
struct Line {
  Vector3 point = Vector3::Zero();           // on it, from the point that the matrix is about, m
  Vector3 direction = Vector3::UnitX();      // not zero; its length does not matter
};

// free:        a wrench acts along the line alone and the robot gives way as it likes; wrench over motion along it,
//              1 / (w^T C w). What a hand feels that pushes (or twists) and guides nothing.
// constrained: the robot moves along (or turns about) the line and in no other way; the part of the wrench that does
//              the work over the motion, t^T K t. What a rigid guide along the line would need.
// NaN-free for a positive definite matrix; a compliance of zero along the line gives infinity.
//
// Along a line: force at `point` over the displacement of `point`, N/m. The constrained one is the same for all
// parallel lines, since a body that does not turn moves everywhere alike.
double freeStiffnessAlong(const Matrix6& C, const Line& line);
double constrainedStiffnessAlong(const Matrix6& K, const Line& line);
// About a line: moment over rotation, N m/rad. The free one is the same for all parallel lines, since a pure moment has
// no place; constrained: a hinge along the line.
double freeStiffnessAbout(const Matrix6& C, const Line& line);
double constrainedStiffnessAbout(const Matrix6& K, const Line& line);

}  // namespace live_stiffness
