#pragma once
// One topic whose messages may have any type. A message of type Own that is published in the same process (a nodelet's
// manager) is handed over as it is, without a copy; one of another process is decoded once; one of another type comes as
// its bytes.

#include <ros/node_handle.h>
#include <topic_tools/shape_shifter.h>

#include <functional>
#include <string>

#include "ros/conversions.h"

namespace live_stiffness {

// roscpp decodes a message once for all subscribers of a process that ask for Own, by whichever of them came first. So
// what one makes of it must be an Own to all of them: of another type it is an empty one, which carries the bytes.
template <class Own>
class AnyMessage : public ros::SubscriptionCallbackHelper {
 public:
  using TakeOwn = std::function<void(const Own& message, const std::string& publisher)>;
  using TakeBytes = std::function<void(const topic_tools::ShapeShifter& message, const std::string& publisher)>;

  AnyMessage(TakeOwn take_own, TakeBytes take_bytes)
      : take_own_(std::move(take_own)), take_bytes_(std::move(take_bytes)) {}

  // Nothing, and take_bytes is told, if a message that says to be an Own is not a whole one.
  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const topic_tools::ShapeShifter::ConstPtr bytes = bytesOf(params);
    if (bytes->getDataType() != ros::message_traits::DataType<Own>::value())
      return boost::shared_ptr<const Own>(new Own, Carrier{bytes});
    if (isWhole(*bytes)) return bytes->instantiate<Own>();
    take_bytes_(*bytes, (*params.connection_header)["callerid"]);
    return nullptr;
  }
  void call(ros::SubscriptionCallbackHelperCallParams& params) override {
    const ros::VoidConstPtr message = params.event.getConstMessage();
    const std::string& publisher = params.event.getPublisherName();
    if (const auto* carrier = boost::get_deleter<Carrier>(message)) take_bytes_(*carrier->bytes, publisher);
    else take_own_(*static_cast<const Own*>(message.get()), publisher);
  }
  const std::type_info& getTypeInfo() override { return typeid(Own); }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  struct Carrier {
    topic_tools::ShapeShifter::ConstPtr bytes;
    void operator()(const Own* message) const { delete message; }
  };

  static topic_tools::ShapeShifter::ConstPtr bytesOf(const ros::SubscriptionCallbackHelperDeserializeParams& params) {
    const auto bytes = boost::make_shared<topic_tools::ShapeShifter>();
    ros::M_string& header = *params.connection_header;
    bytes->morph(header["md5sum"], header["type"], header["message_definition"], header["latching"]);
    ros::serialization::IStream in(params.buffer, params.length);
    if (params.length > 0) bytes->read(in);  // of nothing, topic_tools copies zero bytes to a null pointer
    return bytes;
  }

  TakeOwn take_own_;
  TakeBytes take_bytes_;
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
