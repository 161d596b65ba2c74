#include "start/placement_tile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "files/hdf5_file.hpp"
#include "scene/record.hpp"
#include "start/start_rows.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};

/// The copies along one axis, in quanta from the domain's lower corner.
struct Repeat {
  std::int64_t length = 0, copies = 1;
  [[nodiscard]] std::int64_t period() const { return length / copies; }
  /// Where copy k begins: round-off is spread over the copies, so that the last one ends with the domain.
  [[nodiscard]] std::int64_t start(std::int64_t k) const {
    return period() * k + length % copies * k / copies;
  }
  /// Copies that reach into [lo, hi).
  [[nodiscard]] std::vector<std::int64_t> within(std::int64_t lo, std::int64_t hi) const {
    std::vector<std::int64_t> out;
    for (std::int64_t k = 0; k < copies; ++k)
      if (copies == 1 || (start(k) + period() > lo && start(k) < hi)) out.push_back(k);
    return out;
  }
};
using Repeats = std::array<Repeat, 3>;

/// A snapshot knows the length of its domain: another period would leave gaps or overlaps at every seam.
void check_lengths(const Scene& scene, const StartRows& rows) {
  if (rows.position.quanta.empty()) return;
  constexpr double rounding = 1e-9;
  const std::string& file = scene.start.tile.file;
  const Scene settled = parse_record(Hdf5Reader(file).text("scene"), file);
  for (std::size_t a = 0; a < 3; ++a) {
    const auto copies = static_cast<double>(scene.start.tile.repeat[a]);
    const double wanted = (scene.domain.upper[a] - scene.domain.lower[a]) / copies;
    const double found = settled.domain.upper[a] - settled.domain.lower[a];
    if (copies > 1 && !(std::fabs(found - wanted) <= rounding * wanted))
      throw RowProblem(
          0, fmt::format("its domain is {} m long in {}; {} copies in the scene's domain have {} m", found,
                         axis_names[a], copies, wanted));
  }
}

/// From the domain's lower corner; on a repeated axis within [0, period).
decomp::Int3 place_in_tile(const StartRows& rows, std::size_t k, const PositionScale& scale,
                           const decomp::CellGrid& grid, const Repeats& repeats) {
  constexpr std::int64_t rounding = 1;  // of a tile whose quantum is finer
  const decomp::Int3 q = grid.wrap(quanta_of(rows, k, scale, 3));
  decomp::Int3 place{};
  const auto outside = [&](std::size_t a) {
    fail_row(
        rows, k,
        fmt::format("particle {} lies outside the tile in {}, which is {} to {} m", rows.id[k], axis_names[a],
                    scale.metres(grid.origin()[a]), scale.metres(grid.origin()[a] + repeats[a].period())));
  };
  for (std::size_t a = 0; a < 3; ++a) {
    const Repeat& repeat = repeats[a];
    place[a] = q[a] - grid.origin()[a];
    if (repeat.copies == 1) {
      if (place[a] < 0 || place[a] > repeat.length) outside(a);
      continue;
    }
    // Wrapped at the domain's end instead of the tile's.
    if (grid.periodic()[a] && place[a] >= repeat.length - rounding) place[a] -= repeat.length;
    if (place[a] < -rounding || place[a] > repeat.period() + rounding) outside(a);
    if (place[a] < 0) place[a] += repeat.period();
    if (place[a] >= repeat.period()) place[a] -= repeat.period();
  }
  return place;
}

void check_differ(const StartRows& rows, const std::vector<std::size_t>& by_id,
                  const std::vector<decomp::Int3>& places) {
  for (std::size_t n = 1; n < by_id.size(); ++n)
    if (rows.id[by_id[n]] == rows.id[by_id[n - 1]])
      fail_row(rows, by_id[n], fmt::format("id {} is there twice", rows.id[by_id[n]]));
  std::vector<std::size_t> by_place = by_id;
  std::stable_sort(by_place.begin(), by_place.end(),
                   [&](std::size_t i, std::size_t j) { return places[i] < places[j]; });
  for (std::size_t n = 1; n < by_place.size(); ++n)
    if (places[by_place[n]] == places[by_place[n - 1]])
      fail_row(rows, by_place[n],
               fmt::format("grain {} lies at exactly the point of grain {}", rows.id[by_place[n]],
                           rows.id[by_place[n - 1]]));
}

}  // namespace

void check_tile_count(const Scene& scene, std::size_t grains) {
  constexpr double most_grains = 1e12;
  double all = static_cast<double>(grains);
  for (const std::int64_t n : scene.start.tile.repeat) all *= static_cast<double>(n);
  if (grains == 0) throw RowProblem(0, "holds no grains");
  if (all > most_grains) throw RowProblem(0, fmt::format("so many copies would make {:.1e} grains", all));
}

void place_tiles(const Scene& scene, const PositionScale& scale, const Distribution& distribution,
                 Particles& particles) {
  const decomp::CellGrid& grid = distribution.grid();
  const decomp::Box own = distribution.own_cells();
  const Tile& tile = scene.start.tile;
  Repeats repeats;
  std::array<std::vector<std::int64_t>, 3> copies;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto from_corner = [&](std::int64_t line) {
      return grid.line(static_cast<int>(a), line) - grid.origin()[a];
    };
    repeats[a] = {grid.length()[a], tile.repeat[a]};
    copies[a] = repeats[a].within(from_corner(own.lo[a]), from_corner(own.hi[a]));
  }
  StartRows rows;
  std::vector<decomp::Int3> places;
  std::vector<std::size_t> by_id;
  in_row_order(distribution.comm(), tile.file, [&] {
    rows = read_rows(scene, tile.file, 0, 1);
    check_tile_count(scene, rows.id.size());
    check_lengths(scene, rows);
    for (std::size_t k = 0; k < rows.id.size(); ++k) {
      check_row(rows, k, scene);
      places.push_back(place_in_tile(rows, k, scale, grid, repeats));
    }
    by_id.resize(rows.id.size());
    std::iota(by_id.begin(), by_id.end(), std::size_t{0});
    std::sort(by_id.begin(), by_id.end(),
              [&](std::size_t i, std::size_t j) { return rows.id[i] < rows.id[j]; });
    check_differ(rows, by_id, places);
  });
  const InitialFields fields(scene);
  for (const std::int64_t kz : copies[2])
    for (const std::int64_t ky : copies[1])
      for (const std::int64_t kx : copies[0]) {
        const std::int64_t copy = (kz * tile.repeat[1] + ky) * tile.repeat[0] + kx;
        const decomp::Int3 shift{repeats[0].start(kx), repeats[1].start(ky), repeats[2].start(kz)};
        for (std::size_t n = 0; n < by_id.size(); ++n) {
          decomp::Int3 q = places[by_id[n]];
          for (std::size_t a = 0; a < 3; ++a) q[a] += grid.origin()[a] + shift[a];
          if (!own.contains(grid.cell_of(q))) continue;
          const std::uint64_t id = static_cast<std::uint64_t>(copy) * by_id.size() + n;
          add_row(rows, by_id[n], id, q, fields, scene, scale, particles);
        }
      }
}

}  // namespace sph
