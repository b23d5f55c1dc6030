#include "live_stiffness/analysis/generalised_compliance.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "live_stiffness/checks.h"
#include "rod/backbone.h"

namespace live_stiffness {
namespace {

constexpr double kColumnGoal = 1e-14;
// Pieces are short enough for elements of the most stages to be exact to rounding, both where the rod bends and where
// the columns do.
constexpr double kPieceBending = 0.3;
constexpr int kMostPieces = 64;

// Parts of a step's columns.
template <class Columns>
auto rotation(const Columns& columns) { return columns.template topRows<3>(); }
template <class Columns>
auto moment(const Columns& columns) { return columns.template bottomRows<3>(); }

int pieceCount(const RodElement& element, int stages) {
  const ElementState& s = element.state;
  const double compliance = std::max({s.bend_xx, s.bend_yy, s.torsion});
  const double load = Vector3(s.n_start).norm() + std::abs(s.length) * Vector3(s.line_load).norm();
  const double waves = s.length * std::sqrt(compliance * load);
  const double turns = s.length * compliance * Vector3(s.m_start).norm();
  const double bending = std::max({element.bending(stages), waves, turns});
  return std::clamp(static_cast<int>(std::ceil(bending / kPieceBending)), 1, kMostPieces);
}

}  // namespace

// Walks from base to tip, in steps, and leaves a stop wherever one is asked for.
class GeneralisedCompliance::Walk {
 public:
  Walk(GeneralisedCompliance& result, const ElementKernel& kernel) : result_(result), kernel_(kernel) {}

  const Pose& X() const { return X_; }

  void stopFor(int place) { result_.stop_of_place_[place] = {X_, result_.steps_.size()}; }

  // Rigid piece; n: the force that turns with it, the mean of that before and after.
  void rigid(const Vector3& along, const Vector3& n) {
    Step step;
    const Matrix3 lever = hat(along), none = Matrix3::Zero(), one = Matrix3::Identity();
    step.of_rotation << one, -lever, -hat(n) * lever;
    step.of_moment << none, none, one;
    step.of_force << none, none, -lever;
    result_.steps_.push_back(step);
    X_.p += along;
  }

  // From one part of an element to another (0 to 1), from the state that the last piece left.
  void along(const RodElement& element, double from, double to, int pieces_of_element) {
    if (from == 0.0) {
      X_ = element.X_start();
      n_ = Vector3(element.state.n_start);
      m_ = Vector3(element.state.m_start);
    }
    const int count = std::max(1, static_cast<int>(std::ceil(pieces_of_element * (to - from))));
    for (int i = 0; i < count && result_.ok_; ++i) {
      RodElement piece = element;
      piece.state.length = element.state.length * (to - from) / count;
      piece.setStart(X_, n_, m_);
      result_.ok_ = integrate(kernel_, true, piece) && std::isfinite(propagate(kernel_, kColumnGoal, piece));
      const ElementTransfer& t = piece.state.transfer;
      const auto columns = [&](int first) {
        return (Columns() << sensitivityMatrix(t.phi, first), sensitivityMatrix(t.p, first), sensitivityMatrix(t.m, first))
            .finished();
      };
      Step step;
      step.of_rotation = columns(kOfRotation);
      step.of_moment = columns(kOfMoment);
      step.of_force = columns(kOfForce);
      result_.steps_.push_back(step);
      X_ = piece.X_end();
      n_ = piece.n_end();
      m_ = piece.m_end();
    }
  }

