#pragma once
// One rod of a parallel robot: clamped at the base, its end moved by a wrench of the platform. The same elements,
// sweeps and columns as those of a serial robot, in the axes of the rod's base; but the end force is unknown, too.
// docs/derivation.md, section 10, has the equations.

#include "live_stiffness/parallel/parallel_scene.h"
#include "rod/discretisation.h"
#include "rod/shooting.h"

namespace live_stiffness {

class HeldRod {
 public:
  // gravity: m/s^2, base axes. accuracy: relative, decides stages and number of elements.
  HeldRod(const ParallelRod& rod, const Vector3& gravity, double accuracy, Simd simd);
  HeldRod(const HeldRod&) = delete;  // its parts refer to one another

  // What determines the shape: length between base and platform, m, and load = [force at the end; moment at the base],
  // N and N m, axes of the rod's base. The guess of the elements follows, to first order.
  void setLength(double length);
  void changeLoad(const Vector6& change);
  void setLoad(const Vector6& load) { load_ = load; }
  double length() const { return chain_.parts[0].length; }
  const Vector6& load() const { return load_; }

  // Forgets shape and load: straight, as many elements as before.
  void placeStraight();
  // One pass over every element; `change` of the sweep is of its Cayley vectors, rad.
  Sweep sweepOnce();
  // The shape under the load, converged. False if it cannot be found.
  bool march();
  // What the matrices below need, for the shape of the last sweep: columns to `goal`, relative. Returns what
  // the passes left, relative; infinity without success.
  double linearise(double goal);
  // Stages and elements for the load of now. True if that changed them: march() and linearise() anew.
  bool choose();
  // The same where those at hand carry too much of it.
  bool relieve();
  // More elements where the estimated error times `amplification` is above the accuracy. True as for choose().
  bool refine(double amplification);

  // After a sweep, in B.
  Pose X_BE() const { return X_BR_ * backbone_.X_BT; }
  Wrench endWrench() const;   // of the platform on the rod, at its end
  Wrench baseWrench() const;  // of the rest of the rod on the base, at the base

  // After linearise(), twists and wrenches at the end, base axes.
  const Matrix6& loadOfTwist() const { return load_of_twist_; }  // change of load that moves the end by a twist
  const Matrix6& stiffness() const { return stiffness_; }        // end wrench that this takes
  const Twist& twistOfLength() const { return twist_of_length_; }     // of the end by a unit of length, load fixed
  const Wrench& wrenchOfLength() const { return wrench_of_length_; }  // the same of the end wrench
  double truncation() const { return truncation_; }                   // estimated relative error of discretisation

  // Material compliance of the rod about its end (10), base axes. Prepares the elements for stations.
  Matrix6 materialCompliance(double accuracy);

  // A change of load as bending of the rod, rad.
  double bendingOf(const Vector6& load) const;
  // With both ends held the rod is stable. Exact (see held_rod.cpp) after linearise().
  bool isStableHeld() const;

  const Backbone& backbone() const { return backbone_; }
  const Pose& X_BR() const { return X_BR_; }

 private:
  DeadLoads loads() const { return {gravity_, (Wrench() << load_.head<3>(), Vector3::Zero()).finished()}; }

  Pose X_BR_;
  Vector3 gravity_;        // axes of the rod's base
  double linear_density_;  // kg/m
  double softness_;        // c_bt, 1/(N m^2)
  double accuracy_;        // of discretisation
  Scene scene_;            // the rod as a chain of one segment
  Chain chain_;
  Backbone backbone_;
  Discretisation discretisation_;
  Vector6 load_ = Vector6::Zero();
  Vector3 end_moment_ = Vector3::Zero();  // N m, axes of the rod's base
  bool nodes_hold_guess_ = false, has_columns_ = false;
  double truncation_ = 0.0;
  Matrix6 load_of_twist_ = Matrix6::Zero(), stiffness_ = Matrix6::Zero();
  Twist twist_of_length_ = Twist::Zero();
  Wrench wrench_of_length_ = Wrench::Zero();
};

}  // namespace live_stiffness
