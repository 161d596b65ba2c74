// Histories on their way: packed with their grains before rows move, put back into the new lists after it.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <optional>
#include <utility>

#include "decomp/splitmix.hpp"
#include "sph/pairs/contact_lists.hpp"

namespace sph {
namespace {

constexpr std::size_t lanes = ContactGroups::lanes;

/// Sums of these tell contacts apart.
std::uint64_t mixed(std::uint64_t carrier, std::uint64_t partner) {
  return decomp::splitmix_mix(decomp::splitmix_mix(carrier) + partner);
}

void count(ContactCensus& census, std::uint64_t carrier, std::uint64_t partner) {
  ++census.count;
  census.keys += mixed(carrier, partner);
}

std::uint64_t key_of(const std::byte* entry) {
  std::uint64_t key;
  std::memcpy(&key, entry, sizeof key);
  return key;
}

/// As the sweep finds it, to the last bit: do the grains overlap where they are now?
bool touch(const std::int64_t* a, const std::int64_t* b, double radii, double quantum) {
  double distance2 = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = static_cast<double>(b[k] - a[k]) * quantum;
    distance2 += d * d;
  }
  return distance2 > 0 && radii - std::sqrt(distance2) > 0;
}

/// A facet always may: what its contact remembers may pass to another in the sweep to come.
bool touches(const WallsNow& walls, const WallNumbers& numbers, std::uint32_t wall, const std::int64_t* x,
             double radius, double quantum) {
  return numbers.is_facet(wall) || radius - distance_from(walls.planes[wall], x, quantum) > 0;
}

/// Those that came with the grains, those of a row one after the other, and what became of each.
class Entries {
 public:
  enum class Fate : std::uint8_t { unlisted, apart, kept };
  Entries(const decomp::Payload& payload, std::span<const std::uint32_t> order, std::size_t bytes)
      : payload_(payload),
        order_(order),
        bytes_(bytes),
        fate_(payload.bytes.size() / bytes, Fate::unlisted) {}
  [[nodiscard]] std::size_t first(std::uint32_t row) const { return payload_.offset[order_[row]] / bytes_; }
  [[nodiscard]] std::size_t last(std::uint32_t row) const {
    return payload_.offset[order_[row] + 1] / bytes_;
  }
  [[nodiscard]] const std::byte* bytes(std::size_t entry) const {
    return payload_.bytes.data() + entry * bytes_;
  }
  [[nodiscard]] Fate& fate(std::size_t entry) { return fate_[entry]; }
  [[nodiscard]] std::optional<std::size_t> find(std::uint32_t row, std::uint64_t key) const {
    for (std::size_t e = first(row); e < last(row); ++e)
      if (key_of(bytes(e)) == key) return e;
    return std::nullopt;
  }
  [[nodiscard]] bool any_unlisted(std::uint32_t row) const {
    for (std::size_t e = first(row); e < last(row); ++e)
      if (fate_[e] == Fate::unlisted) return true;
    return false;
  }

 private:
  const decomp::Payload& payload_;
  std::span<const std::uint32_t> order_;
  std::size_t bytes_;
  std::vector<Fate> fate_;
};

/// Lists hold a history as it acts on j; i has its own view of it.
double seen(double value, Parity parity, bool by_i) { return by_i && parity == Parity::odd ? -value : value; }

}  // namespace

