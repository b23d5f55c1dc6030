#pragma once
// Registers this process anew when the master was restarted, which roscpp does not.
//
// Connections between nodes outlive the master: data go on. But a new master knows nobody, so that nodes that start
// afterwards find nobody, and its parameter server is empty. This remembers what the old one knew of this process
// (publications, subscriptions, services, private parameters) and tells the new one; and of nodes that do not do so, what
// this process hears from them. Without that the master would name only those publishers that it knows, and roscpp would
// cut all others: of /tf, or of a nodelet's bond, whose end unloads it. Several in one process, as of nodelets, do no
// harm: each brings its own parameters, and to register twice is to register once.

#include <ros/master.h>
#include <ros/this_node.h>

#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace live_stiffness {

class MasterWatch {
 public:
  // parameters: namespace of those to bring back. Looks once a second, in a thread of its own: a master on a computer that
  // is off makes one wait. Asks for the whole graph when topics or connections of this process have changed, and every ten
  // seconds.
  explicit MasterWatch(std::string parameters = ros::this_node::getName())
      : namespace_(std::move(parameters)), thread_([this] { run(); }) {}
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;

 private:
  void run();
  void look();
  bool isChanged() const;
  void remember();
  void rememberPublishers(XmlRpc::XmlRpcValue& publications);
  void registerAnew();
  void registerPublishers();

  std::string namespace_;
  int pid_ = 0;                                                   // of the master; 0: not seen yet
  std::string uri_;                                               // of this process
  std::map<std::string, std::string> publishers_;                 // that it is connected to: name by URI
  std::map<std::string, std::string> publications_, subscriptions_;  // type by topic
  std::map<std::string, std::string> services_;                   // URI by service
  std::vector<std::pair<std::string, std::string>> connections_;  // topic and URI of who publishes it
  int unchanged_ = 0;                                             // looks since all of that was asked for
  XmlRpc::XmlRpcValue parameters_;
  bool is_away_ = false;

  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;  // last: begins when the rest is there
};

}  // namespace live_stiffness
