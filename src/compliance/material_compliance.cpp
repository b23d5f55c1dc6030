#include "live_stiffness/compliance/material_compliance.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace live_stiffness {
namespace {

// Which of the 21 numbers is entry (row, column).
constexpr int kPackedIndex[6][6] = {{0, 1, 2, 6, 7, 8},    {1, 3, 4, 9, 10, 11},   {2, 4, 5, 12, 13, 14},
                                    {6, 9, 12, 15, 16, 17}, {7, 10, 13, 16, 18, 19}, {8, 11, 14, 17, 19, 20}};

// The 21 numbers of element_state.h.
typedef double Packed[kPackedSize];

void unpack(const Packed& at, Matrix6& C) {
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j)
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) C(i, j) = at[kPackedIndex[i][j]];
}

// About the point o becomes about o + d: H C H^T with H = [I, -hat(d); 0, I], so that K -> K - hat(d) W and
// P -> P - hat(d) K^T + K_new hat(d).
void shift(const Vector3& d, Packed& at) {
  double *P = at, *K = at + 6, *W = at + 15;
  const double w[3][3] = {{W[0], W[1], W[2]}, {W[1], W[3], W[4]}, {W[2], W[4], W[5]}};  // column by column
  double a[3][3], b[3][3];
  for (int j = 0; j < 3; ++j) {  // of d x (row of K) and d x (row of K_new)
    a[j][0] = d[1] * K[3 * j + 2] - d[2] * K[3 * j + 1];
    a[j][1] = d[2] * K[3 * j] - d[0] * K[3 * j + 2];
    a[j][2] = d[0] * K[3 * j + 1] - d[1] * K[3 * j];
  }
  for (int j = 0; j < 3; ++j) {
    K[j] -= d[1] * w[j][2] - d[2] * w[j][1];
    K[3 + j] -= d[2] * w[j][0] - d[0] * w[j][2];
    K[6 + j] -= d[0] * w[j][1] - d[1] * w[j][0];
  }
  for (int i = 0; i < 3; ++i) {
    b[i][0] = d[1] * K[3 * i + 2] - d[2] * K[3 * i + 1];
    b[i][1] = d[2] * K[3 * i] - d[0] * K[3 * i + 2];
    b[i][2] = d[0] * K[3 * i + 1] - d[1] * K[3 * i];
  }
  P[0] -= a[0][0] + b[0][0];
  P[1] -= a[1][0] + b[0][1];
  P[2] -= a[2][0] + b[0][2];
  P[3] -= a[1][1] + b[1][1];
  P[4] -= a[2][1] + b[1][2];
  P[5] -= a[2][2] + b[2][2];
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
  backbone.passes->material(piece.state, !loaded, 0.0);
  Packed total;
  for (int i = 0; i < kPackedSize; ++i) total[i] = element.start_compliance[i] + piece.state.compliance[i];
  station.X_BS = piece.X_end();
  shift(station.X_BS.p - element.p_start, total);
  unpack(total, station.compliance);
}

}  // namespace

double accumulateMaterial(Backbone& backbone, double accuracy, bool loaded, Matrix6& tip_compliance) {
  Packed nothing = {};
  const Packed* before = &nothing;
  double error = 0.0;
  Vector3 about = Vector3::Zero();
  for (RodElement& element : backbone.elements) {
    backbone.passes->material(element.state, !loaded, accuracy);
    std::copy_n(*before, kPackedSize, element.start_compliance);
    if (before != &nothing) shift(element.p_start - about, element.start_compliance);
    const Vector3 along(element.state.offset_end);
    for (int i = 0; i < kPackedSize; ++i)
      element.end_compliance[i] = element.start_compliance[i] + element.state.compliance[i];
    shift(along, element.end_compliance);
    about = element.p_start + along;
    before = &element.end_compliance;
    error += element.state.compliance_error;
  }
  Packed tip;
  std::copy_n(*before, kPackedSize, tip);
  if (about != backbone.X_BT.p) shift(backbone.X_BT.p - about, tip);
  unpack(tip, tip_compliance);
  return error;
}

void stationsAt(const Backbone& backbone, int segment, const double* fractions, size_t size, double accuracy,
                bool loaded, Station* out) {
  static_assert(sizeof(Pose) == 12 * sizeof(double));
  const int first = backbone.firstElement(segment), count = backbone.element_count[segment];
  const double stretch = backbone.rest[segment].stretch;
  Station unused;
  StationBatch batch;
  for (size_t i = 0; i < size;) {
    const auto along = [&](size_t i) { return std::clamp(fractions[i], 0.0, 1.0) * count; };
    const int k = std::min(static_cast<int>(along(i)), count - 1);
    const RodElement& element = backbone.elements[first + k];
    out[i].stretch = stretch;
    if (along(i) >= k + 1) {
      out[i].X_BS = element.X_end();
      unpack(element.end_compliance, out[i++].compliance);
      continue;
    }
    if (element.state.station_error > accuracy && along(i) > k) {
      stationOfPiece(backbone, element, along(i) - k, loaded, out[i]);
      ++i;
      continue;
    }
    batch.size = 0;
    for (; batch.size < kStationBatch && i < size && along(i) >= k && along(i) < k + 1; ++i) {
      out[i].stretch = stretch;
      batch.fraction[batch.size] = along(i) - k;
      batch.pose[batch.size] = out[i].X_BS.R.data();
      batch.compliance[batch.size++] = out[i].compliance.data();
    }
    for (int lane = batch.size; lane < kStationBatch; ++lane) {
      batch.fraction[lane] = 0.0;
      batch.pose[lane] = unused.X_BS.R.data();
      batch.compliance[lane] = unused.compliance.data();
    }
    for (int j = 0; j < 3; ++j) batch.p_start[j] = element.p_start[j];
    std::copy_n(element.start_compliance, kPackedSize, batch.start_compliance);
    backbone.passes->stations(element.state, batch);
  }
}

}  // namespace live_stiffness
