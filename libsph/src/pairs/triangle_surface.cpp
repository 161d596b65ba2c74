#include "sph/pairs/triangle_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sph/core/exact_math.hpp"

namespace sph {
namespace {

Point3 minus(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

NearPoint near(const Point3& x, const Point3& point, const Feature& of) {
  const Point3 d = minus(x, point);
  return {point, dot(d, d), of};
}

/// Of the edge between vertices a < b at `from` and `to`.
NearPoint nearest_of_edge(const Point3& x, const Point3& from, const Point3& to, std::uint32_t a,
                          std::uint32_t b) {
  const Point3 along = minus(to, from);
  const double t = dot(minus(x, from), along), whole = dot(along, along);
  if (!(t > 0)) return near(x, from, {a, a});
  if (!(t < whole)) return near(x, to, {b, b});
  const double share = t / whole;
  return near(x, {from[0] + share * along[0], from[1] + share * along[1], from[2] + share * along[2]},
              {a, b});
}

}  // namespace

TriangleSurface::TriangleSurface(std::vector<Point3> vertices, std::vector<Triangle> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  normals_.reserve(size());
  for (const Triangle& t : triangles_) {
    Point3 n = cross(minus(vertices_[t[1]], vertices_[t[0]]), minus(vertices_[t[2]], vertices_[t[0]]));
    const double length = std::sqrt(dot(n, n));
    for (double& c : n) c /= length;
    normals_.push_back(n);
  }
  for (const Point3& v : vertices_) radius_ = std::max(radius_, std::sqrt(dot(v, v)));
  make_grid();
}

NearPoint TriangleSurface::nearest(std::size_t triangle, const Point3& x) const {
  const Triangle& t = triangles_[triangle];
  const Point3& n = normals_[triangle];
  bool inside = true;
  for (std::size_t k = 0; k < 3 && inside; ++k) {
    const Point3 &from = vertices_[t[k]], &to = vertices_[t[(k + 1) % 3]];
    inside = dot(cross(n, minus(to, from)), minus(x, from)) >= 0;
  }
  if (inside) {
    const double away = dot(minus(x, vertices_[t[0]]), n);
    return {{x[0] - away * n[0], x[1] - away * n[1], x[2] - away * n[2]}, away * away, {}};
  }
  NearPoint best{{}, std::numeric_limits<double>::infinity(), {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
    const NearPoint now = nearest_of_edge(x, vertices_[a], vertices_[b], a, b);
    if (now.square < best.square) best = now;
  }
  return best;
}

bool TriangleSurface::has(std::size_t triangle, const Feature& f) const {
  const Triangle& t = triangles_[triangle];
  return std::ranges::find(t, f.a) != t.end() && std::ranges::find(t, f.b) != t.end();
}

bool TriangleSurface::share_vertex(std::size_t one, std::size_t other) const {
  return std::ranges::any_of(triangles_[one], [&](std::uint32_t v) { return has(other, {v, v}); });
}

// About as many cells as triangles: boxes of large ones meet many cells, and many small ones share one.
void TriangleSurface::make_grid() {
  Point3 upper;
  lower_ = upper = vertices_.front();
  for (const Point3& v : vertices_)
    for (std::size_t a = 0; a < 3; ++a) {
      lower_[a] = std::min(lower_[a], v[a]);
      upper[a] = std::max(upper[a], v[a]);
    }
  double longest = 0, volume = 1;
  for (std::size_t a = 0; a < 3; ++a) longest = std::max(longest, upper[a] - lower_[a]);
  for (std::size_t a = 0; a < 3; ++a) volume *= std::max(upper[a] - lower_[a], 0.01 * longest);
  edge_ = exact_pow(volume / static_cast<double>(size()), 1.0 / 3);
  for (std::size_t a = 0; a < 3; ++a)
    count_[a] = std::max(std::int64_t{1}, static_cast<std::int64_t>((upper[a] - lower_[a]) / edge_) + 1);

  const auto box_of = [&](const Triangle& t) {
    Point3 least = vertices_[t[0]], most = least;
    for (std::uint32_t v : t)
      for (std::size_t a = 0; a < 3; ++a) {
        least[a] = std::min(least[a], vertices_[v][a]);
        most[a] = std::max(most[a], vertices_[v][a]);
      }
    return cells(least, most);
  };
  offset_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
  for (const Triangle& t : triangles_) for_cells(box_of(t), [&](std::size_t cell) { ++offset_[cell + 1]; });
  for (std::size_t c = 1; c < offset_.size(); ++c) offset_[c] += offset_[c - 1];
  in_cells_.resize(offset_.back());
  std::vector<std::uint64_t> at(offset_.begin(), offset_.end() - 1);
  for (std::size_t k = 0; k < size(); ++k)
    for_cells(box_of(triangles_[k]),
              [&](std::size_t cell) { in_cells_[at[cell]++] = static_cast<std::uint32_t>(k); });
}

TriangleSurface::Cells TriangleSurface::cells(const Point3& lower, const Point3& upper) const {
  Cells box{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double most = static_cast<double>(count_[a]);
    box.first[a] =
        static_cast<std::int64_t>(std::clamp(std::floor((lower[a] - lower_[a]) / edge_), 0.0, most));
    box.last[a] = std::min(
        static_cast<std::int64_t>(std::clamp(std::floor((upper[a] - lower_[a]) / edge_), -1.0, most)),
        count_[a] - 1);
  }
  return box;
}

template <class Visit>
void TriangleSurface::for_cells(const Cells& box, Visit&& visit) const {
  for (std::int64_t i = box.first[0]; i <= box.last[0]; ++i)
    for (std::int64_t j = box.first[1]; j <= box.last[1]; ++j)
      for (std::int64_t k = box.first[2]; k <= box.last[2]; ++k)
        visit(static_cast<std::size_t>((i * count_[1] + j) * count_[2] + k));
}

void TriangleSurface::find(const Point3& x, double reach, std::vector<std::uint32_t>& out) const {
  out.clear();
  // Wider than the boxes that make_grid() has rounded to cells.
  const double wide = 1.0001 * reach;
  const Cells box = cells({x[0] - wide, x[1] - wide, x[2] - wide}, {x[0] + wide, x[1] + wide, x[2] + wide});
  for_cells(box, [&](std::size_t cell) {
    out.insert(out.end(), in_cells_.begin() + static_cast<std::ptrdiff_t>(offset_[cell]),
               in_cells_.begin() + static_cast<std::ptrdiff_t>(offset_[cell + 1]));
  });
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  std::erase_if(out, [&](std::uint32_t t) { return !(nearest(t, x).square < reach * reach); });
}

std::size_t TriangleSurface::bytes() const {
  return vertices_.capacity() * sizeof(Point3) + triangles_.capacity() * sizeof(Triangle) +
         normals_.capacity() * sizeof(Point3) + offset_.capacity() * 8 + in_cells_.capacity() * 4;
}

}  // namespace sph
