#include "live_stiffness/ros/master_watch.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/network.h>
#include <ros/param.h>
#include <xmlrpcpp/XmlRpcClient.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <chrono>

namespace live_stiffness {
namespace {

using XmlRpc::XmlRpcValue;

// The master's API: false if it cannot be reached, or refuses.
template <class... Arguments>
bool ask(const std::string& method, XmlRpcValue& answer, const Arguments&... arguments) {
  XmlRpcValue request, response;
  int i = 0;
  request[i++] = ros::this_node::getName();
  for (const std::string& argument : {std::string(arguments)...}) request[i++] = argument;
  return ros::master::execute(method, request, response, answer, false);
}

bool ask(const std::string& method, XmlRpcValue& answer) {
  XmlRpcValue request, response;
  request[0] = ros::this_node::getName();
  return ros::master::execute(method, request, response, answer, false);
}

// Of pairs [name, [nodes]], as getSystemState gives them: the names that this node is among.
std::map<std::string, std::string> ofThisNode(XmlRpcValue& pairs) {
  std::map<std::string, std::string> names;
  for (int i = 0; i < pairs.size(); ++i)
    for (int k = 0; k < pairs[i][1].size(); ++k)
      if (static_cast<std::string>(pairs[i][1][k]) == ros::this_node::getName())
        names[static_cast<std::string>(pairs[i][0])] = "*";
  return names;
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
  XmlRpcValue answer;
  XmlRpcValue pid;
  if (!ask("getPid", pid)) {
    if (!is_away_ && !ros::isShuttingDown())
      ROS_WARN("the master at %s does not answer: what is connected goes on, but nodes that start now find nobody",
               ros::master::getURI().c_str());
    is_away_ = true;
    return;
  }
  const bool is_known = ask("lookupNode", answer, ros::this_node::getName());
  if (ros::isShuttingDown()) return;  // asked last: shutting down is why it may not be known
  // In a container every master may have the same.
  const bool is_another = pid_ != 0 && pid_ != static_cast<int>(pid);
  if ((is_another || !is_known) && parameters_.valid() && !ros::param::has(namespace_))
    ros::param::set(namespace_, parameters_);
  if (!is_known && !uri_.empty()) registerAnew();
  else if (is_known) remember();
  pid_ = static_cast<int>(pid);
  is_away_ = false;
}

// What the master knows of this process.
bool MasterWatch::remember() {
  XmlRpcValue uri, state, types, api;
  if (!ask("lookupNode", uri, ros::this_node::getName()) || !ask("getSystemState", state) ||
      !ask("getTopicTypes", types))
    return false;
  std::map<std::string, std::string> publications = ofThisNode(state[0]), subscriptions = ofThisNode(state[1]),
                                     services = ofThisNode(state[2]);
  for (int i = 0; i < types.size(); ++i)
    for (auto* topics : {&publications, &subscriptions}) {
      const auto topic = topics->find(static_cast<std::string>(types[i][0]));
      if (topic != topics->end()) topic->second = static_cast<std::string>(types[i][1]);
    }
  for (auto& [name, service_uri] : services) {
    const auto known = services_.find(name);
    if (known != services_.end()) service_uri = known->second;
    else if (ask("lookupService", api, name)) service_uri = static_cast<std::string>(api);
  }
  uri_ = static_cast<std::string>(uri);
  publications_ = std::move(publications);
  subscriptions_ = std::move(subscriptions);
  services_ = std::move(services);
  XmlRpcValue parameters;
  if (ros::param::get(namespace_, parameters)) parameters_ = parameters;
  return true;
}

void MasterWatch::registerAnew() {
  ROS_WARN("the master was restarted: registering there anew");
  XmlRpcValue answer;
  for (const auto& [service, uri] : services_) ask("registerService", answer, service, uri, uri_);
  for (const auto& [topic, type] : publications_) ask("registerPublisher", answer, topic, type, uri_);
  for (const auto& [topic, type] : subscriptions_) {
    if (!ask("registerSubscriber", answer, topic, type, uri_) || answer.size() == 0) continue;
    // Who publishes already: told to this process as the master would. Not of nobody, which would cut connections to
    // publishers that have not registered anew.
    XmlRpcValue request, response;
    request[0] = std::string("/master");
    request[1] = topic;
    request[2] = answer;
    std::string host;
    uint32_t port = 0;
    if (!ros::network::splitURI(uri_, host, port)) continue;
    XmlRpc::XmlRpcClient self(host.c_str(), static_cast<int>(port), "/");
    self.execute("publisherUpdate", request, response);
  }
}

}  // namespace live_stiffness
