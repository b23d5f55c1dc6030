#pragma once
// Which equilibrium: from a shape downhill in potential energy to a stable one. See docs/derivation.md, section 4.

#include "rod/nodal_rotations.h"

namespace live_stiffness {

class EnergyDescent {
 public:
  explicit EnergyDescent(const Chain& chain);

  enum class End {
    kMinimum,
    kNeutral,       // a minimum that another one touches: a symmetric column, which may lean in any direction
    kNotConverged,  // within the bound on steps
  };
  // From the shape to a minimum of the energy of its nodes, which is accurate to second order in their distance; the loads
  // double from first_share (above 0) on until they are full. rest: one for each segment. A dead tip moment has no potential;
  // it counts by its work along the way. Never allocates.
  End run(const DeadLoads& loads, const std::vector<RestState>& rest, double first_share, NodalRotations& shape);

 private:
  struct Node {
    Matrix3 diagonal, next, pivot_inverse;  // of the Hessian, N m: of this node, and with the next one; axes of the nodes
    Vector3 gradient, step;                 // N m; rad
    Vector3 load;                           // on the node's axis: force times the length that it acts on, N m, base axes
    double softening;                       // 1/(N m): shear and extension add half of it times (load . axis)^2
    Matrix3 stiffness;                      // of the interval before the node, N m / rad
    Vector3 rest;                           // its Cayley vector without loads
  };
  void prepare(const DeadLoads& loads, const std::vector<RestState>& rest, const NodalRotations& shape);
  double energy(const std::vector<Matrix3>& R) const;
  void differentiate(const std::vector<Matrix3>& R, const Vector3& tip_moment);
  bool factorise();
  struct Step {
    double longest;  // that a node was to turn by, rad
    bool downhill;   // from a shape that is not stable
  };
  Step step(const Vector3& tip_moment, NodalRotations& shape);

  const Chain& chain_;
  std::vector<Node> nodes_;
  Vector3 tip_force_ = Vector3::Zero();  // N, on the lever of T
  std::vector<Matrix3> trial_;
  double share_ = 1.0;        // of the loads
  double least_pivot_ = 0.0;  // smallest eigenvalue of the first node's pivot, by its largest
};

}  // namespace live_stiffness
