#include "ros/master_watch.h"

#include <ros/console.h>
#include <ros/init.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>
#include <chrono>

#include "ros/node_graph.h"

namespace live_stiffness {
namespace {

using XmlRpc::XmlRpcValue;

constexpr int kLooks = 10;  // after which the master is asked again though nothing has changed

// Every process of roscpp has it from start to end, and only it tells a master so.
std::string ownService() { return ros::this_node::getName() + "/get_loggers"; }

bool areKeys(std::vector<std::string> topics, const std::map<std::string, std::string>& known) {
  std::sort(topics.begin(), topics.end());
  return std::equal(topics.begin(), topics.end(), known.begin(), known.end(),
                    [](const std::string& topic, const auto& pair) { return topic == pair.first; });
}

std::map<std::string, std::string> ofThisNode(XmlRpcValue& pairs) {
  const auto names = byNode(pairs);
  std::map<std::string, std::string> own;
  for (auto [name, end] = names.equal_range(ros::this_node::getName()); name != end; ++name) own[name->second] = "*";
  return own;
}

}  // namespace

MasterWatch::~MasterWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void MasterWatch::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  do {  // at once for the first time: a master that goes away before is not known well enough to tell the next one
    lock.unlock();
    try {
      look();
    } catch (const XmlRpc::XmlRpcException& error) {
      ROS_WARN("master: answer not understood: %s", error.getMessage().c_str());
    }
    lock.lock();
  } while (!wake_.wait_for(lock, std::chrono::seconds(1), [this] { return stop_; }));
}

void MasterWatch::look() {
  XmlRpcValue pid, answer;
  if (!askMaster("getPid", pid)) {
    if (!is_away_ && !ros::isShuttingDown())
      ROS_WARN("the master at %s does not answer: what is connected goes on, but nodes that start now find nobody",
               ros::master::getURI().c_str());
    is_away_ = true;
    return;
  }
  // Not lookupNode: what roscpp goes on to tell a new master, or another node tells it of this one, would make it known.
  // Not the process number alone: in a container every master may have the same.
  const bool is_known = askMaster("lookupService", answer, ownService());
  if (ros::isShuttingDown()) return;  // asked last: shutting down is why it may not be known
  if (is_known && (pid_ == 0 || pid_ == static_cast<int>(pid))) {
    remember();
  } else if (!uri_.empty()) {
    ROS_WARN("the master was restarted: registering there anew");
    if (parameters_.valid() && !askMaster("getParam", answer, namespace_))
      askMaster("setParam", answer, namespace_, parameters_);
    registerAnew();
  }
  pid_ = static_cast<int>(pid);
  is_away_ = false;
}

// Whether topics of this process, or its connections, are others than those remembered.
bool MasterWatch::isChanged() const {
  std::vector<std::string> advertised, subscribed;
  ros::this_node::getAdvertisedTopics(advertised);
  ros::this_node::getSubscribedTopics(subscribed);
  return !areKeys(std::move(advertised), publications_) || !areKeys(std::move(subscribed), subscriptions_) ||
         connectedPublishers(uri_) != connections_;
}

// What the master knows of this process. The whole graph, which may be large, is asked for only when it has changed here.
void MasterWatch::remember() {
  XmlRpcValue parameters;
  if (askMaster("getParam", parameters, namespace_)) parameters_ = parameters;
  if (!isChanged() && ++unchanged_ < kLooks) return;
  unchanged_ = 0;
  XmlRpcValue uri, state, types, api;
  if (!askMaster("lookupNode", uri, ros::this_node::getName()) || !askMaster("getSystemState", state) ||
      !askMaster("getTopicTypes", types))
    return;
  std::map<std::string, std::string> publications = ofThisNode(state[0]), subscriptions = ofThisNode(state[1]),
                                     services = ofThisNode(state[2]);
  if (services.count(ownService()) == 0) return;  // another master already
  for (int i = 0; i < types.size(); ++i)
    for (auto* topics : {&publications, &subscriptions}) {
      const auto topic = topics->find(static_cast<std::string>(types[i][0]));
      if (topic != topics->end()) topic->second = static_cast<std::string>(types[i][1]);
    }
  for (auto& [name, service_uri] : services) {
    const auto known = services_.find(name);
    if (known != services_.end()) service_uri = known->second;
    else if (askMaster("lookupService", api, name)) service_uri = static_cast<std::string>(api);
  }
  uri_ = static_cast<std::string>(uri);
  rememberPublishers(state[0]);
  publications_ = std::move(publications);
  subscriptions_ = std::move(subscriptions);
  services_ = std::move(services);
}

// Names of the publishers that this process is connected to. publications: pairs of getSystemState.
void MasterWatch::rememberPublishers(XmlRpcValue& publications) {
  const auto topics = byNode(publications);
  std::map<std::string, std::string> publishers;
  connections_ = connectedPublishers(uri_);
  for (const auto& [topic, uri] : connections_) {
    const auto known = publishers_.find(uri);
    if (known != publishers_.end()) publishers.insert(*known);
    for (auto name = topics.begin(); name != topics.end() && publishers.count(uri) == 0; ++name) {
      XmlRpcValue api;
      if (name->second == topic && askMaster("lookupNode", api, name->first) && static_cast<std::string>(api) == uri)
        publishers[uri] = name->first;
    }
  }
  publishers_ = std::move(publishers);
}

// Those that do not register anew themselves.
void MasterWatch::registerPublishers() {
  for (const auto& [topic, uri] : connectedPublishers(uri_)) {
    const auto name = publishers_.find(uri);
    const auto type = subscriptions_.find(topic);
    if (name == publishers_.end() || type == subscriptions_.end() || !isAlive(uri)) continue;
    // The master would stop one that has begun again under the same name.
    XmlRpcValue known, answer;
    if (askMaster("lookupNode", known, name->second) && static_cast<std::string>(known) != uri) continue;
    askMasterAs(name->second, "registerPublisher", answer, topic, type->second, uri);
  }
}

void MasterWatch::registerAnew() {
  XmlRpcValue answer;
  registerPublishers();
  for (const auto& [service, uri] : services_) askMaster("registerService", answer, service, uri, uri_);
  for (const auto& [topic, type] : publications_) askMaster("registerPublisher", answer, topic, type, uri_);
  for (const auto& [topic, type] : subscriptions_) {
    if (!askMaster("registerSubscriber", answer, topic, type, uri_) || answer.size() == 0) continue;
    // Who publishes already: told to this process as the master would. Not of nobody, which would cut those that could
    // not be registered.
    XmlRpcValue request, response;
    request[0] = std::string("/master");
    request[1] = topic;
    request[2] = answer;
    askNode(uri_, "publisherUpdate", request, response);
  }
}

}  // namespace live_stiffness
