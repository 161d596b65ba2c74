#include "sph/pairs/triangle_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "decomp/memory.hpp"
#include "pairs/lies_beyond.hpp"
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

/// The next array of a block.
template <class T, class Byte>
std::span<T> take(Byte*& at, std::uint64_t count) {
  T* const begin = reinterpret_cast<T*>(at);
  at += count * sizeof(T);
  return {begin, count};
}

/// Places of triangles in cells, on average, beyond which cells are made wider.
constexpr std::uint64_t most_places = 16;

}  // namespace

TriangleSurface::TriangleSurface(std::span<const Point3> vertices, std::span<const Triangle> triangles) {
  Head head{vertices.size(), triangles.size(), 0, 0, 0, {}, 1, {1, 1, 1}};
  for (const Point3& v : vertices) head.radius = std::max(head.radius, std::sqrt(dot(v, v)));
  choose_cells(head, vertices, triangles);
  const std::size_t size =
      sizeof(Head) + vertices.size_bytes() + triangles.size_bytes() + 4 * (head.cells + 1 + head.in_cells);
  const std::shared_ptr<std::byte> block(static_cast<std::byte*>(decomp::allocate_large(size)),
                                         decomp::release_large);
  std::byte* at = block.get();
  take<Head>(at, 1).front() = head;
  std::ranges::copy(vertices, take<Point3>(at, vertices.size()).begin());
  std::ranges::copy(triangles, take<Triangle>(at, triangles.size()).begin());
  const auto offset = take<std::uint32_t>(at, head.cells + 1),
             in_cells = take<std::uint32_t>(at, head.in_cells);
  // Offsets are those of the next cell until its triangles are in place.
  std::ranges::fill(offset, 0U);
  for (const Triangle& t : triangles)
    for_cells(head, cells_of(head, vertices, t), [&](std::size_t cell) { ++offset[cell]; });
  std::uint32_t before = 0;
  for (std::uint32_t& o : offset) o = std::exchange(before, before + o);
  for (std::size_t k = 0; k < triangles.size(); ++k)
    for_cells(head, cells_of(head, vertices, triangles[k]),
              [&](std::size_t cell) { in_cells[offset[cell]++] = static_cast<std::uint32_t>(k); });
  std::shift_right(offset.begin(), offset.end(), 1);
  offset.front() = 0;
  look_into(block);
}

TriangleSurface::TriangleSurface(std::shared_ptr<const std::byte> block) { look_into(std::move(block)); }

void TriangleSurface::look_into(std::shared_ptr<const std::byte> block) {
  block_ = std::move(block);
  const std::byte* at = block_.get();
  head_ = take<const Head>(at, 1).data();
  vertices_ = take<const Point3>(at, head_->vertices);
  triangles_ = take<const Triangle>(at, head_->triangles);
  offset_ = take<const std::uint32_t>(at, head_->cells + 1);
  in_cells_ = take<const std::uint32_t>(at, head_->in_cells);
}

Point3 TriangleSurface::normal(std::size_t triangle) const {
  const Triangle& t = triangles_[triangle];
  Point3 n = cross(minus(vertices_[t[1]], vertices_[t[0]]), minus(vertices_[t[2]], vertices_[t[0]]));
  const double length = std::sqrt(dot(n, n));
  for (double& c : n) c /= length;
  return n;
}

