#include "force_sensor_options.h"

#include <algorithm>

#include "live_stiffness/checks.h"

namespace po = boost::program_options;

namespace live_stiffness {
namespace {

const std::vector<std::string> kChannels = {"fx", "fy", "fz", "mx", "my", "mz"};

}  // namespace

void ForceSensorOptions::addTo(po::options_description& options) {
  options.add_options()
    ("force-sensor-azimuth-deg", po::value(&azimuth_deg_)->default_value(0.0), "turn of the force sensor about z of T")
    ("force-sensor-height-m", po::value(&height_)->default_value(0.0), "its origin above T")
    ("force-sensor-sign", po::value(&sign_)->default_value(1.0), "1: reports what acts on the robot; -1: the opposite")
    ("force-sensor-crosstalk-x", po::value(&crosstalk_x_)->default_value(0.0),
     "share of its fz that appears in fx (crosstalk, or a tilted axis), which is subtracted")
    ("force-sensor-crosstalk-y", po::value(&crosstalk_y_)->default_value(0.0), "the same in fy")
    ("force-sensor-delay-s", po::value(&delay_)->default_value(0.0), "delay of its readings relative to the pressures")
    ("force-sensor-channels", po::value(&channels_)->multitoken(),
     "its channels to use, of fx fy fz mx my mz in its own axes (all); the others count as zero");
}

ForceSensorMount ForceSensorOptions::mount() const {
  FaultList faults("force sensor");
  faults.check("force-sensor-azimuth-deg", azimuth_deg_, Range::finite());
  faults.check("force-sensor-height-m", height_, Range::finite());
  faults.check("force-sensor-crosstalk-x", crosstalk_x_, {-1.0, 1.0});
  faults.check("force-sensor-crosstalk-y", crosstalk_y_, {-1.0, 1.0});
  faults.check("force-sensor-delay-s", delay_, {-1.0, 1.0});
  if (sign_ != 1.0 && sign_ != -1.0) faults.add("force-sensor-sign = " + numberText(sign_) + ": must be 1 or -1");
  ForceSensorMount mount{radians(azimuth_deg_), height_, sign_};
  mount.crosstalk = {crosstalk_x_, crosstalk_y_};
  mount.delay = delay_;
  if (!channels_.empty()) mount.gains.setZero();
  for (const std::string& channel : channels_) {
    const auto at = std::find(kChannels.begin(), kChannels.end(), channel);
    if (at == kChannels.end()) faults.add("force-sensor-channels '" + channel + "': must be among fx fy fz mx my mz");
    else mount.gains[at - kChannels.begin()] = 1.0;
  }
  faults.throwIfAny();
  return mount;
}

std::string ForceSensorOptions::text(const ForceSensorMount& mount) {
  std::string channels;
  for (size_t k = 0; k < kChannels.size() && mount.gains != Wrench::Ones(); ++k)
    if (mount.gains[static_cast<long>(k)] != 0.0) channels += " " + kChannels[k];
  return "--force-sensor-sign " + numberText(mount.sign) +
         " --force-sensor-azimuth-deg " + numberText(degrees(mount.azimuth)) +
         " --force-sensor-height-m " + numberText(mount.height) +
         " --force-sensor-crosstalk-x " + numberText(mount.crosstalk[0]) +
         " --force-sensor-crosstalk-y " + numberText(mount.crosstalk[1]) +
         " --force-sensor-delay-s " + numberText(mount.delay) +
         (channels.empty() ? "" : " --force-sensor-channels" + channels);
}

}  // namespace live_stiffness
