#pragma once
// Callbacks in a thread of their own, one at a time and each under a mutex: so that what one of them takes, another
// thread may look at in between.

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

namespace live_stiffness {

class CallbackLane {
 public:
  CallbackLane() : queue_(mutex_) {}
  ~CallbackLane() { stop(); }
  CallbackLane(const CallbackLane&) = delete;  // callbacks refer to it

  // The same names; what is made with the handle calls back here.
  ros::NodeHandle handle(ros::NodeHandle node);
  // Held during each callback.
  std::mutex& mutex() { return mutex_; }

  // Begins to call back, in a thread of this name (at most 15 characters). realtime_priority: of SCHED_FIFO, 1 to 99;
  // 0: like any thread. Warns, and goes on without, when the system does not permit it.
  void start(const std::string& name, int realtime_priority);
  // Waits for the callback at work; none follows.
  void stop();

 private:
  // Wraps what is added to it.
  class Queue : public ros::CallbackQueue {
   public:
    explicit Queue(std::mutex& mutex) : mutex_(mutex) {}
    void addCallback(const ros::CallbackInterfacePtr& callback, uint64_t removal_id) override;

   private:
    std::mutex& mutex_;
  };

  void run();

  std::mutex mutex_;
  Queue queue_;
  std::atomic<bool> is_running_{false};
  std::thread thread_;
};

// Keeps the whole process in memory. Empty: done; else why not, and what to do.
std::string lockMemory();

}  // namespace live_stiffness
