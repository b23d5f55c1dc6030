#pragma once
// Command line options for the mount of a recording's force sensor on the tip.

#include <algorithm>
#include <boost/program_options.hpp>
#include <string>
#include <vector>

#include "calibration/force_sensor.h"
#include "estimation/input_parameters.h"
#include "parameter_options.h"

namespace live_stiffness {

class ForceSensorOptions {
 public:
  void addTo(boost::program_options::options_description& options) {
    using boost::program_options::value;
    addOptions(options, mount_);
    options.add_options()
      ("force-sensor-sign", value(&mount_.sign)->default_value(1.0), "1: reports what acts on the robot; -1: the opposite")
      ("force-sensor-frame", value(&frame_),
       "frame_id of its messages, if that is no frame that the package knows: its axes are turned as the azimuth says")
      ("force-sensor-channels", value(&channels_)->multitoken(),
       "its channels to use, of fx fy fz mx my mz in its own axes (all); the others count as zero");
  }

  // Throws ConfigurationError with every value that is out of range.
  ForceSensorMount mount() const {
    FaultList faults("force sensor");
    ForceSensorMount mount = mount_;
    faults.checkAll(mount);
    if (mount.sign != 1.0 && mount.sign != -1.0)
      faults.add("force-sensor-sign = " + numberText(mount.sign) + ": must be 1 or -1");
    if (!channels_.empty()) mount.gains.setZero();
    for (const std::string& channel : channels_) {
      const auto at = std::find(kChannels.begin(), kChannels.end(), channel);
      if (at == kChannels.end()) faults.add("force-sensor-channels '" + channel + "': must be among fx fy fz mx my mz");
      else mount.gains[at - kChannels.begin()] = 1.0;
    }
    faults.throwIfAny();
    return mount;
  }

  // The mount for a recording whose wrenches have this frame_id. Throws ConfigurationError, too, if the axes are not known.
  ForceSensorMount mountFor(const std::string& frame, const FrameNames& frames) const {
    ForceSensorMount found = mount();
    found.in_base_axes = frame == frames.base;
    if (!frame.empty() && frame != frames.base && frame != frames.body && frame != "tip_force_sensor" && frame != frame_)
      throw ConfigurationError("force sensor", {"unknown frame " + frame + ": must be " + frames.base + ", " + frames.body +
                                                " or tip_force_sensor, or be told by --force-sensor-frame " + frame +
                                                " with the azimuth of its axes"});
    return found;
  }

  // A mount as such options, for example the result of a calibration.
  static std::string text(const ForceSensorMount& mount) {
    std::string text = "--force-sensor-sign " + numberText(mount.sign), channels;
    ForceSensorMount::forEachParameter(mount, [&](const NumberParameter& parameter, double value) {
      text += " --" + optionName(parameter.key) + " " + numberText(value / parameter.unit);
    });
    for (size_t k = 0; k < kChannels.size() && mount.gains != Wrench::Ones(); ++k)
      if (mount.gains[static_cast<long>(k)] != 0.0) channels += " " + kChannels[k];
    return text + (channels.empty() ? "" : " --force-sensor-channels" + channels);
  }

 private:
  static inline const std::vector<std::string> kChannels{"fx", "fy", "fz", "mx", "my", "mz"};

  ForceSensorMount mount_;
  std::vector<std::string> channels_;
  std::string frame_;
};

}  // namespace live_stiffness
