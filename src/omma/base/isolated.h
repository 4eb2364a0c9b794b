// Work on all cores while a lock is held. A thread that waits for the rest of its work meanwhile helps with other work,
// and that might want the lock which the thread itself holds.
#pragma once

#include <tbb/task_arena.h>

#include <utility>

namespace omma {

/// Calls `work`, which may lock and may run on all cores; this thread does nothing else until it is done. Returns what
/// it returns, which is no reference.
template <typename Work>
auto isolated(Work&& work) {
  return tbb::this_task_arena::isolate(std::forward<Work>(work));
}

}  // namespace omma
