#include "estimation/registration_buffer.h"

#include <algorithm>
#include <numeric>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

// Appends to a track in order of time and drops what is too old.
template <class Entry>
void append(std::deque<Entry>& track, Entry entry, double capacity) {
  track.push_back(std::move(entry));
  while (track.back().time - track.front().time > capacity) track.pop_front();
}

template <class Entry>
bool isDue(const std::deque<Entry>& track, double time, double spacing) {
  return track.empty() || (time > track.back().time && time >= track.back().time + spacing);
}

LiveRegistration refused(LiveRegistration result, const std::string& fault) {
  result.fault = fault;
  return result;
}

RegistrationFit fitWithoutOutliers(std::vector<Pose>& X_BT, std::vector<Pose>& X_AS,
                                   std::optional<TrackerMeasures> measures, int& outliers) {
  const std::vector<double> residuals = fitRegistration(X_BT, X_AS, measures).residuals;
  const double limit = RegistrationBuffer::kOutlier * quantile(residuals, 0.5);
  size_t kept = 0;
  for (size_t i = 0; i < residuals.size(); ++i) {
    if (residuals[i] > limit) continue;
    X_BT[kept] = X_BT[i];
    X_AS[kept++] = X_AS[i];
  }
  outliers = static_cast<int>(residuals.size() - kept);
  X_BT.resize(kept);
  X_AS.resize(kept);
  return fitRegistration(X_BT, X_AS, measures);  // more than half are left: the median is below the limit
}

}  // namespace

RegistrationBuffer::RegistrationBuffer(const StiffnessModel& model, double capacity, double largest_gap)
    : model_(model), capacity_(capacity), spacing_(capacity / kMost), largest_gap_(largest_gap), creep_(model.scene()) {}

template <class Entry>
void RegistrationBuffer::forgetIfSetBack(const std::deque<Entry>& track, double time) {
  constexpr double kClockSet = 1.0;  // s
  if (track.empty() || time >= track.back().time - kClockSet) return;
  actuations_.clear();
  sightings_.clear();
}

void RegistrationBuffer::addPressures(PressuresRef pressures, double time) {
  forgetIfSetBack(actuations_, time);
  if (pressures.size() != model_.scene().chamberCount() || !isDue(actuations_, time, spacing_)) return;
  append(actuations_, {time, pressures, creep_.update(pressures, time)}, capacity_);
}

void RegistrationBuffer::addPose(const Pose& X_AS, const Wrench& tip_wrench, bool in_contact, double time) {
  forgetIfSetBack(sightings_, time);
  const bool repeated = !sightings_.empty() && X_AS.p == sightings_.back().X_AS.p && X_AS.R == sightings_.back().X_AS.R;
  if (repeated || !isDue(sightings_, time, spacing_)) return;
  append(sightings_, {time, X_AS, tip_wrench, in_contact}, capacity_);
}

Recording RegistrationBuffer::paired(std::vector<Pair>& pairs) const {
  Recording recording;
  auto after = actuations_.begin();  // first one not before the sighting
  for (const Sighting& seen : sightings_) {
    while (after != actuations_.end() && after->time < seen.time) ++after;
    if (after == actuations_.begin() && after->time > seen.time) continue;
    const Actuation& before = after == actuations_.begin() ? *after : *std::prev(after);
    const Actuation& next = after == actuations_.end() ? before : *after;
    const double gap = next.time - before.time;
    if (std::max(gap, seen.time - before.time) > largest_gap_) continue;
    const double share = gap > 0.0 ? (seen.time - before.time) / gap : 0.0;
    RecordedSample sample;
    sample.time = seen.time;
    sample.pressures = before.measured + share * (next.measured - before.measured);
    recording.samples.push_back(std::move(sample));
    pairs.push_back({&seen, before.effective + share * (next.effective - before.effective)});
  }
  return recording;
}

