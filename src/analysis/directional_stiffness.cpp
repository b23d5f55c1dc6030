#include "live_stiffness/analysis/directional_stiffness.h"

#include <Eigen/Geometry>

namespace live_stiffness {
namespace {

// [along; about]: the wrench of a unit force along the line. With its halves exchanged: the twist of a unit rotation about it.
Vector6 lineCoordinates(const Line& line) {
  const Vector3 direction = line.direction.normalized();
  Vector6 coordinates;
  coordinates << direction, line.point.cross(direction);
  return coordinates;
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
  Twist t;
  t << coordinates.tail<3>(), coordinates.head<3>();
  return t.dot(K * t);
}

}  // namespace live_stiffness