 private:
  GeneralisedCompliance& result_;
  const ElementKernel& kernel_;
  Pose X_;
  Vector3 n_ = Vector3::Zero(), m_ = Vector3::Zero();
};

GeneralisedCompliance::GeneralisedCompliance(const StiffnessModel& model, const StiffnessWorkspace& workspace,
                                             const Wrench& tip_wrench, const std::vector<SectionPlace>& places)
    : stop_of_place_(places.size()) {
  const Scene& scene = model.scene();
  FaultList faults("places of a generalised compliance");
  for (const SectionPlace& place : places) {
    if (place.segment == SectionPlace::kTip) continue;
    faults.check("segment", place.segment, {0.0, scene.segmentCount() - 1.0});
    faults.check("fraction", place.fraction, {0.0, 1.0});
  }
  faults.throwIfAny();

  const Backbone& backbone = workspace.backbone();
  const Chain chain(scene);
  DeadLoads loads;
  if (workspace.loaded()) loads = {scene.gravity.value_or(Vector3::Zero()), tip_wrench};
  Vector3 n = loads.baseForce(chain);
  Walk walk(*this, elementKernel(kMaxStages, backbone.simd()));
  auto element = backbone.elements.begin();
  for (const Chain::Part& part : chain.parts) {
    if (part.segment < 0) {
      n -= part.mass * loads.gravity;
      walk.rigid(part.length * walk.X().R.col(2), n + 0.5 * part.mass * loads.gravity);
      continue;
    }
    std::vector<int> here;
    for (size_t i = 0; i < places.size(); ++i)
      if (places[i].segment == part.segment) here.push_back(static_cast<int>(i));
    std::sort(here.begin(), here.end(), [&](int a, int b) { return places[a].fraction < places[b].fraction; });
    auto next = here.begin();
    const int count = backbone.element_count[part.segment];
    for (int k = 0; k < count; ++k, ++element) {
      const int pieces = pieceCount(*element, backbone.kernel->stages);
      double at = 0.0;
      while (next != here.end()) {
        const double to = places[*next].fraction * count - k;
        if (to >= 1.0 && !(k == count - 1)) break;
        if (to > at) walk.along(*element, at, std::min(to, 1.0), pieces);
        at = std::max(at, to);
        walk.stopFor(*next++);
      }
      if (at < 1.0) walk.along(*element, at, 1.0, pieces);
    }
    n -= part.mass * loads.gravity;
  }
  if (!chain.tip_offset.isZero(0.0)) walk.rigid(walk.X().R * chain.tip_offset, n);
  for (size_t i = 0; i < places.size(); ++i)
    if (places[i].segment == SectionPlace::kTip) walk.stopFor(static_cast<int>(i));
  // No moment may be left at T.
  Matrix3 beyond = Matrix3::Zero();
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
    step->pivot_inverse = (moment(step->of_moment) - beyond * rotation(step->of_moment)).inverse();
    step->by_force = beyond * rotation(step->of_force) - moment(step->of_force);
    step->stiffness = step->pivot_inverse * (beyond * rotation(step->of_rotation) - moment(step->of_rotation));
    beyond = step->stiffness;
    ok_ = ok_ && step->pivot_inverse.allFinite();
  }
}

// The wrench [f; M] at stop a leaves the force beyond it as it is and lowers the moment by M there. Beyond a, the moment at
// the start of a step is S phi; up to a it is S phi + s, s from the sweep from a to the base. The same sweep as of the tip's
// tangent (docs/derivation.md, section 5): nothing grows along it, however long the arm is.
Matrix6 GeneralisedCompliance::between(int from, int to) const {
  if (!ok_) return Matrix6::Zero();
  using Columns6 = Eigen::Matrix<double, 3, 6>;
  const size_t a = stop_of_place_[from].step, b = stop_of_place_[to].step;
  Columns6 s = Columns6::Zero(), phi = Columns6::Zero(), p = Columns6::Zero();
  s.rightCols<3>().setIdentity();
  std::vector<Columns6> moments(a);
  for (size_t k = a; k-- > 0;) {
    s.leftCols<3>() += steps_[k].by_force;
    moments[k] = s = steps_[k].pivot_inverse * s;
  }
  for (size_t k = 0; k < b; ++k) {
    const Step& step = steps_[k];
    Columns6 m = step.stiffness * phi;
    if (k < a) m += moments[k];
    Eigen::Matrix<double, 6, 6> end = step.of_rotation.topRows<6>() * phi + step.of_moment.topRows<6>() * m;
    if (k < a) end.leftCols<3>() += step.of_force.topRows<6>();
    phi = end.topRows<3>();
    p += end.bottomRows<3>();
  }
  Matrix6 C;
  C << p, phi;
  return C;
}

}  // namespace live_stiffness
