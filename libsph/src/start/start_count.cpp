#include "start/start_count.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>

#include "files/agree.hpp"
#include "scene/grain_fill.hpp"
#include "scene/painting.hpp"
#include "start/lattice.hpp"
#include "start/placement_tile.hpp"
#include "start/start_rows.hpp"

namespace sph {
namespace {

/// Indices along x, first <= k < end.
struct Interval {
  std::int64_t first = 0, end = 0;
};

/// Along one row of the lattice.
class Row {
 public:
  Row(const Scene& scene, const Lattice& lattice, std::int64_t y, std::int64_t z)
      : scene_(scene), lattice_(lattice), at_{0, y, z}, middle_(lattice.point(at_)) {}

  /// The part of the row that lies in the filled extent.
  [[nodiscard]] Interval filled() const {
    const LatticeFill& s = scene_.start.lattice;
    return where([&](const Double3& x) { return lattice_.inside(x); }, 0.5 * (s.lower[0] + s.upper[0]),
                 0.5 * (s.upper[0] - s.lower[0]));
  }
  [[nodiscard]] Interval within(const Region& r) const {
    const std::size_t d = static_cast<std::size_t>(scene_.dim);
    const auto inside = [&](const Double3& x) { return contains(r, x, d); };
    switch (r.shape) {
      case RegionShape::box:
        for (std::size_t a = 1; a < d; ++a)
          if (middle_[a] < r.lower[a] || middle_[a] >= r.upper[a]) return {};
        return where(inside, 0.5 * (r.lower[0] + r.upper[0]), 0.5 * (r.upper[0] - r.lower[0]));
      case RegionShape::ball: {
        double rest = r.radius * r.radius;
        for (std::size_t a = 1; a < d; ++a) rest -= (middle_[a] - r.centre[a]) * (middle_[a] - r.centre[a]);
        if (rest < -1e-9 * r.radius * r.radius) return {};
        return where(inside, r.centre[0], std::sqrt(std::max(rest, 0.0)));
      }
      case RegionShape::cylinder:
      case RegionShape::cone:
        return within_cone(r);
      case RegionShape::everywhere:
      case RegionShape::polygon:
      case RegionShape::mesh:
        break;
    }
    return {lattice_.first(0), lattice_.first(0) + lattice_.count(0)};
  }
  /// Of one with bays each interval within `all`.
  template <class Visit>
  void for_parts(const Region& r, const Interval& all, Visit&& visit) const {
    if (!has_bays(r)) return visit(all);
    const std::size_t d = static_cast<std::size_t>(scene_.dim);
    for (std::int64_t k = all.first; k < all.end;) {
      const std::int64_t first = k;
      const bool inside = contains(r, lattice_.point({k, at_[1], at_[2]}), d);
      while (k < all.end && contains(r, lattice_.point({k, at_[1], at_[2]}), d) == inside) ++k;
      if (inside) visit(Interval{first, k});
    }
  }

 private:
  [[nodiscard]] Interval within_cone(const Region& r) const {
    const std::size_t d = static_cast<std::size_t>(scene_.dim), a = axis_of(r);
    const auto inside = [&](const Double3& x) { return contains(r, x, d); };
    if (a != 0) {
      const double part = part_of_axis(r, middle_[a]), radius = radius_at(r, part);
      double rest = radius * radius;
      if (part < 0 || part >= 1) return {};
      for (std::size_t b = 1; b < d; ++b)
        if (b != a) rest -= (middle_[b] - r.from[b]) * (middle_[b] - r.from[b]);
      if (rest < -1e-9 * radius * radius) return {};
      return where(inside, r.from[0], std::sqrt(std::max(rest, 0.0)));
    }
    // As much of the axis as is thick enough.
    const double away = std::sqrt(from_axis2(r, middle_, d));
    double first = 0, last = 1;
    const double thicker = radius_at(r, 1) - radius_at(r, 0);
    if (thicker == 0 && away >= r.radius) return {};
    if (thicker < 0) last = std::min(last, (away - r.radius) / thicker);
    if (thicker > 0) first = std::max(first, (away - r.radius) / thicker);
    if (first > last + 1e-9) return {};
    const double length = r.to[0] - r.from[0];
    return where(inside, r.from[0] + 0.5 * (first + last) * length,
                 std::max(0.5 * (last - first), 0.0) * std::abs(length));
  }

