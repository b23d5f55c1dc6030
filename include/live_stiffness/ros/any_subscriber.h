#pragma once
// One topic whose messages may have any type. A message of type Own that is published in the same process (a nodelet's
// manager) is handed over as it is, without a copy; any other comes as its bytes.

#include <ros/node_handle.h>
#include <topic_tools/shape_shifter.h>

#include <functional>
#include <string>

namespace live_stiffness {

template <class Own>
class AnyMessage : public ros::SubscriptionCallbackHelper {
 public:
  using TakeOwn = std::function<void(const Own& message, const std::string& publisher)>;
  using TakeBytes = std::function<void(const topic_tools::ShapeShifter& message, const std::string& publisher)>;

  AnyMessage(TakeOwn take_own, TakeBytes take_bytes)
      : take_own_(std::move(take_own)), take_bytes_(std::move(take_bytes)), reader_(Reader::Callback()) {}

  // roscpp calls this for bytes only, and call() with the result right after it in the same thread.
  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    return bytes_ = reader_.deserialize(params);
  }
  void call(ros::SubscriptionCallbackHelperCallParams& params) override {
    const ros::VoidConstPtr message = params.event.getConstMessage();
    const std::string& publisher = params.event.getPublisherName();
    if (message == bytes_) take_bytes_(*static_cast<const topic_tools::ShapeShifter*>(message.get()), publisher);
    else take_own_(*static_cast<const Own*>(message.get()), publisher);
    bytes_.reset();
  }
  const std::type_info& getTypeInfo() override { return typeid(Own); }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  using Reader = ros::SubscriptionCallbackHelperT<const topic_tools::ShapeShifter::ConstPtr&>;

  TakeOwn take_own_;
  TakeBytes take_bytes_;
  Reader reader_;
  ros::VoidConstPtr bytes_;
};

// The callbacks must not be called after what they refer to is gone: shut the subscriber down first.
template <class Own>
ros::Subscriber subscribeAny(ros::NodeHandle node, const std::string& topic, int queue_size,
                             typename AnyMessage<Own>::TakeOwn take_own,
                             typename AnyMessage<Own>::TakeBytes take_bytes) {
  ros::SubscribeOptions options(topic, queue_size, "*", "*");
  options.helper = boost::make_shared<AnyMessage<Own>>(std::move(take_own), std::move(take_bytes));
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return node.subscribe(options);
}

}  // namespace live_stiffness
