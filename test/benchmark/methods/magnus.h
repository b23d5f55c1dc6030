#pragma once
// Lie-group shooting: each element ends with the exponential of its Magnus expansion, of order 4 with two or order 6
// with three Gauss nodes; rotations and moments at the nodes come from collocation, since the strain depends on them.
// Expansions: Blanes, Casas, Oteo and Ros, The Magnus expansion and some of its applications, Physics Reports 470
// (2009).

#include "benchmark/methods/base_moment_shooting.h"

namespace live_stiffness {

template <int kNodes>
class Magnus : public BaseMomentShooting {
 public:
  // elements: of each segment.
  Magnus(const Scene& scene, int elements);

 private:
  using NodeVectors = Eigen::Matrix<double, 3, kNodes>;
  struct Nodes {
    std::array<Pose, kNodes> X;
    NodeVectors n, m, tangent;
  };
  bool integrate(int index, const SoftPiece& piece, RodState& state) override;
  bool integrate(int index, const SoftPiece& piece, RodState& state, RodColumns& columns, MaterialSum& sum) override;
  void forget() override;
  bool step(const SoftPiece& piece, double h, NodeVectors& rotation, RodState& state, Nodes& nodes) const;
  void carryColumns(const SoftPiece& piece, double h, const Nodes& nodes, RodColumns& columns) const;

  int elements_;
  std::vector<NodeVectors> rotation_;  // of the last solution, the next one's guess; NaN in the first entry: none
};

extern template class Magnus<2>;
extern template class Magnus<3>;

}  // namespace live_stiffness
