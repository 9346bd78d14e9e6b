// Which of many things have changed since somebody last looked.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace cairn {

// Each key once, in the order of its last change: what is bounded by the number of keys serves any number of readers,
// each with the stamp up to which it has read.
template <class Key>
class ChangeLog {
 public:
  void mark(const Key& key) {
    const auto [at, is_new] = stamps_.try_emplace(key, 0);
    if (!is_new) keys_.erase(at->second);
    at->second = ++last_;
    keys_.emplace_hint(keys_.end(), last_, key);
  }
  // The reader's stamp rises to what it gets now, at most so many keys.
  [[nodiscard]] std::vector<Key> take(std::uint64_t& read, std::size_t max) const {
    std::vector<Key> changed;
    for (auto at = keys_.upper_bound(read); at != keys_.end() && changed.size() < max; ++at) {
      changed.push_back(at->second);
      read = at->first;
    }
    return changed;
  }
  [[nodiscard]] bool has_more(std::uint64_t read) const { return !keys_.empty() && keys_.rbegin()->first > read; }
  void clear() { *this = ChangeLog(); }

 private:
  std::uint64_t last_ = 0;
  std::map<Key, std::uint64_t> stamps_;
  std::map<std::uint64_t, Key> keys_;
};

}  // namespace cairn
