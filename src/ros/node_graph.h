#pragma once
// Questions about the graph of nodes: to the master, to this process and to other nodes, by their XML-RPC interfaces
// (http://wiki.ros.org/ROS/Master_API, Slave_API). None waits for a master that is not there.

#include <ros/master.h>
#include <ros/this_node.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace live_stiffness {

// A method of the master, with strings or XmlRpcValues, as node `name`: false if it cannot be reached, or refuses.
template <class... Arguments>
bool askMasterAs(const std::string& name, const std::string& method, XmlRpc::XmlRpcValue& answer,
                 const Arguments&... arguments) {
  XmlRpc::XmlRpcValue request, response;
  int i = 0;
  request[i++] = name;
  ((request[i++] = arguments), ...);
  return ros::master::execute(method, request, response, answer, false);
}

// As this node.
template <class... Arguments>
bool askMaster(const std::string& method, XmlRpc::XmlRpcValue& answer, const Arguments&... arguments) {
  return askMasterAs(ros::this_node::getName(), method, answer, arguments...);
}

// A method of the node at `uri`: false if it does not answer within a second, as when the computer it ran on is off.
bool askNode(const std::string& uri, const std::string& method, const XmlRpc::XmlRpcValue& request,
             XmlRpc::XmlRpcValue& response);
// True if a node answers at `uri`.
bool isAlive(const std::string& uri);

// Topics or services by node, of pairs [topic or service, [nodes]], as getSystemState gives them.
std::multimap<std::string, std::string> byNode(XmlRpc::XmlRpcValue& pairs);

// Topic and URI of every publisher in another process that this one, at `uri`, is connected to.
std::vector<std::pair<std::string, std::string>> connectedPublishers(const std::string& uri);

}  // namespace live_stiffness
