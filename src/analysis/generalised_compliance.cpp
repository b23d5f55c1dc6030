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
    from_last_ = Transfer();
  }

  // Rigid piece; n: the force that turns with it, the mean of that before and after.
  void rigid(const Vector3& along, const Vector3& n) {
    Transfer step;
    step.of_state.block<3, 3>(3, 0) = -hat(along);
    step.of_state.block<3, 3>(6, 0) = -hat(n) * hat(along);
    step.of_force.bottomRows<3>() = -hat(along);
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
    Transfer step;
    const auto columns = [&](int first) {
      const ElementTransfer& t = piece.state.transfer;
      return (Eigen::Matrix<double, 9, 3>() << sensitivityMatrix(t.phi, first), sensitivityMatrix(t.p, first),
              sensitivityMatrix(t.m, first)).finished();
    };
    step.of_state.leftCols<3>() = columns(kOfRotation);
    step.of_state.rightCols<3>() = columns(kOfMoment);
    step.of_force = columns(kOfForce);
    advance(step);
    return true;
  }

  void advance(const Transfer& step) {
    from_base_ = from_base_.then(step);
    from_last_ = from_last_.then(step);
  }

  GeneralisedCompliance& result_;
  const ElementKernel& kernel_;
  Pose X_;
  Vector3 n_ = Vector3::Zero(), m_ = Vector3::Zero();
  Transfer from_base_, from_last_;
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
  const Matrix3 base_to_tip = stops_.back().from_base.of_state.bottomRightCorner<3, 3>();
  ok_ = ok_ && std::isfinite(1.0 / base_to_tip.determinant());
}

// The wrench [f; M] at stop a leaves the force beyond it as it is and lowers the moment by M there. So, with the
// unknown change of base moment m0, states up to a are those of (m0, f), and beyond it those of the state at a less M.
// No moment may be left at T.
Matrix6 GeneralisedCompliance::between(int from, int to) const {
  using Matrix93 = Eigen::Matrix<double, 9, 3>;
  if (!ok_) return Matrix6::Zero();
  const int a = stop_of_place_[from], b = stop_of_place_[to], last = static_cast<int>(stops_.size()) - 1;
  const Transfer& to_a = stops_[a].from_base;
  const auto beyond = [&](int stop) {
    Eigen::Matrix<double, 9, 9> product = Eigen::Matrix<double, 9, 9>::Identity();
    for (int i = a + 1; i <= stop; ++i) product = stops_[i].from_last.of_state * product;
    return product;
  };
  const Matrix93 of_m0 = to_a.of_state.rightCols<3>();
  Matrix93 of_M = Matrix93::Zero();
  of_M.bottomRows<3>() = -Matrix3::Identity();
  const Eigen::Matrix<double, 3, 9> left_at_tip = beyond(last).bottomRows<3>();
  const auto inverse = (left_at_tip * of_m0).partialPivLu();
  const Matrix3 m0_of_f = -inverse.solve(left_at_tip * to_a.of_force);
  const Matrix3 m0_of_M = -inverse.solve(left_at_tip * of_M);
  Eigen::Matrix<double, 9, 6> state;
  if (b <= a) {
    const Matrix93 b_of_m0 = stops_[b].from_base.of_state.rightCols<3>();
    state << b_of_m0 * m0_of_f + stops_[b].from_base.of_force, b_of_m0 * m0_of_M;
  } else {
    state << of_m0 * m0_of_f + to_a.of_force, of_m0 * m0_of_M + of_M;
    state = (beyond(b) * state).eval();
  }
  Matrix6 C;
  C << state.middleRows<3>(3), state.topRows<3>();
  return C;
}

}  // namespace live_stiffness
