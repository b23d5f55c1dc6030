#pragma once
// A scene as the opponents of the benchmark see it: soft and rigid pieces from base to T under given pressures, and how
// a rigid piece carries the rod's state. The rod itself is what each opponent integrates in its own way.

#include <variant>
#include <vector>

#include "live_stiffness/compliance/model_options.h"
#include "live_stiffness/lie/se3.h"
#include "live_stiffness/rod/scene.h"
#include "section/load_stepping.h"

namespace live_stiffness {

// A segment after load stepping.
struct SoftPiece {
  RestState rest;
  double length = 0.0;                    // stretched, m
  Vector3 line_load = Vector3::Zero();    // weight per stretched length, N/m, base axes
};

// A link, or the tip offset with the tip mass at its end.
struct RigidPiece {
  Vector3 offset;     // from its start to its end, in its axes, m
  Vector3 weight;     // N, base axes
  Vector3 weight_at;  // where the weight acts, from its start, in its axes, m
};

// State of a section; n and m are what the part beyond exerts, base axes.
struct RodState {
  Pose X;
  Vector3 n = Vector3::Zero();  // N
  Vector3 m = Vector3::Zero();  // N m
};

// Derivatives of a RodState with respect to [base moment, tip force]: rotation phi (R changes by hat(phi) R), position
// and moment. That of n is [0, I] all along, since the loads are dead.
struct RodColumns {
  Matrix3X6 phi = Matrix3X6::Zero();
  Matrix3X6 p = Matrix3X6::Zero();
  Matrix3X6 m = (Matrix3X6() << Matrix3::Identity(), Matrix3::Zero()).finished();
};

class LoadedChain {
 public:
  // Throws ConfigurationError for a scene without segments.
  explicit LoadedChain(const Scene& scene, const ModelOptions& options = {});

  // Load stepping as in the library (its LoadStepper). False if a section gets out of range.
  bool setPressures(PressuresRef pressures);

  const std::vector<std::variant<SoftPiece, RigidPiece>>& pieces() const { return pieces_; }
  int softCount() const { return static_cast<int>(sections_.size()); }
  const Vector3& weight() const { return weight_; }  // of everything, N, base axes
  double length() const { return length_; }          // unstretched, base to chain's end, m
  // Moment about the base that the weights exert on the shape without loads, N m: a first guess of the base moment.
  Vector3 unloadedBaseMoment() const;
  // Bending per moment of the softest segment, rad/(N m): turns a residual moment into an angle.
  double softness() const;

 private:
  struct Section {
    LoadStepper stepper;
    double length;  // unstretched, m
    size_t piece;
    Vector3 weight;  // of the whole segment, N
  };
  ModelOptions options_;
  std::vector<Section> sections_;
  std::vector<std::variant<SoftPiece, RigidPiece>> pieces_;
  Vector3 weight_ = Vector3::Zero();
  double length_;
};

// Carries the state over a rigid piece.
void carry(const RigidPiece& piece, RodState& state);
// The same with columns; `state` is that at the start.
void carry(const RigidPiece& piece, const RodState& state, RodColumns& columns);

}  // namespace live_stiffness