decomp::Payload ContactLists::pack(const Particles& p) const {
  decomp::Payload payload;
  (void)p.table();  // brings back what is in lines: memory is at its peak while contacts travel
  const std::size_t owned = p.owned();
  payload.offset.assign(owned + 1, 0);
  if (history_ == 0) return payload;
  const auto each = [this](auto&& visit) {
    for (const ContactGroups* g : {&pairs_, &walls_})
      for (std::size_t k = 0; k < g->groups(); ++k)
        for (unsigned bits = g->touching[k]; bits != 0; bits &= bits - 1) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
          visit(*g, k, lane, g->i[k * lanes + lane], g->j[k * lanes + lane]);
        }
  };
  each([&](const ContactGroups& g, std::size_t, std::size_t, std::uint32_t i, std::uint32_t j) {
    payload.offset[i + 1] += entry_bytes();
    if (&g == &pairs_ && j < owned) payload.offset[j + 1] += entry_bytes();
  });
  for (const Parted& parted : parted_) payload.offset[parted.row + 1] += entry_bytes();
  for (std::size_t r = 0; r < owned; ++r) payload.offset[r + 1] += payload.offset[r];
  payload.bytes.resize(payload.offset.back());
  std::vector<std::uint64_t> at(payload.offset.begin(), payload.offset.end() - 1);
  const std::uint64_t* id = p.data<Field::id>();
  const auto put = [&](std::uint32_t row, std::uint64_t key, const double* history, bool is_i) {
    std::byte* out = payload.bytes.data() + at[row];
    at[row] += entry_bytes();
    std::memcpy(out, &key, sizeof key);
    for (std::size_t c = 0; c < history_; ++c) {
      // + 0: a zero keeps no sign, since which of the two it got depended on the orientation of the pair.
      const double value = seen(history[c * lanes], parities_[c], is_i) + 0.0;
      std::memcpy(out + 8 * (1 + c), &value, sizeof value);
    }
  };
  each([&](const ContactGroups& g, std::size_t k, std::size_t lane, std::uint32_t i, std::uint32_t j) {
    const double* history = g.history_of(k, history_) + lane;
    put(i, &g == &walls_ ? numbers_.key(j) : id[j], history, true);
    if (&g == &pairs_ && j < owned) put(j, id[i], history, false);
  });
  for (std::size_t n = 0; n < parted_.size(); ++n) {
    std::memcpy(payload.bytes.data() + at[parted_[n].row], parted_entries_.data() + n * entry_bytes(),
                entry_bytes());
    at[parted_[n].row] += entry_bytes();
  }
  return payload;
}

void ContactLists::forget_histories() {
  for (ContactGroups* g : {&pairs_, &walls_}) {
    decomp::release(g->touching);
    decomp::release(g->history);
    decomp::release(g->late_history);
    decomp::release(g->place);
    decomp::release(g->asleep);
  }
}

