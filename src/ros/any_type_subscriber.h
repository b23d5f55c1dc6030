#pragma once
// Subscribes to a topic whose message type is found at run time.

#include <ros/master.h>
#include <ros/node_handle.h>
#include <topic_tools/shape_shifter.h>

#include <string>

namespace live_stiffness {

// A message of any type, with the name of its publisher.
using AnyMessage = ros::MessageEvent<const topic_tools::ShapeShifter>;

// roscpp keeps the type of the first publisher until it subscribes again. This class subscribes again when all publishers
// are gone, so that the next one may have another type.
class AnyTypeSubscriber {
 public:
  AnyTypeSubscriber() = default;
  AnyTypeSubscriber(const AnyTypeSubscriber&) = delete;  // the callback refers to it

  // Calls receiver->callback() in the thread of the node handle's queue.
  template <class Receiver>
  void subscribe(const ros::NodeHandle& node, const std::string& topic, int queue_size,
                 void (Receiver::*callback)(const AnyMessage&), Receiver* receiver) {
    node_ = node;
    options_.initByFullCallbackType<const AnyMessage&>(topic, queue_size, [=](const AnyMessage& message) {
      had_publisher_ = true;  // also one that is gone before the timer sees it
      (receiver->*callback)(message);
    });
    options_.transport_hints = ros::TransportHints().tcpNoDelay();
    subscriber_ = node_.subscribe(options_);
    timer_ = node_.createWallTimer(ros::WallDuration(0.1), &AnyTypeSubscriber::onTimer, this);
  }

 private:
  void onTimer(const ros::WallTimerEvent&) {
    if (subscriber_.getNumPublishers() > 0) {
      had_publisher_ = true;
    } else if (had_publisher_ && ros::master::check()) {  // subscribing without a master would block
      had_publisher_ = false;
      subscriber_.shutdown();  // first: two subscribers of one process share the type
      subscriber_ = node_.subscribe(options_);
    }
  }

  ros::NodeHandle node_;
  ros::SubscribeOptions options_;
  ros::Subscriber subscriber_;
  ros::WallTimer timer_;
  bool had_publisher_ = false;
};

}  // namespace live_stiffness
