#include "benchmark/methods/loaded_chain.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "live_stiffness/checks.h"

namespace live_stiffness {

LoadedChain::LoadedChain(const Scene& scene, const ModelOptions& options) : options_(options), length_(scene.length()) {
  const Vector3 gravity = scene.gravity.value_or(Vector3::Zero());
  for (const Body& body : scene.chain) {
    if (const auto* segment = std::get_if<Segment>(&body)) {
      sections_.push_back({LoadStepper(segment->section), segment->length, pieces_.size(), segment->mass() * gravity});
      pieces_.push_back(SoftPiece{});
      weight_ += sections_.back().weight;
    } else {
      const auto& link = std::get<Link>(body);
      const Vector3 along = link.length * Vector3::UnitZ();
      pieces_.push_back(RigidPiece{along, link.mass * gravity, 0.5 * along});
      weight_ += link.mass * gravity;
    }
  }
  if (sections_.empty()) throw ConfigurationError("benchmark scene", {"chain: must hold at least one segment"});
  pieces_.push_back(RigidPiece{scene.tip_offset, scene.tip_mass * gravity, scene.tip_offset});
  weight_ += scene.tip_mass * gravity;
}

bool LoadedChain::setPressures(PressuresRef pressures) {
  const int steps = stepCount(pressures.cwiseAbs().maxCoeff(), options_.pressure_step);
  int first = 0;
  for (const Section& section : sections_) {
    SoftPiece& piece = std::get<SoftPiece>(pieces_[section.piece]);
    const int count = section.stepper.chamberCount();
    piece.rest = section.stepper.restState(pressures.segment(first, count), options_.stepping, steps);
    if (!piece.rest.valid) return false;
    piece.length = piece.rest.stretch * section.length;
    piece.line_load = section.weight / piece.length;
    first += count;
  }
  return true;
}

Vector3 LoadedChain::unloadedBaseMoment() const {
  Vector3 moment = Vector3::Zero();
  Pose X;
  for (const auto& piece : pieces_) {
    if (const auto* soft = std::get_if<SoftPiece>(&piece)) {
      const Pose middle = X * expSe3(Vector3::UnitZ(), soft->rest.curvature, 0.5 * soft->length);
      moment += middle.p.cross(soft->length * soft->line_load);
      X = X * expSe3(Vector3::UnitZ(), soft->rest.curvature, soft->length);
    } else {
      const auto& rigid = std::get<RigidPiece>(piece);
      moment += (X * rigid.weight_at).cross(rigid.weight);
      X.p = X * rigid.offset;
    }
  }
  return moment;
}

double LoadedChain::softness() const {
  double softest = 0.0;
  for (const auto& piece : pieces_)
    if (const auto* soft = std::get_if<SoftPiece>(&piece))
      softest = std::max(softest, soft->rest.c.bending_torsion.diagonal().maxCoeff() * soft->length);
  return softest;
}

void carry(const RigidPiece& piece, RodState& state) {
  const Vector3 offset = state.X.R * piece.offset;
  state.n -= piece.weight;
  state.m -= offset.cross(state.n) + (state.X.R * piece.weight_at).cross(piece.weight);
  state.X.p += offset;
}

void carry(const RigidPiece& piece, const RodState& state, RodColumns& columns) {
  const Matrix3 offset_hat = hat(state.X.R * piece.offset);
  const Matrix3X6 moved = -offset_hat * columns.phi;  // phi x offset
  const Matrix3X6 weight_moved = -hat(state.X.R * piece.weight_at) * columns.phi;
  columns.p += moved;
  columns.m += hat(state.n - piece.weight) * moved + hat(piece.weight) * weight_moved;
  columns.m.rightCols<3>() -= offset_hat;
}

}  // namespace live_stiffness
