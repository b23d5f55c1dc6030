#include "ros/callback_lane.h"

#include <pthread.h>
#include <ros/console.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace live_stiffness {
namespace {

class Guarded : public ros::CallbackInterface {
 public:
  Guarded(ros::CallbackInterfacePtr callback, std::mutex& mutex) : callback_(std::move(callback)), mutex_(mutex) {}
  CallResult call() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return callback_->call();
  }
  bool ready() override { return callback_->ready(); }

 private:
  ros::CallbackInterfacePtr callback_;
  std::mutex& mutex_;
};

}  // namespace

void CallbackLane::Queue::addCallback(const ros::CallbackInterfacePtr& callback, uint64_t removal_id) {
  ros::CallbackQueue::addCallback(boost::make_shared<Guarded>(callback, mutex_), removal_id);
}

ros::NodeHandle CallbackLane::handle(ros::NodeHandle node) {
  node.setCallbackQueue(&queue_);
  return node;
}

void CallbackLane::start(const std::string& name, int realtime_priority) {
  is_running_ = true;
  thread_ = std::thread(&CallbackLane::run, this);
  pthread_setname_np(thread_.native_handle(), name.substr(0, 15).c_str());
  if (realtime_priority <= 0) return;
  sched_param scheduling{};
  scheduling.sched_priority = realtime_priority;
  const int error = pthread_setschedparam(thread_.native_handle(), SCHED_FIFO, &scheduling);
  if (error != 0)
    ROS_WARN("~realtime_priority = %d is not permitted (%s): going on without. Give the user 'rtprio %d' in "
             "/etc/security/limits.d and log in anew, or set it to 0",
             realtime_priority, std::strerror(error), realtime_priority);
}

void CallbackLane::stop() {
  is_running_ = false;
  queue_.disable();  // wakes the thread
  if (thread_.joinable()) thread_.join();
  queue_.clear();
}

void CallbackLane::run() {
  while (is_running_ && ros::ok()) queue_.callOne(ros::WallDuration(0.1));
}

std::string lockMemory() {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  // With a limit the call may succeed, and what the node allocates later fail.
  if (geteuid() != 0 && limit.rlim_cur != RLIM_INFINITY)
    return "at most " + std::to_string(limit.rlim_cur / 1024) +
           " kB are permitted: give the user 'memlock unlimited' in /etc/security/limits.d and log in anew";
  return mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? "" : std::strerror(errno);
}

}  // namespace live_stiffness
