#pragma once
// parallelLoop(count, grain, body): on all threads of the arena, body(begin, end) for ranges that together are
// [0, count), of at least half a `grain` each where there are as many. By TBB.
//
// ThreadSanitizer does not see how TBB orders its threads, since distributions build libtbb without it; it is told
// here, so that it still judges what the loop's body does.

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

// Moments of all loops; not of one, whose address the bodies would have to read from where TBB keeps it.
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
