#include "map_arguments.h"

#include <cmath>
#include <optional>

#include "csv_table.h"

namespace live_stiffness {

std::vector<PressureRange> readRanges(const MapArguments& arguments, FaultList& faults) {
  std::vector<PressureRange> ranges;
  const bool needs_count = arguments.random == 0;
  for (const std::string& text : arguments.pressures) {
    const std::vector<double> numbers = numberList(text, ':').value_or(std::vector<double>());
    const double count = numbers.size() == 3 ? numbers[2] : 1.0;
    if ((numbers.size() == 3 || (numbers.size() == 2 && !needs_count)) && count >= 1.0 && count <= 1e9 &&
        count == std::floor(count))
      ranges.push_back({numbers[0], numbers[1], static_cast<long>(count)});
    else
      faults.add("pressures = " + text + ": must be FROM:TO:COUNT, gauge pressures in Pa and a whole number from 1 to 1e9" +
                 (needs_count ? "" : "; with --random FROM:TO will do") + ", for example 0:1e5:21");
  }
  return ranges;
}

ChannelMap readChannels(const MapArguments& arguments, int chambers) {
  if (arguments.channel_of_chamber.empty())
    return ChannelMap::even(arguments.channels > 0 ? arguments.channels : chambers, chambers);
  std::vector<int> channels;
  for (double number : numberList(arguments.channel_of_chamber, ',').value_or(std::vector<double>{-1.0})) {
    if (!(number >= 0.0 && number < kMaxChannels && number == std::floor(number)))
      throw ConfigurationError("options", {"channel-of-chamber = " + arguments.channel_of_chamber +
                                           ": must be the channel of each chamber from 0, for example 0,0,1,1,2,2"});
    channels.push_back(static_cast<int>(number));
  }
  return ChannelMap(channels);
}

}  // namespace live_stiffness
