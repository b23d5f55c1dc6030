#pragma once
// Reads stations from a backbone: from the collocation polynomials where these are accurate enough, else by a new
// integration from the start of the element.

#include "live_stiffness/compliance/stations.h"
#include "rod/backbone.h"

namespace live_stiffness {

// How stations are read from a backbone; its material compliance must be there (material_compliance.h).
struct StationReading {
  double accuracy;  // relative
  bool loaded;      // something external acts
};

// One station. segment: from 0; fraction: as of StationPlan.
Station stationAt(const Backbone& backbone, int segment, double fraction, const StationReading& reading);

// The stations of a StationPlan, by the elements that they are in.
class StationBatches {
 public:
  explicit StationBatches(std::vector<double> fractions);
  StationBatches(const StationBatches& other) : StationBatches(other.fractions_) {}  // with its own room

  int size() const { return static_cast<int>(fractions_.size()); }
  // out: size() of them. Never allocates.
  void read(const Backbone& backbone, int segment, const StationReading& reading, Station* out);

 private:
  // Stations in one element, and their indices.
  struct Batch {
    int element;
    int station[kStationBatch];
    StationBatch sections;
  };
  void spreadOver(int element_count);

  std::vector<double> fractions_;
  std::vector<Batch> batches_;
  std::vector<int> ends_;  // stations at the end of the segment
  int element_count_ = 0;
};

}  // namespace live_stiffness
