#include "scene/mesh_volume.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sph {
namespace {

constexpr double most_squares = 2048;    ///< along an axis
constexpr std::size_t most_places = 16;  ///< of a triangle, on average

std::array<double, 2> seen_along(std::size_t axis, const Double3& x) {
  const auto [b, c] = others(axis);
  return {x[b], x[c]};
}

}  // namespace

MeshVolume::MeshVolume(std::vector<Double3> vertices, std::vector<Corners> corners)
    : vertices_(std::move(vertices)), corners_(std::move(corners)), lower_(vertices_.at(0)), upper_(lower_) {
  for (const Double3& x : vertices_)
    for (std::size_t a = 0; a < 3; ++a) {
      lower_[a] = std::min(lower_[a], x[a]);
      upper_[a] = std::max(upper_[a], x[a]);
    }
  for (std::size_t a = 0; a < 3; ++a) sort(a);
}

std::size_t MeshVolume::square(std::size_t axis, std::size_t other, double x) const {
  const Across& across = across_[axis];
  const double k = (x - lower_[others(axis)[other]]) * across.per_length[other];
  return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(across.count[other] - 1)));
}

void MeshVolume::sort(std::size_t axis) {
  Across& across = across_[axis];
  const auto divide = [&](double wanted) {
    for (std::size_t o = 0; o < 2; ++o) {
      const double length = upper_[others(axis)[o]] - lower_[others(axis)[o]];
      across.count[o] = length > 0 ? static_cast<std::size_t>(wanted) : 1;
      across.per_length[o] = length > 0 ? static_cast<double>(across.count[o]) / length : 0;
    }
  };
  const auto box_of = [&](const Corners& t) {
    std::array<std::array<std::size_t, 2>, 2> box{};
    for (std::size_t o = 0; o < 2; ++o) {
      const std::size_t a = others(axis)[o];
      const auto [least, most] = std::minmax({vertices_[t[0]][a], vertices_[t[1]][a], vertices_[t[2]][a]});
      box[o] = {square(axis, o, least), square(axis, o, most)};
    }
    return box;
  };
  const auto squares_of = [&](const Corners& t) {
    const auto box = box_of(t);
    return (box[0][1] - box[0][0] + 1) * (box[1][1] - box[1][0] + 1);
  };
  const auto for_squares = [&](const Corners& t, auto&& visit) {
    const auto [b_range, c_range] = box_of(t);
    for (std::size_t c = c_range[0]; c <= c_range[1]; ++c)
      for (std::size_t b = b_range[0]; b <= b_range[1]; ++b) visit(c * across.count[0] + b);
  };
  // Slender triangles that lie askew have many squares in their boxes.
  double wanted = std::min(std::ceil(std::sqrt(static_cast<double>(corners_.size()))), most_squares);
  for (std::size_t places = most_places * corners_.size() + 1; places > most_places * corners_.size();
       wanted = std::ceil(wanted / 2)) {
    divide(wanted);
    places = 0;
    for (const Corners& t : corners_) places += squares_of(t);
    if (wanted == 1) break;
  }
  across.first.assign(across.count[0] * across.count[1] + 1, 0);
  for (const Corners& t : corners_) for_squares(t, [&](std::size_t s) { ++across.first[s + 1]; });
  for (std::size_t s = 1; s < across.first.size(); ++s) across.first[s] += across.first[s - 1];
  across.triangles.resize(across.first.back());
  std::vector<std::uint32_t> next = across.first;
  for (std::uint32_t t = 0; t < corners_.size(); ++t)
    for_squares(corners_[t], [&](std::size_t s) { across.triangles[next[s]++] = t; });
}

std::size_t MeshVolume::open_edges() const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * corners_.size());
  for (const Corners& t : corners_)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax({t[k], t[(k + 1) % 3]}));
  std::ranges::sort(edges);
  std::size_t open = 0;
  for (auto from = edges.begin(); from != edges.end();) {
    const auto to = std::ranges::find_if(from, edges.end(), [&](const auto& e) { return e != *from; });
    open += static_cast<std::size_t>((to - from) % 2);
    from = to;
  }
  return open;
}

std::size_t MeshVolume::bytes() const {
  std::size_t sum = vertices_.capacity() * sizeof(Double3) + corners_.capacity() * sizeof(Corners);
  for (const Across& a : across_) sum += (a.first.capacity() + a.triangles.capacity()) * 4;
  return sum;
}

bool MeshVolume::contains(const Double3& x) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (x[a] < lower_[a] || x[a] >= upper_[a]) return false;
  const bool first = is_odd(0, x), second = is_odd(1, x);
  return first == second ? first : is_odd(2, x);
}

bool MeshVolume::is_odd(std::size_t axis, const Double3& x) const {
  const Across& across = across_[axis];
  const auto [b, c] = others(axis);
  const std::size_t s = square(axis, 1, x[c]) * across.count[0] + square(axis, 0, x[b]);
  bool odd = false;
  for (std::size_t k = across.first[s]; k < across.first[s + 1]; ++k)
    odd ^= is_before(axis, corners_[across.triangles[k]], x);
  return odd;
}

/// Whether the ray from x meets the triangle.
bool MeshVolume::is_before(std::size_t axis, const Corners& triangle, const Double3& x) const {
  const std::array<double, 2> at = seen_along(axis, x);
  bool meets = false;
  for (std::size_t k = 0; k < 3; ++k) {
    meets ^= passes_beyond(seen_along(axis, vertices_[triangle[k]]),
                           seen_along(axis, vertices_[triangle[(k + 1) % 3]]), at);
  }
  if (!meets) return false;
  const Double3 &p = vertices_[triangle[0]], &q = vertices_[triangle[1]], &r = vertices_[triangle[2]];
  const auto [b, c] = others(axis);
  const double qb = q[b] - p[b], qc = q[c] - p[c], rb = r[b] - p[b], rc = r[c] - p[c];
  const double xb = x[b] - p[b], xc = x[c] - p[c], area = qb * rc - qc * rb;
  const double along_q = (xb * rc - xc * rb) / area, along_r = (qb * xc - qc * xb) / area;
  // Of a triangle that is seen edge-on it may be anything: no number is the lowest corner.
  const auto [lowest, highest] = std::minmax({p[axis], q[axis], r[axis]});
  const double there = p[axis] + along_q * (q[axis] - p[axis]) + along_r * (r[axis] - p[axis]);
  return x[axis] < (there > lowest ? std::min(there, highest) : lowest);
}

}  // namespace sph
