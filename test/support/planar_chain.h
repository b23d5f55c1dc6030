#pragma once
// Pose and material compliance of a chain of circular arcs in the xz plane, in long double and without a branch: the
// chord of an arc of angle 2h and length l is l sin(h) / h in the direction of its middle.

#include <cmath>
#include <vector>

#include "section/load_stepping.h"

namespace live_stiffness {

struct PlanarArc {
  long double length = 0.0L;     // stretched, m
  long double curvature = 0.0L;  // about y, towards +x, 1/m
  long double shear = 0.0L, elongation = 0.0L, bending = 0.0L;  // compliance per length; 0: rigid

  static PlanarArc of(const RestState& rest, double length) {
    return {static_cast<long double>(rest.stretch) * length, rest.curvature.y(), rest.c.shear_elongation(0, 0),
            rest.c.shear_elongation(2, 2), rest.c.bending_torsion(1, 1)};
  }
};

struct PlanarPose {
  long double x = 0.0L, z = 0.0L, angle = 0.0L;

  PlanarPose along(const PlanarArc& arc, long double s) const {
    const long double h = 0.5L * arc.curvature * s;
    const long double chord = h == 0.0L ? s : s * std::sin(h) / h;
    return {x + chord * std::sin(angle + h), z + chord * std::cos(angle + h), angle + 2.0L * h};
  }
};

// Entries of the tip's compliance for forces in the plane and the moment about y.
struct PlanarCompliance {
  long double xx = 0.0L, xz = 0.0L, zz = 0.0L, x_angle = 0.0L, z_angle = 0.0L, angle_angle = 0.0L;
};

class PlanarChain {
 public:
  explicit PlanarChain(std::vector<PlanarArc> arcs) : arcs_(std::move(arcs)) {}

  PlanarPose tip() const {
    PlanarPose pose;
    for (const PlanarArc& arc : arcs_) pose = pose.along(arc, arc.length);
    return pose;
  }

  // (10) about the tip by Boole's rule, 500 panels an arc: truncation below 1e-16 up to ten radians of bending.
  PlanarCompliance compliance() const {
    constexpr int kPanels = 500;
    constexpr long double kWeights[] = {14.0L, 32.0L, 12.0L, 32.0L};
    PlanarCompliance C;
    for (size_t k = 0; k < arcs_.size(); ++k) {
      const PlanarArc& arc = arcs_[k];
      PlanarPose start;
      for (size_t j = 0; j < k; ++j) start = start.along(arcs_[j], arcs_[j].length);
      const long double step = arc.length / (4 * kPanels);
      for (int i = 0; i <= 4 * kPanels; ++i) {
        const long double weight = (i == 0 || i == 4 * kPanels ? 7.0L : kWeights[i % 4]) * 2.0L * step / 45.0L;
        const long double s = i * step;
        PlanarPose r = {0.0L, 0.0L, start.angle + arc.curvature * s};  // from the section to the tip
        const long double sine = std::sin(r.angle), cosine = std::cos(r.angle);
        r = r.along(arc, arc.length - s);
        for (size_t j = k + 1; j < arcs_.size(); ++j) r = r.along(arcs_[j], arcs_[j].length);
        C.xx += weight * (arc.shear * cosine * cosine + arc.elongation * sine * sine + arc.bending * r.z * r.z);
        C.xz += weight * ((arc.elongation - arc.shear) * sine * cosine - arc.bending * r.x * r.z);
        C.zz += weight * (arc.shear * sine * sine + arc.elongation * cosine * cosine + arc.bending * r.x * r.x);
        C.x_angle += weight * arc.bending * r.z;
        C.z_angle -= weight * arc.bending * r.x;
        C.angle_angle += weight * arc.bending;
      }
    }
    return C;
  }

 private:
  std::vector<PlanarArc> arcs_;
};

}  // namespace live_stiffness