LiveRegistration RegistrationBuffer::fit(const RegistrationWindow& window) const {
  LiveRegistration result;
  if (actuations_.empty()) return refused(result, "no pressures yet: the model needs them to predict the tip");
  if (sightings_.empty()) return refused(result, "no tracker poses yet: does the tracker see its sensor?");
  std::vector<Pair> pairs;
  const Recording recording = paired(pairs);
  const std::string span = " of the last " + numberText(window.duration) + " s";
  if (pairs.empty())
    return refused(result, "none of the tracker poses has pressures within " + numberText(largest_gap_) +
                               " s of its time stamp: do tracker and pressures share a clock?");
  // Quasi-static by all that is known, so that what moved just before the window counts.
  std::vector<int> chosen(pairs.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  const auto leave_out = [&](auto condition) {
    chosen.erase(std::remove_if(chosen.begin(), chosen.end(), condition), chosen.end());
    return static_cast<int>(chosen.size());
  };
  const double oldest = sightings_.back().time - window.duration;
  result.poses = leave_out([&](int i) { return pairs[i].seen->time < oldest; });
  int left = result.poses;
  if (window.leave_out_contact) left = leave_out([&](int i) { return pairs[i].seen->in_contact; });
  const int untouched = left;
  if (window.quasi_static_only) {
    const std::vector<int> still = quasiStaticSamples(recording);
    left = leave_out([&](int i) { return !std::binary_search(still.begin(), still.end(), i); });
  }
  std::vector<Pose> X_BT, X_AS;
  StiffnessWorkspace workspace = model_.makeWorkspace();
  double first = 0.0, last = 0.0;
  for (int i : chosen) {
    const Pair& pair = pairs[i];
    const StiffnessSolution solution = model_.solve(pair.effective, pair.seen->tip_wrench, workspace);
    if (!solution.status.ok()) continue;
    if (X_BT.empty()) first = pair.seen->time;
    last = pair.seen->time;
    X_BT.push_back(solution.X_BT);
    X_AS.push_back(pair.seen->X_AS);
  }
  result.used = static_cast<int>(X_BT.size());
  result.span = last - first;
  if (result.used < kFewest) {
    std::string why = std::to_string(result.used) + " usable samples" + span + ": must be at least " +
                      std::to_string(kFewest);
    if (left < kFewest && untouched >= kFewest)
      why += "; the other " + std::to_string(untouched - left) + " are not quasi-static: hold the pressures still " +
             "for some seconds in several bent poses, or do without quasi_static_only";
    else if (untouched < kFewest && result.poses >= kFewest)
      why += "; the other " + std::to_string(result.poses - untouched) + " were taken in contact: leave the tip " +
             "alone, or do without leave_out_contact";
    else why += "; let the robot move for a while first, or ask for a longer duration";
    return refused(result, why);
  }
  result.fit = fitWithoutOutliers(X_BT, X_AS, window.measures, result.outliers);
  result.used -= result.outliers;
  return result;
}

std::string LiveRegistration::text() const {
  const auto angle = [](double value) { return fixedText(degrees(value), 2); };
  std::string text = std::to_string(used) + " samples over " + numberText(span) + " s, " + std::to_string(outliers) +
                     " outliers left out\ntip error after registration: " + millimetreText(fit.position) + "\n";
  if (fit.rotation.count > 0)
    text += (fit.measures == TrackerMeasures::kPose ? "rotation: mean " : "z axis: mean ") + angle(fit.rotation.mean) + ", RMS " +
            angle(fit.rotation.rms) + ", max " + angle(fit.rotation.max) + " deg\n";
  if (fit.orientations_fit && !fit.orientations.empty()) text += fit.orientations + "\n";
  if (!fit.unmeasured().empty()) text += fit.unmeasured() + "\n";
  return text + (fit.determined() ? "determined by the motion" : "NOT determined: " + fit.advice());
}

}  // namespace live_stiffness
