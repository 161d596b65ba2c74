#include "start/placement_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "decomp/migrate.hpp"
#include "start/start_rows.hpp"

namespace sph {
namespace {

/// What must differ from row to row, with the row's number.
struct Key {
  decomp::Int3 value{};
  std::int64_t number = 0;
  friend auto operator<=>(const Key&, const Key&) = default;
};

decomp::Rank home_of(const decomp::Int3& value, int ranks) {
  std::uint64_t z = 0;
  for (const std::int64_t v : value) {
    z = (z ^ static_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15u;
    z ^= z >> 32;
  }
  return static_cast<decomp::Rank>(z % static_cast<std::uint64_t>(ranks));
}

/// Equal keys meet on one rank. `text(value, earlier)` says what is wrong with a row whose key the row
/// numbered `earlier` has too.
template <class Text>
void check_differ(const decomp::Comm& comm, const Scene& scene, const StartRows& rows,
                  const std::vector<decomp::Int3>& keys, Text&& text) {
  decomp::Table table;
  const int column = table.add_column("key", sizeof(Key));
  table.resize(keys.size(), 0);
  std::vector<decomp::Rank> to;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    table.as<Key>(column)[k] = {keys[k], rows.number[k]};
    to.push_back(home_of(keys[k], comm.size()));
  }
  decomp::redistribute(comm, to, table, nullptr);
  in_row_order(comm, scene.start.file, [&] {
    std::vector<Key> all(table.as<Key>(column), table.as<Key>(column) + table.owned());
    std::sort(all.begin(), all.end());
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    std::string what;
    for (std::size_t k = 1; k < all.size(); ++k)
      if (all[k].value == all[k - 1].value && all[k].number < first) {
        first = all[k].number;
        what = fmt::format("{} {}: {}", rows.unit, first, text(all[k].value, all[k - 1].number));
      }
    if (!what.empty()) throw RowProblem(first, what);
  });
}

}  // namespace

void place_particles_from_file(const Scene& scene, const PositionScale& scale, Distribution& distribution,
                               Particles& particles) {
  const decomp::Comm& comm = distribution.comm();
  const decomp::CellGrid& grid = distribution.grid();
  StartRows rows;
  std::vector<decomp::Int3> ids, places;
  in_row_order(comm, scene.start.file, [&] {
    rows = read_rows(scene, scene.start.file, comm.rank(), comm.size());
    for (std::size_t k = 0; k < rows.id.size(); ++k) {
      check_row(rows, k, scene);
      ids.push_back({static_cast<std::int64_t>(rows.id[k]), 0, 0});
      places.push_back(grid.wrap(quanta_of(rows, k, scale, scene.dim)));
      if (!grid.inside(places.back()))
        fail_row(rows, k, fmt::format("particle {} lies outside the domain", rows.id[k]));
    }
  });
  check_differ(comm, scene, rows, ids, [&](const decomp::Int3& id, std::int64_t earlier) {
    return fmt::format("id {} was given in {} {} already", static_cast<std::uint64_t>(id[0]), rows.unit,
                       earlier);
  });
  // What acts between two centres that coincide would have no direction.
  check_differ(comm, scene, rows, places, [&](const decomp::Int3&, std::int64_t earlier) {
    return fmt::format("the {} lies at exactly the point of that in {} {}",
                       scene.of_grains() ? "grain" : "particle", rows.unit, earlier);
  });
  const InitialFields fields(scene);
  for (std::size_t k = 0; k < rows.id.size(); ++k)
    add_row(rows, k, rows.id[k], places[k], fields, scene, scale, particles);
  distribution.scatter(particles);
}

}  // namespace sph
