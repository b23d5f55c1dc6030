#include "live_stiffness/compliance/material_compliance.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace live_stiffness {
namespace {

// Which of the 21 numbers is entry (row, column).
constexpr int kPackedIndex[6][6] = {{0, 1, 2, 6, 7, 8},    {1, 3, 4, 9, 10, 11},   {2, 4, 5, 12, 13, 14},
                                    {6, 9, 12, 15, 16, 17}, {7, 10, 13, 16, 18, 19}, {8, 11, 14, 17, 19, 20}};

// The 21 numbers of element_state.h as a matrix.
struct Packed {
  double at[kPackedSize] = {};

  Matrix6 matrix() const {
    Matrix6 C;
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) C(i, j) = at[kPackedIndex[i][j]];
    return C;
  }

  // About the point o becomes about o + d: H C H^T with H = [I, -hat(d); 0, I].
  void shift(const Vector3& d) {
    if (d.isZero(0.0)) return;
    const Matrix6 C = matrix();
    const auto K = C.topRightCorner<3, 3>();
    Matrix3 K_new, P = C.topLeftCorner<3, 3>();
    for (int i = 0; i < 3; ++i) {
      K_new.col(i) = K.col(i) - d.cross(C.bottomRightCorner<3, 3>().col(i));
      P.col(i) -= d.cross(K.row(i).transpose());
    }
    for (int i = 0; i < 3; ++i) P.row(i) -= d.cross(K_new.row(i).transpose()).transpose();  // + K_new hat(d)
    const double out[] = {P(0, 0), P(0, 1), P(0, 2), P(1, 1), P(1, 2), P(2, 2)};
    std::copy_n(out, 6, at);
    for (int i = 0; i < 9; ++i) at[6 + i] = K_new(i / 3, i % 3);
  }
};

void unpackLane(const RodElement& element, double stretch, const StationBatch& batch, int lane, Station& station) {
  station.stretch = stretch;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) station.X_BS.R(i, j) = batch.R[3 * i + j][lane];
    station.X_BS.p[j] = element.p_start[j] + batch.offset[j][lane];
  }
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i) station.compliance(i, j) = batch.compliance[kPackedIndex[i][j]][lane];
}

// The station at the end of a piece of the element, integrated anew: slower, and as accurate as the tip.
void stationOfPiece(const Backbone& backbone, const RodElement& element, double part, bool loaded, Station& station) {
  RodElement piece;
  piece.p_start = element.p_start;
  std::memcpy(&piece.state, &element.state, offsetof(ElementState, R_end));  // what the caller sets, and the guess
  piece.state.length *= part;
  if (loaded) {
    for (StageRow& row : piece.state.g)
      for (double& g : row) g *= part;
    integrate(*backbone.passes, piece);  // shorter than a converged element, so it converges
  } else {
    backbone.passes->place_unloaded(piece.state);
  }
  backbone.passes->material(piece.state, !loaded, true);
  Packed total;
  for (int i = 0; i < kPackedSize; ++i) total.at[i] = element.start_compliance[i] + piece.state.compliance[i];
  station.X_BS = piece.X_end();
  total.shift(station.X_BS.p - element.p_start);
  station.compliance = total.matrix();
}

}  // namespace

Matrix6 accumulateMaterial(Backbone& backbone, double accuracy, bool loaded) {
  constexpr double kImprovement = 20.0;
  Packed total;
  Vector3 about = Vector3::Zero();
  for (RodElement& element : backbone.elements) {
    const bool improve = loaded && element.state.interior_error > accuracy;
    backbone.passes->material(element.state, !loaded, improve);
    if (improve) element.state.interior_error /= kImprovement;
    total.shift(element.p_start - about);
    std::copy_n(total.at, kPackedSize, element.start_compliance);
    for (int i = 0; i < kPackedSize; ++i) total.at[i] += element.state.compliance[i];
    about = element.p_start;
  }
  total.shift(backbone.X_BT.p - about);
  return total.matrix();
}

void stationsAt(const Backbone& backbone, int segment, const double* fractions, size_t size, double accuracy,
                bool loaded, Station* out) {
  const int first = backbone.firstElement(segment), count = backbone.element_count[segment];
  const auto along = [&](size_t i) { return std::clamp(fractions[i], 0.0, 1.0) * count; };
  const auto elementOf = [&](size_t i) { return std::min(static_cast<int>(along(i)), count - 1); };
  for (size_t i = 0; i < size;) {
    const int k = elementOf(i);
    const RodElement& element = backbone.elements[first + k];
    const double part = along(i) - k;
    if (element.state.interior_error > accuracy && part > 0.0 && part < 1.0) {
      stationOfPiece(backbone, element, part, loaded, out[i]);
      out[i++].stretch = backbone.rest[segment].stretch;
      continue;
    }
    StationBatch batch;
    std::copy_n(element.start_compliance, kPackedSize, batch.start_compliance);
    int filled = 0;
    while (filled < kStationBatch && i + filled < size && elementOf(i + filled) == k) {
      batch.fraction[filled] = along(i + filled) - k;
      ++filled;
    }
    std::fill(batch.fraction + filled, batch.fraction + kStationBatch, 0.0);
    backbone.passes->stations(element.state, batch);
    for (int lane = 0; lane < filled; ++lane)
      unpackLane(element, backbone.rest[segment].stretch, batch, lane, out[i + lane]);
    i += filled;
  }
}

}  // namespace live_stiffness
