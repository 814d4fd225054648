#include "plaza/core/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <exception>
#include <vector>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace plaza {

namespace {

// oneTBB orders what it runs by atomics inside its own library, which the thread sanitizer does not
// see; so it is told that bodies begin after the call, and that the call's return comes after all
// of them.
struct Order {
#ifdef __SANITIZE_THREAD__
  void before() { __tsan_release(&forked_); }
  void begin() { __tsan_acquire(&forked_); }
  void end() { __tsan_release(&joined_); }
  void after() { __tsan_acquire(&joined_); }

 private:
  char forked_ = 0;
  char joined_ = 0;
#else
  void before() {}
  void begin() {}
  void end() {}
  void after() {}
#endif
};

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (count <= 1 || tbb::this_task_arena::max_concurrency() == 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  std::vector<std::exception_ptr> errors(count);
  Order order;
  order.before();
  // isolate: a thread that waits here must not pick up another frame's node, which might wait in
  // turn
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      order.begin();
      try {
        body(i);
      } catch (...) {
        errors[i] = std::current_exception();
      }
      order.end();
    });
  });
  order.after();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace plaza
