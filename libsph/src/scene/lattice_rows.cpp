#include "scene/lattice_rows.hpp"

#include <algorithm>
#include <cmath>

#include "scene/painting.hpp"

namespace sph {
namespace {

/// Along one row of the lattice.
class Row {
 public:
  Row(const Scene& scene, const Lattice& lattice, std::int64_t y, std::int64_t z)
      : scene_(scene), lattice_(lattice), at_{0, y, z}, middle_(lattice.point(at_)) {}

  [[nodiscard]] RowPart filled() const {
    const LatticeFill& s = scene_.start.lattice;
    return where([&](const Double3& x) { return lattice_.inside(x); }, 0.5 * (s.lower[0] + s.upper[0]),
                 0.5 * (s.upper[0] - s.lower[0]));
  }
  /// What a region paints of `filled`.
  void paint(const Region& r, const RowPart& filled, std::vector<RowPart>& out) const {
    const RowPart all = within(r);
    const RowPart part{std::max(all.first, filled.first), std::min(all.end, filled.end), r.group};
    if (part.first >= part.end) return;
    if (!has_bays(r)) return out.push_back(part);
    const std::size_t d = static_cast<std::size_t>(scene_.dim);
    for (std::int64_t k = part.first; k < part.end;) {
      const std::int64_t first = k;
      const bool inside = contains(r, lattice_.point({k, at_[1], at_[2]}), d);
      while (k < part.end && contains(r, lattice_.point({k, at_[1], at_[2]}), d) == inside) ++k;
      if (inside) out.push_back({first, k, r.group});
    }
  }

 private:
  [[nodiscard]] RowPart within(const Region& r) const {
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
      case RegionShape::polygon:
      case RegionShape::mesh:
        return around_bays(r);
      case RegionShape::everywhere:
        break;
    }
    return {lattice_.first(0), lattice_.first(0) + lattice_.count(0)};
  }
  /// Where it may be, from the box around it.
  [[nodiscard]] RowPart around_bays(const Region& r) const {
    if (r.shape == RegionShape::mesh && r.mesh.volume == nullptr) return {};
    Double3 lower{}, upper{};
    if (r.shape == RegionShape::mesh)
      lower = r.mesh.volume->lower(), upper = r.mesh.volume->upper();
    else
      for (std::size_t a = 0; a < 2; ++a) {
        const auto of_axis = [a](const auto& point) { return point[a]; };
        lower[a] = std::ranges::min(r.points, {}, of_axis)[a];
        upper[a] = std::ranges::max(r.points, {}, of_axis)[a];
      }
    for (std::size_t a = 1; a < static_cast<std::size_t>(scene_.dim); ++a)
      if (middle_[a] < lower[a] || middle_[a] > upper[a]) return {};
    const std::int64_t lo = lattice_.first(0), hi = lo + lattice_.count(0);
    // Rows are half a cell aside in turn: the first place that is not below, and one beyond the last.
    return {std::clamp(lattice_.below(0, lower[0]), lo, hi),
            std::clamp(lattice_.below(0, upper[0]) + 3, lo, hi)};
  }
  [[nodiscard]] RowPart within_cone(const Region& r) const {
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
  [[nodiscard]] RowPart where(Inside&& inside, double middle, double half) const {
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

}  // namespace

const std::vector<RowPart>& LatticeRows::parts(std::int64_t y, std::int64_t z) {
  parts_.clear();
  const Row row(scene_, lattice_, y, z);
  const RowPart filled = row.filled();
  if (filled.first >= filled.end) return parts_;
  painted_.clear();
  for (const Region& region : scene_.start.lattice.regions)
    if (bays_ == Bays::all || !has_bays(region) || region.group < 0) row.paint(region, filled, painted_);
  ends_.assign({filled.first, filled.end});
  for (const RowPart& p : painted_) ends_.insert(ends_.end(), {p.first, p.end});
  std::sort(ends_.begin(), ends_.end());
  for (std::size_t k = 1; k < ends_.size(); ++k) {
    if (ends_[k] == ends_[k - 1]) continue;
    // Painter's rule: the last of them counts.
    const auto top = std::find_if(painted_.rbegin(), painted_.rend(), [&](const RowPart& p) {
      return p.first <= ends_[k - 1] && p.end >= ends_[k];
    });
    parts_.push_back({ends_[k - 1], ends_[k], top == painted_.rend() ? -1 : top->group});
  }
  return parts_;
}

RowPart filled_part(const Scene& scene, const Lattice& lattice, std::int64_t y, std::int64_t z) {
  return Row(scene, lattice, y, z).filled();
}

}  // namespace sph
