#pragma once
// One rod of a parallel robot: clamped at the base, its end moved by a wrench of the platform. Elements, iterations and
// sensitivities are those of a serial robot, in the axes of the rod's base; but the end force is unknown, too.
// docs/derivation.md, section 10, has the equations.

#include "live_stiffness/parallel/parallel_scene.h"
#include "rod/discretisation.h"
#include "rod/shooting.h"

namespace live_stiffness {

class ClampedRod {
 public:
  // gravity: m/s^2, base axes. accuracy: relative, decides stages and number of elements.
  ClampedRod(const ParallelRod& rod, const Vector3& gravity, double accuracy, Simd simd);
  ClampedRod(const ClampedRod&) = delete;  // its parts refer to one another

  // Sets what determines the shape: length between base and platform, m, and load = [force at the end; moment at the base],
  // N and N m, axes of the rod's base. The guess of the elements is moved along, to first order.
  void setLength(double length);
  void changeLoad(const Vector6& change);
  void setLoad(const Vector6& load) { load_ = load; }
  double length() const { return chain_.parts[0].length; }
  const Vector6& load() const { return load_; }

  // Forgets shape and load: straight, with the same number of elements.
  void placeStraight();
  // One iteration of every element; `change` of the result is that of the Cayley vectors, rad.
  MarchResult iterateOnce();
  // Iterates until the shape under the load has converged. False if it does not.
  bool integrate();
  // Computes what the matrices below need, for the shape of the last iteration: sensitivities to the relative error `goal`.
  // Returns their relative error; infinity without convergence.
  double linearise(double goal);
  // Chooses stages and elements for the present load. True if that changed them; then call integrate() and linearise() again.
  bool choose();
  // The same, but only if the present elements bend too far.
  bool refineForLoad();
  // More elements where the estimated error times `buckling_factor` is above the accuracy. True as for choose().
  bool refine(double buckling_factor);

  // After an iteration, in B.
  Pose X_BE() const { return X_BD_ * backbone_.X_BT; }
  Wrench endWrench() const;   // of the platform on the rod, at its end
  Wrench baseWrench() const;  // of the rest of the rod on the base, at the base

  // After linearise(), twists and wrenches at the end, base axes.
  const Matrix6& loadOfTwist() const { return load_of_twist_; }  // change of load that moves the end by a twist
  const Matrix6& stiffness() const { return stiffness_; }        // end wrench for a twist of the end
  const Twist& twistOfLength() const { return twist_of_length_; }     // of the end by a unit of length, load fixed
  const Wrench& wrenchOfLength() const { return wrench_of_length_; }  // of the end by a unit of length, end held
  double truncation() const { return truncation_; }                   // estimated relative error of discretisation

  // Material compliance of the rod about its end (10), base axes. Prepares the elements for stations.
  Matrix6 materialCompliance(double accuracy);

  // A change of load, expressed as bending of the rod, rad.
  double bendingOf(const Vector6& load) const;
  // True if the rod is stable with both ends clamped. Exact (see clamped_rod.cpp) after linearise().
  bool isStableClamped() const;

  const Backbone& backbone() const { return backbone_; }
  const Pose& X_BD() const { return X_BD_; }

 private:
  void forgetShape();  // load and elements stay
  DeadLoads loads() const { return {gravity_, (Wrench() << load_.head<3>(), Vector3::Zero()).finished()}; }

  Pose X_BD_;
  Vector3 gravity_;        // axes of the rod's base
  double linear_density_;  // kg/m
  double bending_compliance_;        // c_bt, 1/(N m^2)
  double accuracy_;        // of discretisation
  Scene scene_;            // the rod as a chain of one segment
  Chain chain_;
  Backbone backbone_;
  Discretisation discretisation_;
  Vector6 load_ = Vector6::Zero();
  Vector3 end_moment_ = Vector3::Zero();  // N m, axes of the rod's base
  bool nodes_hold_guess_ = false, has_sensitivities_ = false;
  int unstable_ = 0;  // LinearisationResult::unstable
  double truncation_ = 0.0;
  Matrix6 load_of_twist_ = Matrix6::Zero(), stiffness_ = Matrix6::Zero();
  Twist twist_of_length_ = Twist::Zero();
  Wrench wrench_of_length_ = Wrench::Zero();
};

}  // namespace live_stiffness
