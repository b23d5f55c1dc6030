// latency_report: measures from pressure stamp to estimate, of a running stiffness_node or with --nodelet of one that it
// loads into itself: until the estimate is delivered, in the queue of a subscriber, and until that subscriber's own thread
// has it. Prints one row for each rate, for scripts/latency. To see it against: with --bare-wake what it takes this machine
// to wake a thread, with --echo what TCPROS takes to a node that only sends the pressures back, and from there.

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
#include <deque>
#include <iostream>
#include <mutex>
#include <thread>
#include <vector>

#include "bare_wake.h"
#include "latencies.h"
#include "progress_bar.h"
#include "stolen_time.h"

namespace {

using live_stiffness::ChamberPressures;
using live_stiffness::StiffnessEstimate;

constexpr double kPatience = 10.0;  // s

// Notes when each callback was delivered; asked in the order of the calls.
class TimedQueue : public ros::CallbackQueue {
 public:
  void addCallback(const ros::CallbackInterfacePtr& callback, uint64_t removal_id) override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      delivered_.push_back(ros::Time::now());
    }
    ros::CallbackQueue::addCallback(callback, removal_id);
  }
  ros::Time nextDelivered() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (delivered_.empty()) return ros::Time::now();
    const ros::Time time = delivered_.front();
    delivered_.pop_front();
    return time;
  }

 private:
  std::mutex mutex_;
  std::deque<ros::Time> delivered_;
};

// Publishes pressures, each its own, and times the estimate of each, or the echo on topic "echo".
class Stopwatch {
 public:
  Stopwatch(ros::NodeHandle node, int channels, bool is_echo)
      : channels_(channels),
        is_echo_(is_echo),
        publisher_(node.advertise<ChamberPressures>("chamber_pressures", 1000)),
        spinner_(1, &queue_) {
    node.setCallbackQueue(&queue_);
    const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
    subscriber_ = is_echo ? node.subscribe("echo", 1000, &Stopwatch::onEcho, this, hints)
                          : node.subscribe("stiffness_node/estimate", 1000, &Stopwatch::onEstimate, this, hints);
    spinner_.start();
  }

  bool waitForNode() {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
    while (ros::ok() && ros::WallTime::now() < end) {
      if (publisher_.getNumSubscribers() > 0 && subscriber_.getNumPublishers() > 0) return true;
      if (is_echo_) publish(0);  // a relay advertises by the first message
      ros::WallDuration(0.01).sleep();  // between two looks
    }
    return false;
  }

  // rate: Hz; 0: the next as soon as the last is answered. Rows are printed in microseconds.
  void measure(double rate, double seconds, const std::string& transport) {
    for (std::vector<double>* latencies : {&delivered_, &received_}) {
      latencies->clear();
      latencies->reserve(static_cast<size_t>(seconds * (rate > 0.0 ? rate : 20000.0)));
    }
    answered_ = 0;
    solve_time_ = error_ = 0.0;
    live_stiffness::ProgressBar bar(transport + ", " + (rate > 0.0 ? std::to_string(int(rate)) + " Hz" : "as fast as it goes"),
                                    static_cast<long>(seconds));
    const live_stiffness::StolenTime stolen;
    const ros::WallTime start = ros::WallTime::now();
    ros::WallTime next = start;
    long sent = 0;
    for (double time = 0.0; ros::ok() && time < seconds; time = (ros::WallTime::now() - start).toSec()) {
      bar.update(static_cast<long>(time));
      publish(sent++);
      if (rate > 0.0) {
        next += ros::WallDuration(1.0 / rate);
        ros::WallTime::sleepUntil(next);
      } else if (!waitForAnswers(sent)) {
        break;
      }
    }
    waitForAnswers(sent);
    bar.update(static_cast<long>(seconds));
    print(transport, rate, sent, (ros::WallTime::now() - start).toSec(), stolen.rate());
  }

 private:
  void publish(long count) {
    const auto message = boost::make_shared<ChamberPressures>();
    message->pressure.resize(channels_);
    // A wave with steps of kilopascals, so that each is beyond the threshold and is solved.
    for (int k = 0; k < channels_; ++k) {
      const int pair = k / 2;
      message->pressure[k] = 40e3 + 30e3 * std::sin(0.1 * count + 2.0 * pair) + (count % 2) * 2e3;
    }
    message->header.seq = static_cast<uint32_t>(count + 1);  // within a process roscpp does not number them
    message->header.stamp = ros::Time::now();
    publisher_.publish(message);
  }

  bool waitForAnswers(long count) const {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(2.0);
    while (ros::ok() && answered_ < count) {
      if (ros::WallTime::now() > end) return false;
      std::this_thread::yield();
    }
    return true;
  }

