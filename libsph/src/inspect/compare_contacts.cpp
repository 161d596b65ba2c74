#include "inspect/compare_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "scene/record.hpp"
#include "sph/laws/contact/law.hpp"

namespace sph {
namespace {

std::string shown(double x) {
  if (std::isnan(x)) return fmt::format("nan ({:016x})", std::bit_cast<std::uint64_t>(x));
  return fmt::format("{:a} ({})", x, x);
}

/// Bytes of an entry: its key and the doubles that the scene's contacts carry.
std::size_t entry_width(const StateFile& file) {
  try {
    const Scene scene = parse_record(file.summary().scene_toml, file.summary().path.string());
    return scene.has_grains() ? 8 * (1 + static_cast<std::size_t>(contact_fusion(scene).history)) : 0;
  } catch (const InputError&) {
    return 0;  // of another version: entries can still be compared as bytes
  }
}

struct ContactEntry {
  std::uint64_t key;
  std::span<const std::byte> history;
};

/// In the order of their keys: lists hold them in whatever order they were built.
std::vector<ContactEntry> entries_of(std::span<const std::byte> bytes, std::size_t width) {
  std::vector<ContactEntry> out;
  for (std::size_t at = 0; at + width <= bytes.size(); at += width) {
    ContactEntry entry{0, bytes.subspan(at + 8, width - 8)};
    std::memcpy(&entry.key, bytes.data() + at, sizeof entry.key);
    out.push_back(entry);
  }
  std::sort(out.begin(), out.end(),
            [](const ContactEntry& a, const ContactEntry& b) { return a.key < b.key; });
  return out;
}

std::string name_of_contact(std::uint64_t id, std::uint64_t key) {
  if (const WallName name(key); (key & wall_key) != 0)
    return name.is_facet() ? fmt::format("contact {}-facet {} of mesh {}", id, name.facet + 1, name.wall)
                           : fmt::format("contact {}-wall {}", id, name.wall);
  return fmt::format("contact {}-{}", std::min(id, key), std::max(id, key));
}

std::string difference_of(const ContactEntry& a, const ContactEntry& b) {
  for (std::size_t c = 0; c + 8 <= a.history.size(); c += 8) {
    if (std::memcmp(a.history.data() + c, b.history.data() + c, 8) == 0) continue;
    double x, y;
    std::memcpy(&x, a.history.data() + c, 8);
    std::memcpy(&y, b.history.data() + c, 8);
    return unequal(fmt::format("history[{}]", c / 8), x, y);
  }
  return {};
}

}  // namespace

std::string unequal(const std::string& name, double a, double b) {
  return name + ": " + shown(a) + " != " + shown(b);
}
std::string unequal(const std::string& name, std::int64_t a, std::int64_t b) {
  return fmt::format("{}: {} != {}", name, a, b);
}
std::string unequal(const std::string& name, std::uint64_t a, std::uint64_t b) {
  return fmt::format("{}: {} != {}", name, a, b);
}

ContactComparison::ContactComparison(const StateFile& a, const StateFile& b)
    : a_{a.summary().path.string(), a.history()}, b_{b.summary().path.string(), b.history()} {
  const std::size_t width = a_.entries && b_.entries ? entry_width(a) : 0;
  if (width > 0 && width == entry_width(b)) width_ = width;
}

std::span<const std::byte> ContactComparison::Side::of(std::uint64_t row) const {
  return std::span(entries->bytes)
      .subspan(entries->offset[row], entries->offset[row + 1] - entries->offset[row]);
}

std::string ContactComparison::difference(std::uint64_t id, std::uint64_t row_a, std::uint64_t row_b) const {
  if (!a_.entries || !b_.entries) return {};  // snapshots have no histories
  const std::span<const std::byte> mine = a_.of(row_a), other = b_.of(row_b);
  if (std::equal(mine.begin(), mine.end(), other.begin(), other.end())) return {};
  if (width_ == 0)
    return fmt::format("particle {}: contact history: {} bytes, {} bytes, different", id, mine.size(),
                       other.size());
  const std::vector<ContactEntry> in_a = entries_of(mine, width_), in_b = entries_of(other, width_);
  for (std::size_t k = 0; k < in_a.size() || k < in_b.size(); ++k) {
    const bool only_a = k == in_b.size() || (k < in_a.size() && in_a[k].key < in_b[k].key);
    const bool only_b = k == in_a.size() || (k < in_b.size() && in_b[k].key < in_a[k].key);
    const std::uint64_t key = only_b ? in_b[k].key : in_a[k].key;
    const std::string text =
        only_a || only_b ? "only in " + (only_a ? a_ : b_).path : difference_of(in_a[k], in_b[k]);
    if (!text.empty()) return name_of_contact(id, key) + ": " + text;
  }
  return {};
}

std::string wall_difference(const std::vector<WallState>& a, const std::vector<WallState>& b) {
  if (a.size() != b.size()) return unequal("walls", a.size(), b.size());
  for (std::size_t w = 0; w < a.size(); ++w)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto name = [&](const char* what) { return fmt::format("wall {}: {}[{}]", w, what, k); };
      const double u = a[w].velocity[k], v = b[w].velocity[k];
      if (a[w].offset[k] != b[w].offset[k]) return unequal(name("offset"), a[w].offset[k], b[w].offset[k]);
      if (std::bit_cast<std::uint64_t>(u) != std::bit_cast<std::uint64_t>(v))
        return unequal(name("velocity"), u, v);
      if (a[w].force[k] != b[w].force[k]) return unequal(name("force"), a[w].force[k], b[w].force[k]);
    }
  return {};
}

std::string body_difference(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  if (a.size() != b.size()) return unequal("bodies", a.size(), b.size());
  std::string first;
  for (std::size_t k = 0; k < a.size(); ++k) {
    std::vector<std::uint64_t> bits;
    for_each_number(b[k], [&](const char*, std::size_t, const auto& number) {
      bits.push_back(std::bit_cast<std::uint64_t>(number));
    });
    std::size_t at = 0;
    for_each_number(a[k], [&]<class T>(const char* name, std::size_t c, const T& number) {
      const std::uint64_t other = bits[at++];
      if (!first.empty() || std::bit_cast<std::uint64_t>(number) == other) return;
      first = unequal(fmt::format("body {}: {}[{}]", k, name, c), number, std::bit_cast<T>(other));
    });
  }
  return first;
}

}  // namespace sph
