// What was made for the last few keys. Pictures alternate between cameras (hemispheres, faces, eyes) and between the
// shifts of their passes, and what is derived from those takes longer to make than to use.
#pragma once

#include <cstddef>
#include <list>
#include <utility>

namespace omma {

template <typename Key, typename Value, size_t kept = 16>
class RecentCache {
 public:
  /// `make(key)` returns a Value, which stays where it is until as many other keys as are kept were asked for.
  template <typename Make>
  const Value& get(const Key& key, const Make& make) {
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (!(entry->first == key)) continue;
      entries_.splice(entries_.begin(), entries_, entry);
      return entry->second;
    }
    if (entries_.size() == kept) entries_.pop_back();
    entries_.emplace_front(key, make(key));
    return entries_.front().second;
  }

  template <typename Each>
  void each(const Each& visit) const {
    for (const auto& [key, value] : entries_) visit(value);
  }

 private:
  std::list<std::pair<Key, Value>> entries_;
};

}  // namespace omma
