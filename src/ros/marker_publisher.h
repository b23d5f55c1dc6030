#pragma once
// Publishes pictures on ~markers. Viewers keep a marker until they are told to delete it, also when its node ends.

#include <ros/node_handle.h>
#include <ros/single_subscriber_publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <set>
#include <string>
#include <utility>

namespace live_stiffness {

// Which markers viewers may still show.
class ShownMarkers {
 public:
  // frame: of the markers.
  explicit ShownMarkers(std::string frame) : frame_(std::move(frame)) {}

  // The picture, with a DELETE for each marker that an earlier one had and this one has not. It is repeated in every
  // picture, because messages may be lost.
  visualization_msgs::MarkerArray withDeletions(visualization_msgs::MarkerArray picture) {
    std::set<Id> missing = shown_;
    for (const Marker& marker : picture.markers) {
      shown_.emplace(marker.ns, marker.id);
      missing.erase({marker.ns, marker.id});
    }
    for (const auto& [name, id] : missing) {
      picture.markers.push_back(deletion(Marker::DELETE));
      picture.markers.back().ns = name;
      picture.markers.back().id = id;
    }
    return picture;
  }
  // Deletes all, whoever has drawn it.
  visualization_msgs::MarkerArray clearing() const {
    visualization_msgs::MarkerArray picture;
    picture.markers = {deletion(Marker::DELETEALL)};
    return picture;
  }

 private:
  using Marker = visualization_msgs::Marker;
  using Id = std::pair<std::string, int>;

  Marker deletion(int action) const {
    Marker marker;
    marker.header.frame_id = frame_;
    marker.action = action;
    return marker;
  }

  std::string frame_;
  std::set<Id> shown_;
};

class MarkerPublisher {
 public:
  // A viewer that connects is first told to delete what an earlier run has left there.
  MarkerPublisher(ros::NodeHandle private_node, const std::string& frame)
      : shown_(frame),
        publisher_(private_node.advertise<visualization_msgs::MarkerArray>(
            "markers", 1, [this](const ros::SingleSubscriberPublisher& viewer) { viewer.publish(shown_.clearing()); })) {}

  void publish(visualization_msgs::MarkerArray picture) { publisher_.publish(shown_.withDeletions(std::move(picture))); }

 private:
  ShownMarkers shown_;
  ros::Publisher publisher_;
};

}  // namespace live_stiffness
