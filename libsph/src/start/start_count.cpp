#include "start/start_count.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>

#include "files/agree.hpp"
#include "scene/grain_fill.hpp"
#include "scene/lattice_rows.hpp"
#include "start/placement_tile.hpp"
#include "start/start_rows.hpp"

namespace sph {
namespace {

/// What is counted, and where a row of the lattice is.
struct Tally {
  const Scene& scene;
  const Lattice& lattice;
  std::vector<std::int64_t> by_group;
  std::vector<Height> heights;

  void add(const RowPart& part, std::int64_t y, std::int64_t z) {
    const auto g = static_cast<std::size_t>(part.group);
    by_group[g] += part.end - part.first;
    heights[g].add(scene, lattice.point({part.first, y, z}));
    heights[g].add(scene, lattice.point({part.end - 1, y, z}));
  }
};

void count_lattice(const decomp::Comm& comm, const Scene& scene, StartCount& count) {
  const Lattice lattice(scene);
  const std::size_t groups = scene.groups.size();
  Tally tally{scene, lattice, std::vector<std::int64_t>(groups, 0), std::vector<Height>(groups)};
  LatticeRows along(scene, lattice);
  const std::int64_t deep = scene.dim == 3 ? lattice.count(2) : 1;
  const std::int64_t rows = lattice.count(1) * deep;
  for (std::int64_t r = comm.rank(); r < rows; r += comm.size()) {
    const std::int64_t y = lattice.first(1) + r % lattice.count(1);
    const std::int64_t z = scene.dim == 3 ? lattice.first(2) + r / lattice.count(1) : 0;
    for (const RowPart& part : along.parts(y, z))
      if (part.group >= 0) tally.add(part, y, z);
  }
  comm.sum(std::span<std::int64_t>(tally.by_group));
  Height::unite(comm, tally.heights);
  count.by_group = std::move(tally.by_group);
  count.heights = std::move(tally.heights);
}

std::int64_t count_occupied(const decomp::Comm& comm, const Scene& scene, const GrainFill& fill) {
  if (fill.occupied == 1) return count(fill);
  const std::uint64_t first = first_id(scene, fill);
  std::array<std::int64_t, 1> n{0};
  for (std::int64_t k = comm.rank(); k < count(fill); k += comm.size())
    n[0] += is_occupied(scene, fill, first + static_cast<std::uint64_t>(k)) ? 1 : 0;
  comm.sum(std::span<std::int64_t>(n));
  return n[0];
}

void count_fills(const decomp::Comm& comm, const Scene& scene, StartCount& start) {
  for (const GrainFill& fill : scene.start.fills) {
    const auto group = static_cast<std::size_t>(fill.group);
    start.by_group[group] += count_occupied(comm, scene, fill);
    start.heights[group].add(scene, point(fill, {0, 0, 0}));
    start.heights[group].add(
        scene, point(fill, {points_of(fill, 0) - 1, points_of(fill, 1) - 1, points_of(fill, 2) - 1}));
  }
}

std::vector<std::int64_t> count_tiles(const decomp::Comm& comm, const Scene& scene) {
  std::vector<std::int64_t> by_group(scene.groups.size(), 0);
  in_row_order(comm, scene.start.tile.file, [&] {
    const StartRows rows = read_rows(scene, scene.start.tile.file, 0, 1);
    check_tile_count(scene, rows.id.size());
    for (std::size_t k = 0; k < rows.id.size(); ++k) {
      check_row(rows, k, scene);
      ++by_group[rows.group[k]];
    }
  });
  for (std::int64_t& n : by_group)
    for (const std::int64_t copies : scene.start.tile.repeat) n *= copies;
  return by_group;
}

}  // namespace

void Height::add(const Scene& scene, const Double3& x) {
  double g2 = 0, height = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double g =
        scene.domain.periodic[a] ? 0.0 : scene.domain.gravity[a];  // along a period it drives a flow
    g2 += g * g;
    height -= g * x[a];
  }
  if (g2 > 0) height /= std::sqrt(g2);
  low = std::min(low, height);
  high = std::max(high, height);
}

void Height::unite(const decomp::Comm& comm, std::vector<Height>& heights) {
  std::vector<double> ends;
  for (const Height& h : heights) ends.insert(ends.end(), {-h.low, h.high});
  comm.max(std::span<double>(ends));
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = {-ends[2 * k], ends[2 * k + 1]};
}

StartCount count_start(const decomp::Comm& comm, const Scene& scene) {
  StartCount count;
  if (!scene.start.file.empty()) {
    in_row_order(comm, scene.start.file, [&] { count.all = count_rows(scene.start.file); });
    return count;
  }
  if (scene.start.tile.file.empty())
    count_lattice(comm, scene, count);
  else
    count.by_group = count_tiles(comm, scene);
  count_fills(comm, scene, count);
  count.all = std::accumulate(count.by_group.begin(), count.by_group.end(), std::int64_t{0});
  return count;
}

}  // namespace sph
