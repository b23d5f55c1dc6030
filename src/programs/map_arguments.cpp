#include "map_arguments.h"

#include <cmath>
#include <cstdlib>

namespace live_stiffness {

bool readNumbers(const std::string& text, char separator, std::vector<double>& numbers) {
  const char* rest = text.c_str();
  while (true) {
    char* end = nullptr;
    numbers.push_back(std::strtod(rest, &end));
    if (end == rest) return false;
    if (*end == '\0') return true;
    if (*end != separator) return false;
    rest = end + 1;
  }
}

std::vector<PressureRange> readRanges(const MapArguments& arguments, FaultList& faults) {
  std::vector<PressureRange> ranges;
  const size_t wanted = arguments.random > 0 ? 2 : 3;
  for (const std::string& text : arguments.pressures) {
    std::vector<double> numbers;
    const bool good =
        readNumbers(text, ':', numbers) && (numbers.size() == 3 || numbers.size() == wanted) &&
        (numbers.size() < 3 || (numbers[2] >= 1.0 && numbers[2] <= 1e9 && numbers[2] == std::floor(numbers[2])));
    if (good) ranges.push_back({numbers[0], numbers[1], numbers.size() > 2 ? static_cast<long>(numbers[2]) : 1});
    else
      faults.add("pressures = " + text + ": must be FROM:TO:COUNT, gauge pressures in Pa and a whole number from 1 to 1e9" +
                 (wanted == 2 ? "; with --random FROM:TO will do" : "") + ", for example 0:1e5:21");
  }
  return ranges;
}

ChannelMap readChannels(const MapArguments& arguments, int chambers) {
  if (arguments.channel_of_chamber.empty())
    return ChannelMap::even(arguments.channels > 0 ? arguments.channels : chambers, chambers);
  std::vector<double> numbers;
  std::vector<int> channels;
  bool good = readNumbers(arguments.channel_of_chamber, ',', numbers);
  for (double number : numbers) {
    good = good && number >= 0.0 && number < ChannelMap::kMaxChannels && number == std::floor(number);
    channels.push_back(good ? static_cast<int>(number) : 0);
  }
  if (!good)
    throw ConfigurationError("options", {"channel-of-chamber = " + arguments.channel_of_chamber +
                                         ": must be the channel of each chamber from 0, for example 0,0,1,1,2,2"});
  return ChannelMap(channels);
}

}  // namespace live_stiffness
