// Triangles that share vertices, as a sphere meets them: the nearest point of each, by faces, edges and vertices (Ericson 2005,
// 5.1.5). Edges are looked at from their lower vertex, so that two triangles find the same point of the one that they share, to
// the bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
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

/// All that it holds is one block of bytes, which ranks can share (decomp/machine_copy.hpp).
class TriangleSurface {
 public:
  using Triangle = std::array<std::uint32_t, 3>;
  TriangleSurface(std::span<const Point3> vertices, std::span<const Triangle> triangles);
  /// Of the block of another.
  explicit TriangleSurface(std::shared_ptr<const std::byte> block);

  [[nodiscard]] std::size_t size() const { return triangles_.size(); }
  [[nodiscard]] std::span<const Point3> vertices() const { return vertices_; }
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  [[nodiscard]] Point3 normal(std::size_t triangle) const;       ///< unit vector
  [[nodiscard]] double radius() const { return head_->radius; }  ///< furthest vertex from the origin
  [[nodiscard]] NearPoint nearest(std::size_t triangle, const Point3& x) const;
  /// This triangle has the vertices of the feature.
  [[nodiscard]] bool has(std::size_t triangle, const Feature& feature) const;
  [[nodiscard]] bool share_vertex(std::size_t one, std::size_t other) const;
  /// Triangles closer to x than `reach`, ascending.
  void find(const Point3& x, double reach, std::vector<std::uint32_t>& out) const;
  [[nodiscard]] const std::shared_ptr<const std::byte>& block() const { return block_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// What the block begins with; then vertices, triangles, and of each cell of a grid over the surface which triangles have boxes
  /// that meet it.
  struct Head {
    std::uint64_t vertices, triangles, cells, in_cells;  ///< numbers
    double radius;
    Point3 lower;
    double edge;
    std::array<std::int64_t, 3> count;  ///< cells along each axis
  };
  struct Cells {
    std::array<std::int64_t, 3> first, last;
  };
  static std::array<Point3, 2> box_of(std::span<const Point3> vertices, const Triangle& triangle);
  static void choose_cells(Head& head, std::span<const Point3> vertices, std::span<const Triangle> triangles);
  static Cells cells(const Head& head, const Point3& lower, const Point3& upper);
  static Cells cells_of(const Head& head, std::span<const Point3> vertices, const Triangle& triangle);
  template <class Visit>
  static void for_cells(const Head& head, const Cells& box, Visit&& visit);
  void look_into(std::shared_ptr<const std::byte> block);

  std::shared_ptr<const std::byte> block_;
  const Head* head_ = nullptr;
  std::span<const Point3> vertices_;
  std::span<const Triangle> triangles_;
  std::span<const std::uint32_t> offset_;  ///< [cells + 1] into in_cells_
  std::span<const std::uint32_t> in_cells_;
};

}  // namespace sph
