// peperite diff and peperite info.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <numeric>

#include "inspect/compare_contacts.hpp"
#include "sph/core/error.hpp"
#include "sph/core/findings.hpp"
#include "sph/inspect/inspect.hpp"
#include "sph/output/snapshot.hpp"

namespace sph {
namespace {

/// Rows of a file in the order of their ids.
struct Ids {
  std::vector<std::uint64_t> id;   ///< ascending
  std::vector<std::uint64_t> row;  ///< where each is in the file
};

Ids sorted_ids(const StateFile& file) {
  const std::vector<std::byte> bytes = file.column(Field::id);
  std::vector<std::uint64_t> id(file.summary().rows);
  if (!id.empty()) std::memcpy(id.data(), bytes.data(), bytes.size());
  Ids out;
  out.row.resize(id.size());
  std::iota(out.row.begin(), out.row.end(), std::uint64_t{0});
  std::sort(out.row.begin(), out.row.end(), [&](std::uint64_t a, std::uint64_t b) { return id[a] < id[b]; });
  for (std::uint64_t row : out.row) out.id.push_back(id[row]);
  return out;
}

std::string missing_particle(const StateFile& a, const StateFile& b, const Ids& ids_a, const Ids& ids_b) {
  const auto [in_a, in_b] = std::mismatch(ids_a.id.begin(), ids_a.id.end(), ids_b.id.begin(), ids_b.id.end());
  if (in_a == ids_a.id.end() && in_b == ids_b.id.end()) return {};
  const bool only_a = in_b == ids_b.id.end() || (in_a != ids_a.id.end() && *in_a < *in_b);
  return fmt::format("particle {}: only in {} ({} particles, the other {})", only_a ? *in_a : *in_b,
                     (only_a ? a : b).summary().path.string(), (only_a ? a : b).summary().rows,
                     (only_a ? b : a).summary().rows);
}

/// The lowest id that differs so far, by its index, and what differs.
struct Lowest {
  std::size_t index;
  std::string text;
};

template <class T>
std::string first_component(const FieldInfo& i, int count, const std::byte* a, const std::byte* b) {
  for (int c = 0; c < count; ++c, a += sizeof(T), b += sizeof(T)) {
    if (std::memcmp(a, b, sizeof(T)) == 0) continue;
    T x, y;
    std::memcpy(&x, a, sizeof(T));
    std::memcpy(&y, b, sizeof(T));
    const std::string name = std::string(i.name) + (count > 1 ? fmt::format("[{}]", c) : "");
    if constexpr (std::is_same_v<T, std::uint32_t>)
      return unequal(name, std::uint64_t{x}, std::uint64_t{y});
    else
      return unequal(name, x, y);
  }
  return {};
}

std::string first_component(const FieldInfo& i, int dim, const std::byte* a, const std::byte* b) {
  const int count = components(i.shape, dim);
  switch (i.type) {
    case Type::f64:
      return first_component<double>(i, count, a, b);
    case Type::i64:
      return first_component<std::int64_t>(i, count, a, b);
    case Type::u64:
      return first_component<std::uint64_t>(i, count, a, b);
    case Type::u32:
      return first_component<std::uint32_t>(i, count, a, b);
  }
  return {};
}

template <class T>
T value_of(const StateFile& file, Field f, std::uint64_t index) {
  T out;
  std::memcpy(&out, file.column(f).data() + index * sizeof(T), sizeof(T));
  return out;
}

/// "particle 7", or "cell 7 at (0.5, 1.5) m" of a row of melts, which is no grain.
std::string name_of(const StateFile& file, std::uint64_t id, std::uint64_t row) {
  const auto has = [&](Field f) {
    return std::ranges::find(file.summary().contents.fields, f) != file.summary().contents.fields.end();
  };
  if (!has(Field::flow_pressure) || !has(Field::position) ||
      (has(Field::radius) && value_of<double>(file, Field::radius, row) > 0))
    return fmt::format("particle {}", id);
  std::vector<double> at;
  const auto d = static_cast<std::uint64_t>(file.summary().dim);
  for (std::uint64_t a = 0; a < d; ++a)
    at.push_back(file.summary().scale.metres(value_of<std::int64_t>(file, Field::position, row * d + a)));
  return fmt::format("cell {} {}", id, place_text(at));
}

void compare_field(const StateFile& a, const StateFile& b, const Ids& ids_a, const Ids& ids_b, Field f,
                   Lowest& lowest) {
  const std::vector<std::byte> values_a = a.column(f);
  const std::vector<std::byte> values_b = b.column(f);
  const std::size_t w = width(f, a.summary().dim);
  for (std::size_t k = 0; k < lowest.index; ++k) {
    const std::byte* at_a = values_a.data() + ids_a.row[k] * w;
    const std::byte* at_b = values_b.data() + ids_b.row[k] * w;
    if (std::memcmp(at_a, at_b, w) != 0)
      lowest = {k, fmt::format("{}: {}", name_of(a, ids_a.id[k], ids_a.row[k]),
                               first_component(info(f), a.summary().dim, at_a, at_b))};
  }
}

void compare_contacts(const StateFile& a, const StateFile& b, const Ids& ids_a, const Ids& ids_b,
                      Lowest& lowest) {
  const ContactComparison contacts(a, b);
  for (std::size_t k = 0; k < lowest.index; ++k)
    if (std::string text = contacts.difference(ids_a.id[k], ids_a.row[k], ids_b.row[k]); !text.empty())
      lowest = {k, text};
}

/// A field that only one of two files has counts unless the other is a snapshot, which need not have it.
std::string missing_field(const StateSummary& a, const StateSummary& b) {
  for (Field f : a.contents.fields)
    if (std::find(b.contents.fields.begin(), b.contents.fields.end(), f) == b.contents.fields.end() &&
        (a.kind == b.kind || info(f).snapshot))
      return fmt::format("field {}: only in {}", info(f).name, a.path.string());
  return {};
}

std::string global_difference(const StateSummary& a, const StateSummary& b) {
  const GlobalState& g = a.global;
  const GlobalState& h = b.global;
  const auto differ = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) != std::bit_cast<std::uint64_t>(y);
  };
  if (differ(g.time, h.time)) return unequal("time", g.time, h.time);
  if (differ(g.dt, h.dt)) return unequal("dt", g.dt, h.dt);
  if (differ(g.max_speed, h.max_speed)) return unequal("max_speed", g.max_speed, h.max_speed);
  if (differ(g.max_acceleration, h.max_acceleration))
    return unequal("max_acceleration", g.max_acceleration, h.max_acceleration);
  if (a.kind == b.kind && g.fluid_volume != h.fluid_volume)
    return unequal("fluid_volume", g.fluid_volume.now, h.fluid_volume.now);
  if (a.kind == b.kind) {
    for (std::size_t k = 0; k < 3; ++k)
      if (const double x = g.motion.velocity[k], y = h.motion.velocity[k]; differ(x, y))
        return unequal("mean_velocity", x, y);
    if (differ(g.motion.unlike, h.motion.unlike))
      return unequal("unlike_motion", g.motion.unlike, h.motion.unlike);
    if (differ(g.motion.largest, h.motion.largest))
      return unequal("largest_motion", g.motion.largest, h.motion.largest);
    if (differ(g.flow.interval, h.flow.interval))
      return unequal("flow_interval", g.flow.interval, h.flow.interval);
    if (g.flow.left != h.flow.left) return unequal("flow_left", g.flow.left, h.flow.left);
  }
  if (a.kind == b.kind && g.throughput != h.throughput) {
    for (std::size_t k = 0; k < std::min(g.throughput.passages.size(), h.throughput.passages.size()); ++k)
      if (const Passage& x = g.throughput.passages[k], &y = h.throughput.passages[k]; x != y)
        return x.count != y.count ? unequal("passage.count", x.count, y.count)
                                  : unequal("passage.mass", x.amounts[0], y.amounts[0]);
    return unequal("id_stride", g.throughput.id_stride, h.throughput.id_stride);
  }
  if (a.kind == b.kind && g.inflows.size() != h.inflows.size())
    return unequal("inflows", g.inflows.size(), h.inflows.size());
  if (a.kind == b.kind)
    for (std::size_t k = 0; k < std::min(g.inflows.size(), h.inflows.size()); ++k)
      if (const Inflow& x = g.inflows[k], &y = h.inflows[k]; x != y)
        return x.receivers != y.receivers ? unequal("inflow.receivers", x.receivers, y.receivers)
                                          : unequal("inflow.due", x.due, y.due);
  if (a.kind == b.kind)  // a snapshot does not have the walls
    if (std::string text = wall_difference(g.walls, h.walls); !text.empty()) return text;
  if (a.kind == b.kind)
    if (std::string text = body_difference(g.bodies, h.bodies); !text.empty()) return text;
  if (a.fingerprint != b.fingerprint)
    return fmt::format("fingerprint: {} != {}, yet all state in the files agrees", a.fingerprint,
                       b.fingerprint);
  return {};
}

}  // namespace

