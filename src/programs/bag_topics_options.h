#pragma once
// Command line options for the topics of a bag.

#include <boost/program_options.hpp>

#include "bags/bag_reader.h"

namespace live_stiffness {

// topics: the defaults, and gets what is given.
inline void addOptions(boost::program_options::options_description& options, BagTopics& topics) {
  using boost::program_options::value;
  options.add_options()
    ("pressures", value(&topics.pressures)->default_value(topics.pressures), "topic of the pressures in a bag")
    ("pose", value(&topics.pose)->default_value(topics.pose), "topic of the tracker")
    ("tip-wrench", value(&topics.wrench)->default_value(topics.wrench), "topic of the tip wrench");
}

}  // namespace live_stiffness
