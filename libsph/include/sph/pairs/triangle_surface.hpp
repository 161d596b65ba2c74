// Triangles that share vertices, as a sphere meets them: the nearest point of each, by faces, edges and vertices (Ericson 2005,
// 5.1.5). Edges are looked at from their lower vertex, so that two triangles find the same point of the one that they share, to
// the bit.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sph {

using Point3 = std::array<double, 3>;

/// What of a triangle is nearest: its face, or the edge or vertex with these vertices, a <= b.
struct Feature {
  static constexpr std::uint32_t face = ~std::uint32_t{0};
  std::uint32_t a = face, b = face;
  [[nodiscard]] bool is_face() const { return a == face; }
  friend bool operator==(const Feature&, const Feature&) = default;
};

struct NearPoint {
  Point3 point;
  double square;  ///< of the distance
  Feature of;
};

class TriangleSurface {
 public:
  using Triangle = std::array<std::uint32_t, 3>;
  TriangleSurface(std::vector<Point3> vertices, std::vector<Triangle> triangles);

  [[nodiscard]] std::size_t size() const { return triangles_.size(); }
  [[nodiscard]] const std::vector<Point3>& vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] const Point3& normal(std::size_t t) const { return normals_[t]; }
  [[nodiscard]] double radius() const { return radius_; }  ///< furthest vertex from the origin
  [[nodiscard]] NearPoint nearest(std::size_t triangle, const Point3& x) const;
  /// This triangle has the vertices of the feature.
  [[nodiscard]] bool has(std::size_t triangle, const Feature& feature) const;
  [[nodiscard]] bool share_vertex(std::size_t one, std::size_t other) const;
  /// Triangles closer to x than `reach`, ascending.
  void find(const Point3& x, double reach, std::vector<std::uint32_t>& out) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Cells {
    std::array<std::int64_t, 3> first, last;
  };
  void make_grid();
  [[nodiscard]] Cells cells(const Point3& lower, const Point3& upper) const;
  template <class Visit>
  void for_cells(const Cells& box, Visit&& visit) const;

  std::vector<Point3> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Point3> normals_;  ///< unit vectors
  double radius_ = 0;
  // Cells of a grid over the surface and the triangles whose boxes meet them.
  Point3 lower_{};
  double edge_ = 1;
  std::array<std::int64_t, 3> count_{1, 1, 1};
  std::vector<std::uint64_t> offset_;
  std::vector<std::uint32_t> in_cells_;
};

}  // namespace sph
