#include "live_stiffness/analysis/directional_stiffness.h"

#include <Eigen/Geometry>

namespace live_stiffness {
namespace {

// [along; about]: the wrench of a unit force along the line. With its halves exchanged: the twist of a unit rotation about it.
Vector6 lineCoordinates(const Line& line) {
  const Vector3 direction = line.direction.normalized();
  return (Vector6() << direction, line.point.cross(direction)).finished();
}

}  // namespace

double freeStiffnessAlong(const Matrix6& C, const Line& line) {
  const Wrench w = lineCoordinates(line);
  return 1.0 / w.dot(C * w);
}

double constrainedStiffnessAlong(const Matrix6& K, const Line& line) {
  const Vector3 d = line.direction.normalized();
  return d.dot(K.topLeftCorner<3, 3>() * d);
}

double freeStiffnessAbout(const Matrix6& C, const Line& line) {
  const Vector3 d = line.direction.normalized();
  return 1.0 / d.dot(C.bottomRightCorner<3, 3>() * d);
}

double constrainedStiffnessAbout(const Matrix6& K, const Line& line) {
  const Vector6 coordinates = lineCoordinates(line);
  const Twist t = (Twist() << angular(coordinates), linear(coordinates)).finished();
  return t.dot(K * t);
}

}  // namespace live_stiffness
