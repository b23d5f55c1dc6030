#pragma once
// parallelLoop(count, grain, body): on all threads of the arena, body(begin, end) for ranges that together are
// [0, count), each of at least half a `grain` if there are that many. Uses TBB.
//
// Distributions build libtbb without ThreadSanitizer, so it does not see how TBB synchronises its threads. It is told
// here, so that it can still check the body of the loop.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#ifdef __SANITIZE_THREAD__  // gcc
#define LIVE_STIFFNESS_TSAN
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)  // clang
#define LIVE_STIFFNESS_TSAN
#endif
#endif

#ifdef LIVE_STIFFNESS_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace live_stiffness {

#ifdef LIVE_STIFFNESS_TSAN

// Shared by all loops. One for each loop would not work: the bodies would have to read its address from TBB's memory.
inline char loop_begin, loop_end;

template <class Body>
struct OrderedBody {
  const Body& body;
  // TBB copies this between threads: the sanitizer must not see it being read.
  __attribute__((no_sanitize("thread"))) void operator()(const tbb::blocked_range<long>& range) const {
    __tsan_acquire(&loop_begin);
    body(range.begin(), range.end());
    __tsan_release(&loop_end);
  }
};

template <class Body>
void parallelLoop(long count, long grain, const Body& body) {
  __tsan_release(&loop_begin);
  tbb::parallel_for(tbb::blocked_range<long>(0, count, grain), OrderedBody<Body>{body});
  __tsan_acquire(&loop_end);
}

#else

template <class Body>
void parallelLoop(long count, long grain, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<long>(0, count, grain),
                    [&](const tbb::blocked_range<long>& range) { body(range.begin(), range.end()); });
}

#endif

}  // namespace live_stiffness
