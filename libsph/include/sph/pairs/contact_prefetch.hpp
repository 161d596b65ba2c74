// What a sweep over contacts will need soon is asked for before: rows of a pair lie anywhere, and more grains than a cache holds
// would have each of them waited for.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sph/pairs/contact_context.hpp"

namespace sph {

/// `stride`: sums of a row; `history`: components of a contact's; `turns`: spins or groups are looked at.
template <class Rows, int stride, int history, bool turns>
class ContactPrefetch {
 public:
  ContactPrefetch(const ContactContext& c, const Rows& rows)
      : list_(c.lists->pairs()), rows_(rows), far_(c.particles->rows() > rows_in_cache) {}

  // Inlined by force: g++ takes a function that only prefetches for one without effect and drops the call.
  /// Before group g is swept.
  [[gnu::always_inline]] void coming(std::size_t g) const {
    const std::size_t next = g + (far_ ? 16 : 8);
    if (next >= list_.groups()) return;
    partners(next);
    if (far_) own(next);
  }
  /// Rows j of a group.
  [[gnu::always_inline]] void partners(std::size_t g) const {
    for (std::size_t l = 0; l < lanes; ++l) row(list_.j[g * lanes + l]);
  }
  /// Of a block, before the one before it: what its candidates are found by, the nearest of them first.
  [[gnu::always_inline]] void block(const ContactBlock& block) const {
    const std::size_t g = block.candidates.first;
    if (!far_ || g == block.candidates.last) return;
    __builtin_prefetch(&list_.asleep[g]);
    __builtin_prefetch(&list_.touching[g]);
    __builtin_prefetch(&list_.i[g * lanes]);
    __builtin_prefetch(&list_.j[g * lanes]);
  }

 private:
  static constexpr std::size_t lanes = ContactGroups::lanes;
  // Some 400 bytes each with their contacts. To ask for what is near costs more than it saves.
  static constexpr std::size_t rows_in_cache = 20000;

  [[gnu::always_inline]] void row(std::size_t r) const {
    __builtin_prefetch(rows_.x(r));
    if constexpr (turns) __builtin_prefetch(rows_.w(r));
    __builtin_prefetch(rows_.sums + r * stride, 1);
  }
  /// Rows i of a group, which follow each other, each for some pairs, and its histories.
  [[gnu::always_inline]] void own(std::size_t g) const {
    for (std::size_t l = 0; l < lanes; l += 4) row(list_.i[g * lanes + l]);
    for (std::size_t component = 0; component < history && g < list_.candidates; ++component)
      __builtin_prefetch(&list_.history[(g * history + component) * lanes], 1);
  }

  const ContactGroups& list_;
  const Rows& rows_;
  bool far_;
};

}  // namespace sph
