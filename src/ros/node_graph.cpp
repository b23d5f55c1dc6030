#include "ros/node_graph.h"

#include <ros/network.h>
#include <xmlrpcpp/XmlRpcClient.h>

namespace live_stiffness {

using XmlRpc::XmlRpcValue;

bool askNode(const std::string& uri, const std::string& method, const XmlRpcValue& request, XmlRpcValue& response) {
  constexpr double kPatience = 1.0;  // s
  std::string host;
  uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return false;
  XmlRpc::XmlRpcClient node(host.c_str(), static_cast<int>(port), "/");
  if (!node.executeNonBlock(method.c_str(), request)) return false;
  node._disp.work(kPatience);
  return node.executeCheckDone(response) && response.valid();
}

bool isAlive(const std::string& uri) {
  XmlRpcValue request, pid;
  request[0] = ros::this_node::getName();
  return askNode(uri, "getPid", request, pid);
}

std::multimap<std::string, std::string> byNode(XmlRpcValue& pairs) {
  std::multimap<std::string, std::string> names;
  for (int i = 0; i < pairs.size(); ++i)
    for (int k = 0; k < pairs[i][1].size(); ++k)
      names.emplace(static_cast<std::string>(pairs[i][1][k]), static_cast<std::string>(pairs[i][0]));
  return names;
}

std::vector<std::pair<std::string, std::string>> connectedPublishers(const std::string& uri) {
  std::vector<std::pair<std::string, std::string>> publishers;
  XmlRpcValue request, response;  // [status, message, connections]; each [id, URI, "i" for in, transport, topic, ...]
  request[0] = ros::this_node::getName();
  if (!askNode(uri, "getBusInfo", request, response) || response.size() < 3) return publishers;
  XmlRpcValue& connections = response[2];
  for (int i = 0; i < connections.size(); ++i) {
    XmlRpcValue& connection = connections[i];
    if (static_cast<std::string>(connection[2]) != "i") continue;
    std::string publisher = connection[1], topic = connection[4];
    if (publisher != uri) publishers.emplace_back(std::move(topic), std::move(publisher));
  }
  return publishers;
}

}  // namespace live_stiffness