NearPoint TriangleSurface::nearest(std::size_t triangle, const Point3& x) const {
  const Triangle& t = triangles_[triangle];
  const Point3 n = normal(triangle);
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

/// Of the triangles' boxes, the lower and the upper corner.
std::array<Point3, 2> TriangleSurface::box_of(std::span<const Point3> vertices, const Triangle& t) {
  Point3 least = vertices[t[0]], most = least;
  for (std::uint32_t v : t)
    for (std::size_t a = 0; a < 3; ++a) {
      least[a] = std::min(least[a], vertices[v][a]);
      most[a] = std::max(most[a], vertices[v][a]);
    }
  return {least, most};
}

// About as many cells as triangles: boxes of large ones meet many cells, and many small ones share one.
void TriangleSurface::choose_cells(Head& head, std::span<const Point3> vertices,
                                   std::span<const Triangle> triangles) {
  Point3 upper;
  head.lower = upper = vertices.front();
  for (const Point3& v : vertices)
    for (std::size_t a = 0; a < 3; ++a) {
      head.lower[a] = std::min(head.lower[a], v[a]);
      upper[a] = std::max(upper[a], v[a]);
    }
  double longest = 0, volume = 1;
  for (std::size_t a = 0; a < 3; ++a) longest = std::max(longest, upper[a] - head.lower[a]);
  for (std::size_t a = 0; a < 3; ++a) volume *= std::max(upper[a] - head.lower[a], 0.01 * longest);
  head.edge = exact_pow(volume / static_cast<double>(triangles.size()), 1.0 / 3);
  const std::uint64_t most = most_places * triangles.size();
  for (head.in_cells = most + 1; head.in_cells > most; head.edge *= 2) {
    head.cells = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      head.count[a] = static_cast<std::int64_t>((upper[a] - head.lower[a]) / head.edge) + 1;
      head.cells *= static_cast<std::uint64_t>(head.count[a]);
    }
    head.in_cells = 0;
    for (const Triangle& t : triangles) {
      const Cells box = cells_of(head, vertices, t);
      std::uint64_t places = 1;
      for (std::size_t a = 0; a < 3; ++a)
        places *= static_cast<std::uint64_t>(box.last[a] - box.first[a] + 1);
      head.in_cells += places;
    }
    if (head.in_cells <= most) break;
  }
}

TriangleSurface::Cells TriangleSurface::cells_of(const Head& head, std::span<const Point3> vertices,
                                                 const Triangle& t) {
  const auto [least, most] = box_of(vertices, t);
  return cells(head, least, most);
}

TriangleSurface::Cells TriangleSurface::cells(const Head& head, const Point3& lower, const Point3& upper) {
  Cells box{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double most = static_cast<double>(head.count[a]);
    box.first[a] =
        static_cast<std::int64_t>(std::clamp(std::floor((lower[a] - head.lower[a]) / head.edge), 0.0, most));
    box.last[a] = std::min(
        static_cast<std::int64_t>(std::clamp(std::floor((upper[a] - head.lower[a]) / head.edge), -1.0, most)),
        head.count[a] - 1);
  }
  return box;
}

template <class Visit>
void TriangleSurface::for_cells(const Head& head, const Cells& box, Visit&& visit) {
  for (std::int64_t i = box.first[0]; i <= box.last[0]; ++i)
    for (std::int64_t j = box.first[1]; j <= box.last[1]; ++j)
      for (std::int64_t k = box.first[2]; k <= box.last[2]; ++k)
        visit(static_cast<std::size_t>((i * head.count[1] + j) * head.count[2] + k));
}

void TriangleSurface::find(const Point3& x, double reach, std::vector<std::uint32_t>& out) const {
  out.clear();
  // Wider than the boxes that choose_cells() has rounded to cells.
  const double wide = 1.0001 * reach;
  const Cells box =
      cells(*head_, {x[0] - wide, x[1] - wide, x[2] - wide}, {x[0] + wide, x[1] + wide, x[2] + wide});
  for_cells(*head_, box, [&](std::size_t cell) {
    for (std::size_t k = offset_[cell]; k < offset_[cell + 1]; ++k)
      if (!lies_beyond(*this, in_cells_[k], x, reach)) out.push_back(in_cells_[k]);
  });
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  std::erase_if(out, [&](std::uint32_t t) { return !(nearest(t, x).square < reach * reach); });
}

std::size_t TriangleSurface::bytes() const {
  return sizeof(Head) + vertices_.size_bytes() + triangles_.size_bytes() + offset_.size_bytes() +
         in_cells_.size_bytes();
}

}  // namespace sph