  /// Where `inside` holds: about middle +- half, but the last word has the point itself.
  template <class Inside>
  [[nodiscard]] Interval where(Inside&& inside, double middle, double half) const {
    const std::int64_t lo = lattice_.first(0), hi = lo + lattice_.count(0) - 1;
    const auto in = [&](std::int64_t k) { return inside(lattice_.point({k, at_[1], at_[2]})); };
    const auto guess = [&](double x) { return std::clamp(lattice_.below(0, x) + 1, lo, hi); };
    std::int64_t first = guess(middle - half), last = guess(middle + half);
    while (first > lo && in(first - 1)) --first;
    while (first <= last + 1 && first < hi && !in(first)) ++first;
    if (!in(first)) return {};
    last = std::max(last, first);
    while (last < hi && in(last + 1)) ++last;
    while (!in(last)) --last;
    return {first, last + 1};
  }

  const Scene& scene_;
  const Lattice& lattice_;
  decomp::Int3 at_;
  Double3 middle_;
};

/// What is counted, and where a row of the lattice is.
struct Tally {
  const Scene& scene;
  const Lattice& lattice;
  std::vector<std::int64_t> by_group;
  std::vector<Height> heights;
  std::vector<std::int64_t> ends{};  ///< of intervals, kept for its memory

  void add(int group, std::int64_t first, std::int64_t end, std::int64_t y, std::int64_t z) {
    const auto g = static_cast<std::size_t>(group);
    by_group[g] += end - first;
    heights[g].add(scene, lattice.point({first, y, z}));
    heights[g].add(scene, lattice.point({end - 1, y, z}));
  }
};

struct Painted {
  Interval where;
  int group;
};

/// Painter's rule: between two ends of intervals the last of them counts.
void add_row(const std::vector<Painted>& painted, std::int64_t y, std::int64_t z, Tally& tally) {
  std::vector<std::int64_t>& ends = tally.ends;
  ends.clear();
  for (const Painted& p : painted) ends.insert(ends.end(), {p.where.first, p.where.end});
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 1; k < ends.size(); ++k) {
    if (ends[k] == ends[k - 1]) continue;
    const auto top = std::find_if(painted.rbegin(), painted.rend(), [&](const Painted& p) {
      return p.where.first <= ends[k - 1] && p.where.end >= ends[k];
    });
    if (top != painted.rend() && top->group >= 0) tally.add(top->group, ends[k - 1], ends[k], y, z);
  }
}

void count_lattice(const decomp::Comm& comm, const Scene& scene, StartCount& count) {
  const Lattice lattice(scene);
  const std::size_t groups = scene.groups.size();
  Tally tally{scene, lattice, std::vector<std::int64_t>(groups, 0), std::vector<Height>(groups)};
  std::vector<Painted> painted;
  const std::int64_t deep = scene.dim == 3 ? lattice.count(2) : 1;
  const std::int64_t rows = lattice.count(1) * deep;
  for (std::int64_t r = comm.rank(); r < rows; r += comm.size()) {
    const std::int64_t y = lattice.first(1) + r % lattice.count(1);
    const std::int64_t z = scene.dim == 3 ? lattice.first(2) + r / lattice.count(1) : 0;
    const Row row(scene, lattice, y, z);
    const Interval filled = row.filled();
    painted.clear();
    for (const Region& region : scene.start.lattice.regions) {
      const Interval all = row.within(region);
      const Interval part{std::max(all.first, filled.first), std::min(all.end, filled.end)};
      if (part.first >= part.end) continue;
      row.for_parts(region, part, [&](const Interval& i) { painted.push_back({i, region.group}); });
    }
    add_row(painted, y, z, tally);
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
