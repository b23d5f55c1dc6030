#include "live_stiffness/compliance/material_compliance.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "live_stiffness/rod/shooting.h"

namespace live_stiffness {
namespace {

// Which of the 21 numbers is entry (row, column).
constexpr int kPackedIndex[6][6] = {{0, 1, 2, 6, 7, 8},    {1, 3, 4, 9, 10, 11},   {2, 4, 5, 12, 13, 14},
                                    {6, 9, 12, 15, 16, 17}, {7, 10, 13, 16, 18, 19}, {8, 11, 14, 17, 19, 20}};

// The 21 numbers of element_state.h as a matrix.
void unpack(const PackedRow& at, Matrix6& C) {
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j)
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) C(i, j) = at[kPackedIndex[i][j]];
}

// The station at the end of a piece of the element, integrated anew: slower, and as accurate as the tip.
void stationOfPiece(const Backbone& backbone, const RodElement& element, double part, bool loaded, Station& station) {
  RodElement piece;
  std::memcpy(&piece.state, &element.state, offsetof(ElementState, R_end));  // what the caller sets, and the guess
  std::copy_n(element.state.start_compliance, kPackedRow, piece.state.start_compliance);
  piece.state.length *= part;
  if (loaded) {
    for (StageRow& row : piece.state.g)
      for (double& g : row) g *= part;
    integrate(*backbone.passes, false, piece);  // shorter than a converged element, so it converges
  } else {
    backbone.passes->place_unloaded(piece.state);
  }
  backbone.passes->material(piece.state, !loaded, 0.0);
  backbone.passes->add_compliance(piece.state);
  station.X_BS = piece.X_end();
  unpack(piece.state.end_compliance, station.compliance);
}

}  // namespace

double accumulateMaterial(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance) {
  const Vector3& p = backbone.X_BT.p;
  PackedRow tip;
  const double error = backbone.passes->accumulate(stateOf(chain, DeadLoads(), Vector3::Zero(), backbone), accuracy,
                                                   {p.x(), p.y(), p.z()}, tip);
  unpack(tip, tip_compliance);
  return error;
}

double placeUnloaded(const Chain& chain, double accuracy, Backbone& backbone, Matrix6& tip_compliance) {
  SweepResult result;
  PackedRow tip;
  const double error = backbone.passes->place_chain(stateOf(chain, DeadLoads(), Vector3::Zero(), backbone), accuracy,
                                                    result, tip);
  backbone.setTip(result.R_tip, result.p_tip);
  unpack(tip, tip_compliance);
  return error;
}

void stationsAt(const Backbone& backbone, int segment, const double* fractions, size_t size, double accuracy,
                bool loaded, Station* out) {
  static_assert(sizeof(Pose) == 12 * sizeof(double));
  const RodElement* const elements = &backbone.elements[backbone.firstElement(segment)];
  const int count = backbone.element_count[segment];
  const double stretch = backbone.rest[segment].stretch;
  double spare_pose[12], spare_compliance[36];  // of unused lanes
  StationBatch batch;
  int element = 0;  // of the batch
  batch.size = 0;
  const auto flush = [&] {
    for (int lane = batch.size; lane < kStationBatch; ++lane) {
      batch.fraction[lane] = 0.0;
      batch.pose[lane] = spare_pose;
      batch.compliance[lane] = spare_compliance;
    }
    if (batch.size > 0) backbone.passes->stations(elements[element].state, batch);
    batch.size = 0;
  };
  for (Station *station = out, *end = out + size; station != end; ++station) {
    const double given = *fractions++, along = given > 0.0 ? std::min(given, 1.0) * count : 0.0;  // NaN: the base
    const int k = std::min(static_cast<int>(along), count - 1);
    const double fraction = along - k;
    station->stretch = stretch;
    if (fraction >= 1.0) {
      station->X_BS = elements[k].X_end();
      unpack(elements[k].state.end_compliance, station->compliance);
    } else if (elements[k].state.station_error > accuracy && fraction > 0.0) {
      stationOfPiece(backbone, elements[k], fraction, loaded, *station);
    } else {
      if (k != element || batch.size == kStationBatch) flush();
      element = k;
      batch.fraction[batch.size] = fraction;
      batch.pose[batch.size] = station->X_BS.R.data();
      batch.compliance[batch.size++] = station->compliance.data();
    }
  }
  flush();
}

}  // namespace live_stiffness
