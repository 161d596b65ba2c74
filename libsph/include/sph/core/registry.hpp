// What a scene may name and a program may add to: ours first, in the order of messages, then those of the
// program. Fixed once it has been looked at, which reading a scene does: what a word means cannot change
// while scenes that say it are alive.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace sph {

template <class Entry>
class Registry {
 public:
  explicit Registry(std::vector<const Entry*> ours) : all_(std::move(ours)) {}

  void add(const Entry& entry) {
    const std::string who(entry.word);
    if (fixed_) throw std::logic_error(who + " is registered after a scene has been read");
    for (const Entry* other : all_)
      if (other->word == entry.word) throw std::logic_error(who + " is registered already");
    all_.push_back(&entry);
  }
  [[nodiscard]] std::span<const Entry* const> look() {
    fixed_ = true;
    return all_;
  }
  /// Without fixing them.
  [[nodiscard]] std::span<const Entry* const> so_far() const { return all_; }

 private:
  std::vector<const Entry*> all_;
  bool fixed_ = false;
};

}  // namespace sph
