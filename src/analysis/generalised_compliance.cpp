#include "live_stiffness/analysis/generalised_compliance.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "live_stiffness/checks.h"
#include "rod/backbone.h"

namespace live_stiffness {
namespace {

constexpr int kRotation = 0, kPosition = 3, kMoment = 6, kForce = 9;  // of a state of GeneralisedCompliance
constexpr double kColumnGoal = 1e-14;
// Pieces are short enough for elements of the most stages to be exact to rounding, both where the rod bends and where
// the columns do.
constexpr double kPieceBending = 0.3;
constexpr int kMostPieces = 64;

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

// Walks from base to tip and leaves a stop wherever one is asked for.
class GeneralisedCompliance::Walk {
 public:
  Walk(GeneralisedCompliance& result, const ElementKernel& kernel) : result_(result), kernel_(kernel) {}

  const Pose& X() const { return X_; }

  void stopFor(int place) {
    result_.stop_of_place_[place] = static_cast<int>(result_.stops_.size());
    stop();
  }
  void stop() {
    result_.stops_.push_back({X_, from_base_, from_last_});
    from_last_.setIdentity();
  }

  // Rigid piece; n: the force that turns with it, the mean of that before and after.
  void rigid(const Vector3& along, const Vector3& n) {
    Transfer step = Transfer::Identity();
    step.block<3, 3>(kPosition, kRotation) = -hat(along);
    step.block<3, 3>(kMoment, kRotation) = -hat(n) * hat(along);
    step.block<3, 3>(kMoment, kForce) = -hat(along);
    X_.p += along;
    advance(step);
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
      result_.ok_ = integrate(kernel_, true, piece) && addPiece(piece);
      X_ = piece.X_end();
      n_ = piece.n_end();
      m_ = piece.m_end();
    }
  }

 private:
  bool addPiece(RodElement& piece) {
    if (!std::isfinite(propagate(kernel_, kColumnGoal, piece))) return false;
    Transfer step = Transfer::Identity();
    const ElementTransfer& t = piece.state.transfer;
    for (const auto& [start, column] : {std::pair(kRotation, kOfRotation), {kMoment, kOfMoment}, {kForce, kOfForce}})
      step.block<9, 3>(0, start) << sensitivityMatrix(t.phi, column), sensitivityMatrix(t.p, column),
          sensitivityMatrix(t.m, column);
    advance(step);
    return true;
  }

  void advance(const Transfer& step) {
    from_base_ = step * from_base_;
    from_last_ = step * from_last_;
  }

  GeneralisedCompliance& result_;
  const ElementKernel& kernel_;
  Pose X_;
  Vector3 n_ = Vector3::Zero(), m_ = Vector3::Zero();
  Transfer from_base_ = Transfer::Identity(), from_last_ = Transfer::Identity();
};

GeneralisedCompliance::GeneralisedCompliance(const StiffnessModel& model, const StiffnessWorkspace& workspace,
                                             const Wrench& tip_wrench, const std::vector<SectionPlace>& places)
    : stop_of_place_(places.size(), -1) {
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
  walk.stop();
  for (size_t i = 0; i < places.size(); ++i)
    if (places[i].segment == SectionPlace::kTip) stop_of_place_[i] = static_cast<int>(stops_.size()) - 1;
  ok_ = ok_ && std::isfinite(1.0 / stops_.back().from_base.block<3, 3>(kMoment, kMoment).determinant());
}

// The wrench [f; M] at stop a changes force and moment by f and M up to a only. So, with the unknown change of base moment m0,
// states up to a are those of (m0, f), and beyond it those of the state at a less (M, f). No moment may be left at T.
Matrix6 GeneralisedCompliance::between(int from, int to) const {
  if (!ok_) return Matrix6::Zero();
  using States = Eigen::Matrix<double, 12, 6>;  // by the wrench
  const int a = stop_of_place_[from], b = stop_of_place_[to];
  const auto beyond = [&](int stop) {
    Transfer product = Transfer::Identity();
    for (int i = a + 1; i <= stop; ++i) product = stops_[i].from_last * product;
    return product;
  };
  // Just beyond a, with m0 = 0.
  States state = States::Zero();
  state.leftCols<3>() = stops_[a].from_base.middleCols<3>(kForce);
  state.block<3, 3>(kForce, 0) -= Matrix3::Identity();
  state.block<3, 3>(kMoment, 3) -= Matrix3::Identity();
  const Eigen::Matrix<double, 3, 12> left_at_tip = beyond(static_cast<int>(stops_.size()) - 1).middleRows<3>(kMoment);
  const Eigen::Matrix<double, 12, 3> of_m0 = stops_[a].from_base.middleCols<3>(kMoment);
  const Matrix3X6 m0 = -(left_at_tip * of_m0).partialPivLu().solve(left_at_tip * state);
  if (b > a) {
    state = (beyond(b) * (state + of_m0 * m0)).eval();
  } else {
    state = stops_[b].from_base.middleCols<3>(kMoment) * m0;
    state.leftCols<3>() += stops_[b].from_base.middleCols<3>(kForce);
  }
  return (Matrix6() << state.middleRows<3>(kPosition), state.middleRows<3>(kRotation)).finished();
}

}  // namespace live_stiffness
