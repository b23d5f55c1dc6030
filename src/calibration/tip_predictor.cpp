#include "calibration/tip_predictor.h"

#include <ceres/jet.h>

#include <Eigen/LU>
#include <algorithm>

#include "calibration/rod_sensitivities.h"
#include "live_stiffness/checks.h"
#include "estimation/creep.h"
#include "rod/statics.h"
#include "section/load_stepping_code.h"

namespace live_stiffness {
namespace {

using Jet = ceres::Jet<double, kSeeds>;

template <class T>
const ParametricBody<T>& firstSegment(const ParametricScene<T>& scene) {
  return *std::find_if(scene.chain.begin(), scene.chain.end(), [](const auto& body) { return body.is_segment; });
}

// Effective channel pressures after creep, one vector per sample. The first segment's creep holds for all.
template <class T>
std::vector<Eigen::Matrix<T, Eigen::Dynamic, 1>> creptPressures(const ParametricScene<T>& scene,
                                                                const std::vector<ActuationSample>& samples) {
  const MaterialOf<T>& material = firstSegment(scene).section.material;
  CreepFilterOf<T> filter(material.creep_share, material.creep_time);
  std::vector<Eigen::Matrix<T, Eigen::Dynamic, 1>> pressures;
  pressures.reserve(samples.size());
  double last = samples.empty() ? 0.0 : samples.front().time;
  for (const ActuationSample& sample : samples) {
    pressures.push_back(filter.update(sample.channels, sample.time - last));
    last = sample.time;
  }
  return pressures;
}

template <class T>
Eigen::Matrix<T, Eigen::Dynamic, 1> expand(const ChannelMap& map, const Eigen::Matrix<T, Eigen::Dynamic, 1>& channels) {
  Eigen::Matrix<T, Eigen::Dynamic, 1> chambers(map.chamberCount());
  for (int k = 0; k < map.chamberCount(); ++k) chambers[k] = channels[map.channelOfChamber()[k]];
  return chambers;
}

// Derivatives by up to kSeededParameters parameters from `first` on; more parameters take more of these.
class Differentiator {
 public:
  Differentiator(const Scene& scene, const ModelOptions& options, const ChannelMap& channels,
                 const std::vector<SceneParameter>& parameters, const Eigen::VectorXd& values, int first,
                 const std::vector<ActuationSample>& samples)
      : options_(options),
        channels_(channels),
        scene_(castScene<Jet>(scene)),
        first_(first),
        count_(std::min<int>(kSeededParameters, static_cast<int>(parameters.size()) - first)) {
    for (int k = 0; k < static_cast<int>(parameters.size()); ++k) {
      Jet value(values[k]);
      if (k >= first && k < first + count_) value.v[3 + k - first] = 1.0;
      setParameter(scene_, parameters[k], value);
    }
    for (const ParametricBody<Jet>& body : scene_.chain)
      if (body.is_segment) steppers_.emplace_back(body.section);
    pressures_ = creptPressures(scene_, samples);
    if (!options.external_loads) scene_.gravity.setZero();
  }

  void differentiate(size_t i, const Vector3& base_moment, const Wrench& tip_wrench, TipPrediction& prediction) {
    const auto chambers = expand(channels_, pressures_[i]);
    double largest = 0.0;
    for (int k = 0; k < chambers.size(); ++k) largest = std::max(largest, std::abs(chambers[k].a));
    const int steps = stepCount(largest, options_.pressure_step);
    rest_.clear();
    Eigen::Index at = 0;
    for (const LoadStepperOf<Jet>& stepper : steppers_) {
      rest_.push_back(stepper.restState(chambers.segment(at, stepper.chamberCount()), options_.stepping, steps));
      at += stepper.chamberCount();
    }
    const TipSensitivities columns = tipSensitivities(scene_, rest_, base_moment, tip_wrench);
    const Matrix3 inverse = columns.residual.leftCols<3>().inverse();
    const SeedColumns d_moment = -inverse * columns.residual;  // of the base moment that keeps the residual at zero
    const SeedColumns position = columns.position + columns.position.leftCols<3>() * d_moment;
    const SeedColumns turn = columns.turn + columns.turn.leftCols<3>() * d_moment;
    prediction.derivative.block(0, first_, 3, count_) = position.middleCols(3, count_);
    prediction.derivative.block(3, first_, 3, count_) = turn.middleCols(3, count_);
  }

 private:
  const ModelOptions& options_;
  const ChannelMap& channels_;
  ParametricScene<Jet> scene_;
  int first_, count_;
  std::vector<LoadStepperOf<Jet>> steppers_;
  std::vector<Eigen::Matrix<Jet, Eigen::Dynamic, 1>> pressures_;
  std::vector<RestStateOf<Jet>> rest_;
};

}  // namespace

TipPredictor::TipPredictor(Scene scene, ModelOptions options, ChannelMap channels,
                           std::vector<SceneParameter> parameters)
    : scene_(std::move(scene)), options_(options), channels_(std::move(channels)), parameters_(std::move(parameters)) {
  if (channels_.chamberCount() != scene_.chamberCount())
    throw ConfigurationError("channel map", {"feeds " + std::to_string(channels_.chamberCount()) + " chambers: must be the "
                                             "scene's " + std::to_string(scene_.chamberCount())});
}

bool TipPredictor::predict(const Eigen::VectorXd& values, const std::vector<ActuationSample>& samples,
                           bool derivatives, std::vector<TipPrediction>& predictions) {
  const Scene scene = withParameters(scene_, parameters_, values);
  const StiffnessModel model(scene, options_);
  StiffnessWorkspace workspace = model.makeWorkspace();
  const auto pressures = creptPressures(castScene<double>(scene), samples);
  const int parameter_count = static_cast<int>(parameters_.size());
  std::vector<Differentiator> differentiators;
  for (int first = 0; derivatives && first < parameter_count; first += kSeededParameters)
    differentiators.emplace_back(scene_, options_, channels_, parameters_, values, first, samples);
  predictions.resize(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!samples[i].wanted) continue;
    const StiffnessSolution solution = model.solve(expand(channels_, pressures[i]), samples[i].tip_wrench, workspace);
    if (!solution.status.ok()) {
      failure_ = "sample at " + numberText(samples[i].time) + " s: " + model.describe(solution.status);
      return false;
    }
    predictions[i].X_BT = solution.X_BT;
    predictions[i].compliance = options_.external_loads ? solution.compliance : Matrix6(Matrix6::Zero());
    if (!derivatives) continue;
    predictions[i].derivative.resize(6, parameter_count);
    const Wrench tip_wrench = options_.external_loads ? samples[i].tip_wrench : Wrench::Zero();
    const DeadLoads loads{scene.gravity.value_or(Vector3::Zero()), tip_wrench};
    const Vector3 base_moment =
        workspace.loaded() ? workspace.statics().baseMoment(loads, workspace.backbone()) : Vector3::Zero();
    for (Differentiator& differentiator : differentiators)
      differentiator.differentiate(i, base_moment, tip_wrench, predictions[i]);
  }
  return true;
}

}  // namespace live_stiffness
