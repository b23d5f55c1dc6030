#include "compliance/station_reader.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace live_stiffness {
namespace {

static_assert(sizeof(Pose) == 12 * sizeof(double));

// An element of a segment, and a fraction of its length: 1 at the end of the segment only.
struct StationPosition {
  int element;
  double fraction;

  StationPosition(double of_segment, int element_count) {
    const double along = of_segment > 0.0 ? std::min(of_segment, 1.0) * element_count : 0.0;  // NaN: the base
    element = std::min(static_cast<int>(along), element_count - 1);
    fraction = along - element;
  }
};

void readEnd(const RodElement& element, Station& station) {
  station.X_BQ = element.X_end();
  unpack(element.state.end_compliance, station.compliance);
}

// At part of the element, integrated again: slower, and as accurate as the tip.
void integrateTo(const Backbone& backbone, const RodElement& element, double part, bool loaded, Station& station) {
  RodElement piece;
  std::memcpy(&piece.state, &element.state, offsetof(ElementState, R_end));  // what the caller sets, and the guess
  std::copy_n(element.state.start_compliance, kPackedRow, piece.state.start_compliance);
  piece.state.length *= part;
  if (loaded) {
    for (StageRow& row : piece.state.g)
      for (double& g : row) g *= part;
    integrate(*backbone.kernel, false, piece);  // shorter than a converged element, so it converges
  } else {
    backbone.kernel->place_unloaded(piece.state);
  }
  backbone.kernel->material(piece.state, !loaded, 0.0);
  backbone.kernel->add_compliance(piece.state);
  readEnd(piece, station);
}

void setWeights(int nodes, StationBatch& batch) {
  double weight[kMaxNodes] = {};
  for (int lane = 0; lane < kStationBatch; ++lane) {
    if (lane < batch.size) integralWeights(nodes, batch.fraction[lane], weight);  // the others repeat the last
    for (int j = 0; j < nodes; ++j) batch.weight[j][lane] = weight[j];
  }
  batch.nodes = nodes;
}

void readBatch(const Backbone& backbone, const RodElement& element, const StationReading& reading, StationBatch& batch,
               Station* const (&out)[kStationBatch]) {
  const ElementState& state = element.state;
  if (!state.is_arc && batch.nodes != state.dense_nodes) setWeights(state.dense_nodes, batch);
  StationResults results;
  for (int lane = 0; lane < kStationBatch; ++lane) {
    results.pose[lane] = out[lane]->X_BQ.R.data();
    results.compliance[lane] = out[lane]->compliance.data();
  }
  backbone.kernel->stations(state, batch, results);
  if (state.station_error <= reading.accuracy) return;
  for (int lane = 0; lane < batch.size; ++lane)
    if (batch.fraction[lane] > 0.0) integrateTo(backbone, element, batch.fraction[lane], reading.loaded, *out[lane]);
}

}  // namespace

Station stationAt(const Backbone& backbone, int segment, double fraction, const StationReading& reading) {
  const StationPosition position(fraction, backbone.element_count[segment]);
  const RodElement& element = backbone.elements[backbone.firstElement(segment) + position.element];
  Station station;
  station.stretch = backbone.rest[segment].stretch;
  if (position.fraction >= 1.0) {
    readEnd(element, station);
  } else {
    StationBatch batch;
    batch.size = 1;
    batch.nodes = 0;
    std::fill_n(batch.fraction, kStationBatch, position.fraction);
    readBatch(backbone, element, reading, batch, {&station, &station, &station, &station});
  }
  return station;
}

StationPlan::StationPlan(std::vector<double> fractions)
    : batches_(std::make_unique<StationBatches>(std::move(fractions))) {}
StationPlan::StationPlan(const StationPlan& other) : batches_(std::make_unique<StationBatches>(*other.batches_)) {}
StationPlan::StationPlan(StationPlan&&) noexcept = default;
StationPlan::~StationPlan() = default;

int StationPlan::size() const { return batches_->size(); }

StationBatches::StationBatches(std::vector<double> fractions) : fractions_(std::move(fractions)) {
  batches_.reserve(fractions_.size());
  ends_.reserve(fractions_.size());
}

void StationBatches::spreadOver(int element_count) {
  element_count_ = element_count;
  batches_.clear();
  ends_.clear();
  for (int i = 0; i < size(); ++i) {
    const StationPosition position(fractions_[i], element_count);
    if (position.fraction >= 1.0) {
      ends_.push_back(i);
      continue;
    }
    if (batches_.empty() || batches_.back().element != position.element ||
        batches_.back().sections.size == kStationBatch) {
      batches_.emplace_back();
      batches_.back().element = position.element;
      batches_.back().sections.size = batches_.back().sections.nodes = 0;
    }
    Batch& batch = batches_.back();
    for (int lane = batch.sections.size++; lane < kStationBatch; ++lane) {
      batch.station[lane] = i;
      batch.sections.fraction[lane] = position.fraction;
    }
  }
}

void StationBatches::read(const Backbone& backbone, int segment, const StationReading& reading, Station* out) {
  const int count = backbone.element_count[segment];
  if (count != element_count_) spreadOver(count);
  const RodElement* const elements = &backbone.elements[backbone.firstElement(segment)];
  for (Batch& batch : batches_) {
    const int(&k)[kStationBatch] = batch.station;
    readBatch(backbone, elements[batch.element], reading, batch.sections,
              {out + k[0], out + k[1], out + k[2], out + k[3]});
  }
  for (int i : ends_) readEnd(elements[count - 1], out[i]);
  const double stretch = backbone.rest[segment].stretch;
  for (int i = 0; i < size(); ++i) out[i].stretch = stretch;
}

}  // namespace live_stiffness