std::string first_difference(const std::filesystem::path& path_a, const std::filesystem::path& path_b) {
  const std::unique_ptr<StateFile> a = open_state(path_a);
  const std::unique_ptr<StateFile> b = open_state(path_b);
  const StateSummary& x = a->summary();
  const StateSummary& y = b->summary();
  // What makes all particles incomparable comes first, the particles, then what follows from them.
  if (x.dim != y.dim) return unequal("dim", std::int64_t{x.dim}, std::int64_t{y.dim});
  if (x.scale.quantum != y.scale.quantum) return unequal("quantum", x.scale.quantum, y.scale.quantum);
  if (x.global.step != y.global.step) return unequal("step", x.global.step, y.global.step);
  for (const std::string& text : {missing_field(x, y), missing_field(y, x)})
    if (!text.empty()) return text;

  const Ids ids_a = sorted_ids(*a);
  const Ids ids_b = sorted_ids(*b);
  if (std::string text = missing_particle(*a, *b, ids_a, ids_b); !text.empty()) return text;
  Lowest lowest{ids_a.id.size(), {}};
  for (Field f : x.contents.fields)
    if (std::find(y.contents.fields.begin(), y.contents.fields.end(), f) != y.contents.fields.end())
      compare_field(*a, *b, ids_a, ids_b, f, lowest);
  compare_contacts(*a, *b, ids_a, ids_b, lowest);
  if (lowest.index < ids_a.id.size()) return lowest.text;
  return global_difference(x, y);
}

