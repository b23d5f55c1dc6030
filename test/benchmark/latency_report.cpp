// latency_report: how long it takes from the stamp of a pressure message to its estimate in a subscriber's callback, of a
// running stiffness_node or with --nodelet of one that it loads into itself. Prints a row of docs/latency.md, for
// scripts/latency.

#include <live_stiffness/ChamberPressures.h>
#include <live_stiffness/StiffnessEstimate.h>
#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <atomic>
#include <boost/program_options.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace {

using live_stiffness::ChamberPressures;
using live_stiffness::StiffnessEstimate;

constexpr int kChambers = 6;  // of the scene that scripts/latency loads

// Publishes pressures, each its own, and times the estimate of each.
class Stopwatch {
 public:
  explicit Stopwatch(ros::NodeHandle node)
      : publisher_(node.advertise<ChamberPressures>("chamber_pressures", 1000)), spinner_(1, &queue_) {
    node.setCallbackQueue(&queue_);
    subscriber_ = node.subscribe("stiffness_node/estimate", 1000, &Stopwatch::onEstimate, this,
                                 ros::TransportHints().tcpNoDelay());
    spinner_.start();
  }

  // False unless the node is there within 10 s.
  bool waitForNode() const {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(10.0);
    while (publisher_.getNumSubscribers() == 0 || subscriber_.getNumPublishers() == 0) {
      if (!ros::ok() || ros::WallTime::now() > end) return false;
      ros::WallDuration(0.01).sleep();  // between two looks
    }
    return true;
  }

  // rate: Hz; 0: the next as soon as the last is answered.
  void measure(double rate, double seconds, const std::string& label) {
    const ros::WallTime start = ros::WallTime::now(), end = start + ros::WallDuration(seconds);
    ros::WallTime next = start;
    latencies_.reserve(static_cast<size_t>(seconds * (rate > 0.0 ? rate : 50000.0)));
    long sent = 0;
    while (ros::ok() && ros::WallTime::now() < end) {
      publish(sent++);
      if (rate > 0.0) ros::WallTime::sleepUntil(next += ros::WallDuration(1.0 / rate));
      else if (!waitForAnswers(sent)) break;
    }
    const double reached = static_cast<double>(sent) / (ros::WallTime::now() - start).toSec();
    waitForAnswers(sent);
    subscriber_.shutdown();
    spinner_.stop();
    std::sort(latencies_.begin(), latencies_.end());
    const auto us = [&](double share) {
      return latencies_.empty() ? NAN : 1e6 * latencies_[static_cast<size_t>(share * (latencies_.size() - 1))];
    };
    const std::string asked = rate > 0.0 ? std::to_string(std::lround(rate)) + " Hz" : "as fast as it goes";
    std::printf("| %s | %s | %.0f | %ld | %ld | %.0f | %.0f | %.0f |\n", label.c_str(), asked.c_str(), reached, sent,
                sent - answered_.load(), us(0.5), us(0.99), us(1.0));
  }

 private:
  void publish(long count) const {
    const auto message = boost::make_shared<ChamberPressures>();
    // A wave with steps of kilopascals, so that each is beyond the threshold and is solved.
    for (int k = 0; k < kChambers; ++k)
      message->pressure.push_back(40e3 + 30e3 * std::sin(0.1 * count + 2.0 * (k / 2)) + (count % 2) * 2e3);
    message->header.seq = static_cast<uint32_t>(count + 1);  // within a process roscpp does not number them
    message->header.stamp = ros::Time::now();
    publisher_.publish(message);
  }

  // False if they do not come within 2 s.
  bool waitForAnswers(long count) const {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(2.0);
    while (ros::ok() && answered_ < count) {
      if (ros::WallTime::now() > end) return false;
      std::this_thread::yield();
    }
    return true;
  }

  void onEstimate(const StiffnessEstimate::ConstPtr& message) {
    const ros::Time now = ros::Time::now();
    if (message->stale || message->header.stamp == newest_) return;  // a heartbeat's
    newest_ = message->header.stamp;
    latencies_.push_back((now - newest_).toSec());
    ++answered_;
  }

  ros::Publisher publisher_;
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  ros::Subscriber subscriber_;
  std::vector<double> latencies_;  // s
  std::atomic<long> answered_{0};
  ros::Time newest_;
};

}  // namespace

int main(int argc, char** argv) {
  namespace po = boost::program_options;
  double rate = 0.0, seconds = 0.0;
  std::string label;
  po::options_description description("latency_report [OPTION...]");
  description.add_options()
    ("nodelet", "load the nodelet into this process; else a running stiffness_node is measured")
    ("rate-hz", po::value(&rate)->required(), "of pressures; 0: the next as soon as the last is answered")
    ("seconds", po::value(&seconds)->required(), "so long")
    ("label", po::value(&label)->required(), "first column of the row");
  po::variables_map given;
  try {
    po::store(po::parse_command_line(argc, argv, description), given);
    po::notify(given);
  } catch (const po::error& error) {
    std::cerr << "latency_report: " << error.what() << "\n" << description;
    return 2;
  }
  ros::init(argc, argv, "latency_report", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  nodelet::Loader loader(false);
  if (given.count("nodelet") &&
      !loader.load("/stiffness_node", "live_stiffness/StiffnessNodelet", nodelet::M_string(), nodelet::V_string())) {
    std::cerr << "latency_report: the nodelet cannot be loaded\n";
    return 2;
  }
  Stopwatch stopwatch(node);
  if (!stopwatch.waitForNode()) {
    std::cerr << "latency_report: no /stiffness_node within 10 s: start it, or use --nodelet\n";
    return 2;
  }
  stopwatch.measure(rate, seconds, label);
  return 0;
}
