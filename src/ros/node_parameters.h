#pragma once
// Private parameters of stiffness_node, which replay has, too. live_stiffness/parameters.h says what each is.

#include <ros/node_handle.h>
#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "estimation/input_parameters.h"
#include "live_stiffness/compliance/model_options.h"
#include "live_stiffness/estimation/stiffness_estimator.h"
#include "live_stiffness/estimation/tip_wrench_estimator.h"
#include "ros/marker_shapes.h"

namespace live_stiffness {

class StiffnessConfig;  // of dynamic_reconfigure

struct TipHandleOptions {
  bool enabled = kTipHandle.standard;
  double force_per_m = kTipHandleForce.standard;      // N of force for each m the handle is dragged, and of the arrow drawn
  double moment_per_rad = kTipHandleMoment.standard;  // N m of moment for each rad the handle is turned
};

struct NodeParameters : InputParameters {
  Scene scene;
  std::string model_name = kModel.standard, stepping_name = kStepping.standard;
  ModelOptions model;
  EstimatorOptions estimator;
  double heartbeat = kHeartbeat.standard;  // Hz

  Registration registration;      // in use: loaded, until ~register applies another one
  bool is_registered = false;     // one was loaded, or applied by ~register
  std::string registration_file;  // that it was loaded from; empty: none
  double registration_buffer = kRegistrationBuffer.standard;  // s of the past that ~register can use

  TipWrenchOptions contact;
  double contact_arrow_scale = kContactArrow.standard;  // of the arrow drawn, N/m

  MarkerStyle style;  // its frame is that of B; its scale is the force in N whose displacement is drawn
  double marker_rate = kMarkerRate.standard;  // Hz
  bool show_eigenscrews = kShowEigenscrews.standard;
  double eigenscrew_length = kEigenscrewLength.standard;  // of each axis drawn, m
  TipHandleOptions tip_handle;

  // Calls visit(parameter, field) for each parameter but the files.
  template <class Parameters, class Visit>
  static void forEachParameter(Parameters& p, Visit&& visit) {
    forEachOfModel(p, visit);
    InputParameters::forEachParameter(p, visit);
    visit(kRegistrationBuffer, p.registration_buffer);
    visit(kContactArrow, p.contact_arrow_scale);
    visit(kEllipsoidScale, p.style.ellipsoid_scale);
    visit(kMarkerRate, p.marker_rate);
    visit(kShowEigenscrews, p.show_eigenscrews);
    visit(kEigenscrewLength, p.eigenscrew_length);
    visit(kTipHandle, p.tip_handle.enabled);
    visit(kTipHandleForce, p.tip_handle.force_per_m);
    visit(kTipHandleMoment, p.tip_handle.moment_per_rad);
  }
  // The same for those that say how inputs become estimates.
  template <class Parameters, class Visit>
  static void forEachOfModel(Parameters& p, Visit&& visit) {
    visit(kModel, p.model_name);
    visit(kStepping, p.stepping_name);
    ModelOptions::forEachParameter(p.model, visit);
    EstimatorOptions::forEachParameter(p.estimator, visit);
    visit(kHeartbeat, p.heartbeat);
    TipWrenchOptions::forEachParameter(p.contact, visit);
  }
};

// The private parameters of a node, as YAML; nothing if there are none.
YAML::Node privateParameters(const ros::NodeHandle& private_node);

// Reads and validates all of them, from a mapping of keys to values. Throws ConfigurationError with every fault; prefix: put
// before each. unknown: gets the keys that are not known.
NodeParameters readNodeParameters(const YAML::Node& values, const std::string& subject, const std::string& prefix,
                                  std::vector<std::string>& unknown);

// The same from the private parameters of a node. Warns of unknown ones in the log.
NodeParameters loadNodeParameters(const ros::NodeHandle& private_node);

// The parameters with those changed that dynamic_reconfigure can change. Throws ConfigurationError with every fault, NaN
// included, which dynamic_reconfigure itself lets through.
NodeParameters reconfigured(NodeParameters parameters, const StiffnessConfig& config);

// Private parameters that are read by others: by runNode() and diagnostic_updater.
inline bool isReadByOthers(const std::string& key) { return key == "exit_without_master" || key == "diagnostic_period"; }
// Warns of unknown private parameters in the log.
void warnOfUnknown(const std::vector<std::string>& keys, const std::string& node);

}  // namespace live_stiffness