std::string describe(const std::filesystem::path& path) {
  const std::unique_ptr<StateFile> file = open_state(path);
  const StateSummary& s = file->summary();
  std::string fields;
  for (Field f : s.contents.fields) fields += fmt::format("{}{}", fields.empty() ? "" : ", ", info(f).name);
  std::string others;
  for (const std::string& name : s.contents.other_fields) others += ", " + name;

  std::string out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{} {}\n", s.kind, s.path.string());
  fmt::format_to(to, "step {}  t {} s  dt {} s\n", s.global.step, s.global.time, s.global.dt);
  fmt::format_to(to, "{} particles in {} dimensions, positions in quanta of {:a} m\n", s.rows, s.dim,
                 s.scale.quantum);
  fmt::format_to(to, "state: {}{}\n", fields, s.contents.history ? ", contact history" : "");
  if (s.contents.contacts) fmt::format_to(to, "contacts {}\n", *s.contents.contacts);
  if (!others.empty()) fmt::format_to(to, "derived: {}\n", others.substr(2));
  fmt::format_to(to, "fingerprint {}\n", s.fingerprint);
  fmt::format_to(to, "peperite {} ({}), {}, {}\n", s.program.version, s.program.git, s.program.compiler,
                 s.program.flags);
  fmt::format_to(to, "scene:\n{}", s.scene_toml);
  if (!out.ends_with('\n')) out += '\n';
  return out;
}

}  // namespace sph
