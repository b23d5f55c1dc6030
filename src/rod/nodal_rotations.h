#pragma once
// The shape of a chain as orientations at equally spaced nodes of every segment: what the minimiser of energy works on, and
// how a shape is carried over to other elements as a guess.

#include "rod/backbone.h"

namespace live_stiffness {

struct NodalRotations {
  std::vector<int> intervals;  // of each segment
  std::vector<Matrix3> R;      // orientations in B: node 0 is the base, neighbouring segments share a node

  // Room for the most intervals that a chain can have.
  explicit NodalRotations(const Chain& chain);
  static constexpr int kMostIntervals = 2 * Backbone::kMaxElements;  // of a segment

  // As many intervals as elements of the backbone times `each`, or so many that none bends by more than `spacing`, rad, if the
  // segments bend by `demand`; as far as there is room.
  void resize(const Backbone& backbone, int each);
  void resize(const std::vector<double>& demand, double spacing);
  // The shape that the elements of the backbone hold, or that of its rest states alone.
  void take(const Backbone& backbone);
  void takeUnloaded(const Chain& chain, const Backbone& backbone);
  // Start orientations and nodes of the elements.
  void place(Backbone& backbone) const;
  // Sum of the angles between the nodes of a segment, rad.
  double bending(int segment) const;

 private:
  void makeNodes();
  Matrix3 at(int first, int intervals, double fraction) const;
};

}  // namespace live_stiffness