ContactCensus ContactLists::unpack(const Particles& p, const decomp::Payload& payload,
                                   std::span<const std::uint32_t> order, double quantum,
                                   const WallsNow& walls) {
  ContactCensus found;
  parted_.clear();
  parted_entries_.clear();
  if (payload.bytes.empty()) return found;
  const std::uint64_t* id = p.data<Field::id>();
  const std::int64_t* x = p.data<Field::position>();
  const double* radius = p.data<Field::radius>();
  Entries entries(payload, order, entry_bytes());
  const auto place = [&](ContactGroups* g, std::size_t k) {
    const std::uint32_t i = g->i[k], j = g->j[k];
    const bool with_wall = g == &walls_;
    if (with_wall ? j == ContactGroups::no_wall : i == j) return;
    const std::uint64_t wanted = with_wall ? numbers_.key(j) : id[j];
    const auto entry = entries.find(i, wanted);
    if (!entry) return;
    const std::int64_t* at_i = x + std::size_t{i} * 3;
    const bool kept = with_wall ? touches(walls, numbers_, j, at_i, radius[i], quantum)
                                : touch(at_i, x + std::size_t{j} * 3, radius[i] + radius[j], quantum);
    const auto what = kept ? Entries::Fate::kept : Entries::Fate::apart;
    entries.fate(*entry) = what;
    const bool both = !with_wall && j < p.owned();
    if (both)
      if (const auto other = entries.find(j, id[i])) entries.fate(*other) = what;
    if (!kept) return;
    g->touching[k / lanes] = static_cast<std::uint8_t>(g->touching[k / lanes] | 1u << (k % lanes));
    double* history = g->remember(k / lanes, history_) + k % lanes;
    for (std::size_t c = 0; c < history_; ++c) {
      double value;
      std::memcpy(&value, entries.bytes(*entry) + 8 * (1 + c), sizeof value);
      history[c * lanes] = seen(value, parities_[c], true);
    }
    count(found, id[i], wanted);
    if (both) count(found, wanted, id[i]);
  };
  const std::size_t candidates = pairs_.candidates * lanes;
  for (std::size_t k = 0; k < candidates; ++k) place(&pairs_, k);
  for (std::size_t k = 0; k < walls_.i.size(); ++k) place(&walls_, k);
  // Of what did not touch when lists were made: only few rows have entries that are in no place yet.
  std::vector<std::uint8_t> waits(p.owned());
  for (std::uint32_t row = 0; row < p.owned(); ++row) waits[row] = entries.any_unlisted(row) ? 1 : 0;
  for (std::size_t k = candidates; k < pairs_.i.size(); ++k)
    if (waits[pairs_.i[k]] != 0) place(&pairs_, k);
  carried_ = static_cast<std::int64_t>(found.count);
  for (std::uint32_t row = 0; row < p.owned(); ++row)
    for (std::size_t e = entries.first(row); e < entries.last(row); ++e) {
      if (entries.fate(e) == Entries::Fate::kept) continue;
      const std::uint64_t key = key_of(entries.bytes(e));
      parted_.push_back({row, key, entries.fate(e) == Entries::Fate::apart});
      parted_entries_.insert(parted_entries_.end(), entries.bytes(e), entries.bytes(e) + entry_bytes());
      count(found, id[row], key);
      if ((key & wall_key) == 0)
        found.one_sided += id[row] < key ? mixed(id[row], key) : -mixed(key, id[row]);
    }
  return found;
}

// A pair with both sides on this rank has two entries.
std::int64_t ContactLists::forget_parted(const std::uint64_t* id) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> pairs;
  for (const Parted& parted : parted_) pairs.push_back(std::minmax(id[parted.row], parted.key));
  std::ranges::sort(pairs);
  const auto contacts = std::distance(pairs.begin(), std::unique(pairs.begin(), pairs.end()));
  parted_.clear();
  parted_entries_.clear();
  return contacts;
}

ContactCensus ContactLists::census(const Particles& p, const decomp::Payload& payload, int history) {
  ContactCensus census;
  const std::uint64_t* id = p.data<Field::id>();
  for (std::size_t row = 0; row < payload.rows(); ++row)
    for (std::uint64_t at = payload.offset[row]; at < payload.offset[row + 1];
         at += 8 * (1 + static_cast<std::size_t>(history)))
      count(census, id[row], key_of(payload.bytes.data() + at));
  return census;
}

std::int64_t forget_contacts(decomp::Payload& packed, const std::uint64_t* id,
                             std::span<const std::uint64_t> gone, int history) {
  if (gone.empty()) return 0;
  const auto is_gone = [&](std::uint64_t key) { return std::ranges::binary_search(gone, key); };
  const std::size_t bytes = 8 * (1 + static_cast<std::size_t>(history));
  std::int64_t contacts = 0;
  decomp::Payload kept;
  for (std::size_t row = 0; row < packed.rows(); ++row) {
    const bool carrier_goes = is_gone(id[row]);
    for (std::uint64_t at = packed.offset[row]; at < packed.offset[row + 1]; at += bytes) {
      const std::byte* entry = packed.bytes.data() + at;
      const std::uint64_t key = key_of(entry);
      if (carrier_goes || is_gone(key))
        contacts += id[row] < key ? 1 : 0;  // keys of walls are above all ids
      else
        kept.bytes.insert(kept.bytes.end(), entry, entry + bytes);
    }
    kept.offset.push_back(kept.bytes.size());
  }
  packed = std::move(kept);
  return contacts;
}

}  // namespace sph