  void onEstimate(const StiffnessEstimate::ConstPtr& message) {
    const ros::Time now = ros::Time::now(), delivered = queue_.nextDelivered();
    if (message->stale || message->header.stamp == newest_) return;  // a heartbeat's
    newest_ = message->header.stamp;
    solve_time_ += message->solve_time;
    error_ = std::max(error_, message->numerical_error);
    note(message->header.stamp, delivered, now);
  }

  void onEcho(const ChamberPressures::ConstPtr& message) {
    const ros::Time now = ros::Time::now();
    note(message->header.stamp, queue_.nextDelivered(), now);
  }

  void note(ros::Time sent, ros::Time delivered, ros::Time received) {
    delivered_.push_back((delivered - sent).toSec());
    received_.push_back((received - sent).toSec());
    ++answered_;
  }

  void print(const std::string& transport, double rate, long sent, double seconds, double stolen) {
    const live_stiffness::Latencies delivered(delivered_), received(received_);
    std::printf("%s,%g,%.0f,%ld,%ld,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1f,%.1e,%.1f\n", transport.c_str(), rate, sent / seconds,
                sent, sent - answered_.load(), delivered.at(0.5), delivered.at(0.99), delivered.at(0.999), received.at(0.5),
                received.at(0.99), received.at(0.999), received.at(1.0), 1e6 * solve_time_ / std::max(1l, answered_.load()),
                error_, stolen);
    std::fflush(stdout);
  }

  int channels_;
  bool is_echo_;
  ros::Publisher publisher_;
  TimedQueue queue_;
  ros::AsyncSpinner spinner_;
  ros::Subscriber subscriber_;
  std::vector<double> delivered_, received_;  // s
  std::atomic<long> answered_{0};
  ros::Time newest_;
  double solve_time_ = 0.0, error_ = 0.0;  // sum, s; largest estimated relative error
};

}  // namespace

int main(int argc, char** argv) {
  namespace options = boost::program_options;
  struct {
    double seconds, minutes;
    int channels;
  } wanted{};
  options::options_description description("latency_report [OPTION...]: rates and latencies of stiffness_node, as CSV");
  description.add_options()("help,h", "this text")(
      "nodelet", "load the nodelet into this process; else a running stiffness_node is measured")(
      "bare-wake", "measure, without any node, how long this machine takes to wake a waiting thread")(
      "echo", "measure a node that sends chamber_pressures back on echo, such as topic_tools' relay")(
      "channels", options::value(&wanted.channels)->default_value(6), "pressures in a message")(
      "seconds", options::value(&wanted.seconds)->default_value(20.0), "of 40 Hz, and as fast as it goes, each")(
      "minutes", options::value(&wanted.minutes)->default_value(1.0), "of 1 kHz");
  options::variables_map given;
  try {
    options::store(options::parse_command_line(argc, argv, description), given);
    options::notify(given);
    if (!(wanted.seconds > 0.0 && wanted.seconds <= 3600.0)) throw std::runtime_error("--seconds: must be in (0, 3600]");
    if (!(wanted.minutes > 0.0 && wanted.minutes <= 600.0)) throw std::runtime_error("--minutes: must be in (0, 600]");
    if (wanted.channels < 1 || wanted.channels > 1024) throw std::runtime_error("--channels: must be in [1, 1024]");
  } catch (const std::exception& error) {
    std::cerr << "latency_report: " << error.what() << "\nSee latency_report --help.\n";
    return 2;
  }
  if (given.count("help")) {
    std::cout << description;
    return 0;
  }
  ros::init(argc, argv, "latency_report");
  if (given.count("bare-wake")) {
    for (double rate : {40.0, 1000.0}) live_stiffness::measureBareWake(rate, wanted.seconds);
    return 0;
  }
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  nodelet::Loader loader(false);
  if (given.count("nodelet") &&
      !loader.load("/stiffness_node", "live_stiffness/StiffnessNodelet", nodelet::M_string(), nodelet::V_string())) {
    std::cerr << "latency_report: the nodelet cannot be loaded\n";
    return 2;
  }
  const bool is_echo = given.count("echo") > 0;
  Stopwatch stopwatch(node, wanted.channels, is_echo);
  if (!stopwatch.waitForNode()) {
    std::cerr << "latency_report: no " << (is_echo ? "relay from chamber_pressures to echo" : "/stiffness_node")
              << " within " << kPatience << " s: start it, or use --nodelet\n";
    return 2;
  }
  const std::string transport = is_echo ? "echo" : given.count("nodelet") ? "nodelet" : "TCPROS";
  stopwatch.measure(40.0, wanted.seconds, transport);
  stopwatch.measure(1000.0, 60.0 * wanted.minutes, transport);
  stopwatch.measure(0.0, wanted.seconds, transport);
  return 0;
}
