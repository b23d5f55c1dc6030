#include "estimation/scaled_model.h"

#include <cmath>


namespace live_stiffness {
namespace {

Scene withModuliTimes(Scene scene, double factor) {
  for (Body& body : scene.chain) {
    auto* segment = std::get_if<Segment>(&body);
    if (segment == nullptr) continue;
    segment->section.youngs_modulus *= factor;
    segment->section.shear_modulus *= factor;
  }
  return scene;
}

}  // namespace

ScaledModel::ScaledModel(Scene scene, const ModelOptions& options, bool with_derivative)
    : scene_(std::move(scene)), options_(options), with_derivative_(with_derivative) {
  rebuild(0.0);
}

void ScaledModel::rebuild(double log_scale) {
  scaled_ = std::make_unique<Solver>(withModuliTimes(scene_, std::exp(log_scale)), options_);
  if (with_derivative_)
    stiffer_ = std::make_unique<Solver>(withModuliTimes(scene_, std::exp(log_scale + kDifference)), options_);
  log_scale_ = log_scale;
}

void ScaledModel::setLogScale(double log_scale) {
  if (std::abs(log_scale - log_scale_) > kRebuildAfter) rebuild(log_scale);
}

StiffnessSolution ScaledModel::solve(PressuresRef pressures, const Wrench& tip_wrench) {
  return scaled_->model.solve(pressures, tip_wrench, scaled_->workspace);
}

Twist ScaledModel::derivative(PressuresRef pressures, const Wrench& tip_wrench, const Pose& X_BT) {
  if (!stiffer_) return Twist::Zero();
  const StiffnessSolution stiffer = stiffer_->model.solve(pressures, tip_wrench, stiffer_->workspace);
  if (!stiffer.status.ok()) return Twist::Zero();
  return residualTwist(stiffer.X_BT, X_BT) / kDifference;
}

}  // namespace live_stiffness
