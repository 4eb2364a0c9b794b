// Work on all cores that is nobody else's business: while a lock is held, or for what others will use, too.
#pragma once

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <optional>
#include <type_traits>

namespace omma {

/// Calls `work`, which may lock and may run on all cores, and returns what it returns, which is no reference. A thread
/// that waits for the rest of its work helps with other work meanwhile, and that might want the lock which the thread
/// itself holds: this thread does nothing else until `work` is done. And when work around it is cancelled, as the
/// pictures of a rig are when one of them fails, `work` goes on to its end.
template <typename Work>
auto isolated(const Work& work) {
  using Result = std::invoke_result_t<const Work&>;
  return tbb::this_task_arena::isolate([&]() -> Result {
    tbb::task_group_context context(tbb::task_group_context::isolated);
    tbb::task_group group(context);
    if constexpr (std::is_void_v<Result>) {
      group.run_and_wait(work);
    } else {
      std::optional<Result> result;
      group.run_and_wait([&] { result.emplace(work()); });
      return std::move(*result);
    }
  });
}

}  // namespace omma
