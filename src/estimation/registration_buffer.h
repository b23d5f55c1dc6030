#pragma once
// The recent past of pressures and tracker poses, from which base and sensor are registered while the robot works.
//
// Poses are kept as the tracker gives them (X_AS), so that the registration in use has no part in the new one. At the
// fit each pose is paired with the tip that the model predicts for the pressures at its own time stamp, interpolated
// between the two messages around it, with the scene's creep.

#include <deque>
#include <optional>
#include <string>

#include "live_stiffness/compliance/stiffness_model.h"
#include "live_stiffness/estimation/recording.h"
#include "live_stiffness/estimation/registration_fit.h"
#include "estimation/creep.h"

namespace live_stiffness {

struct RegistrationWindow {
  double duration = 60.0;          // of the newest past, s; positive
  bool quasi_static_only = false;  // leave out samples in and just after motion; see quasiStaticSamples()
  bool leave_out_contact = false;  // leave out samples that were marked as in contact
  std::optional<TrackerMeasures> measures;  // none: found from the poses, and said
};

struct LiveRegistration {
  std::string fault;  // why nothing was fitted, and what to do; empty: the fit holds
  RegistrationFit fit;
  int poses = 0;      // different ones in the window, with pressures around them
  int used = 0;       // of them, by the fit
  int outliers = 0;   // farther than kOutlier times the median residual from a first fit, and left out
  double span = 0.0;  // from the first to the last one used, s

  // The figures and the verdict in words, a line each.
  std::string text() const;
};

class RegistrationBuffer {
 public:
  static constexpr int kFewest = 20;      // samples for a fit
  static constexpr int kMost = 8000;      // samples kept: what comes sooner than capacity / kMost after another is not
  static constexpr double kOutlier = 10.0;  // generous: model error far out is no outlier

  // model must outlive this. capacity: of the past kept, s. largest_gap: s between pressures that may still be
  // interpolated, and that the newest may be older than a pose.
  RegistrationBuffer(const StiffnessModel& model, double capacity, double largest_gap);

  // Gauge pressures, Pa, one per chamber; time: s. When it goes back by more than a second the clock was set back, and
  // all is forgotten.
  void addPressures(PressuresRef pressures, double time);
  // X_AS: finite. tip_wrench: known dead wrench at T, base axes. A pose equal to the last one is left out: a tracker
  // that repeats itself has lost its sensor.
  void addPose(const Pose& X_AS, const Wrench& tip_wrench, bool in_contact, double time);

  LiveRegistration fit(const RegistrationWindow& window) const;

 private:
  struct Actuation {
    double time = 0.0;  // s
    Pressures measured, effective;  // Pa, one per chamber; after creep
  };
  struct Sighting {
    double time = 0.0;  // s
    Pose X_AS;
    Wrench tip_wrench = Wrench::Zero();
    bool in_contact = false;
  };
  // A sighting with what acted at its time.
  struct Pair {
    const Sighting* seen;
    Pressures effective;
  };

  // Forgets all if `time` is more than a second before the last entry of the track.
  template <class Entry>
  void forgetIfSetBack(const std::deque<Entry>& track, double time);
  // What the buffer holds, as a recording of measured pressures, and the pair of each of its samples.
  Recording paired(std::vector<Pair>& pairs) const;

  const StiffnessModel& model_;
  double capacity_, spacing_, largest_gap_;
  SceneCreep creep_;
  std::deque<Actuation> actuations_;
  std::deque<Sighting> sightings_;
};

}  // namespace live_stiffness
