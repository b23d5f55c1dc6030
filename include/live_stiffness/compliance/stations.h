#pragma once
// Stations: sections of a solved backbone, with what is known there. Read from the collocation polynomials where these
// are accurate enough, else integrated anew from the start of the element.

#include <vector>

#include "rod/backbone.h"

namespace live_stiffness {

// A section of the robot: its pose in B, stretch, and material compliance of everything between base and section,
// about the section's origin, in base axes (6x6, SI, linear first).
struct Station {
  Pose X_BS;
  double stretch = 1.0;
  Matrix6 compliance = Matrix6::Zero();
};

// How stations are read from a backbone; its material compliance must be there (material_compliance.h).
struct StationReading {
  double accuracy;  // relative
  bool loaded;      // something external acts
};

// One station. segment: from 0; fraction: of its length; below 0, or NaN, is its base, above 1 its end.
Station stationAt(const Backbone& backbone, int segment, double fraction, const StationReading& reading);

// Stations at fixed fractions of a segment, in any order. It remembers which elements they are in and their weights
// there, which takes as long to find as to read them: keep one for each segment.
class StationPlan {
 public:
  explicit StationPlan(std::vector<double> fractions);  // as of stationAt()

  int size() const { return static_cast<int>(fractions_.size()); }
  // out: size() of them. Never allocates.
  void read(const Backbone& backbone, int segment, const StationReading& reading, Station* out);

 private:
  // Some that are in one element, and which they are.
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
