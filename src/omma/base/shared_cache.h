// What was made for the last few keys, for any number of threads.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>

#include "omma/base/isolated.h"
#include "omma/base/recent_cache.h"

namespace omma {

template <typename Key, typename Value, size_t kept>
class SharedCache {
 public:
  /// `make(key)` returns a std::shared_ptr<const Value>. What is asked for at once by several threads is made once,
  /// while the others wait; it may run on all cores. Whoever holds a value keeps it, though others push it out.
  template <typename Make>
  std::shared_ptr<const Value> get(const Key& key, const Make& make) {
    return isolated([&] {
      const std::lock_guard lock(mutex_);
      return entries_.get(key, make);
    });
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    entries_ = {};
  }
  template <typename Each>
  void each(const Each& visit) const {
    const std::lock_guard lock(mutex_);
    entries_.each([&](const std::shared_ptr<const Value>& value) { visit(*value); });
  }

 private:
  mutable std::mutex mutex_;
  RecentCache<Key, std::shared_ptr<const Value>, kept> entries_;
};

}  // namespace omma
