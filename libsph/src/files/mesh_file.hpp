// Triangles of an STL or OBJ file (by assimp). Vertices at the same place are one.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sph {

struct Triangles {
  std::vector<std::array<double, 3>> vertices;  ///< [units of the file]
  std::vector<std::array<std::uint32_t, 3>> corners;
};

/// Throws InputError, after `what`, naming the facet (from 1, as the file has them) and what is wrong with it.
[[nodiscard]] Triangles read_triangles(const std::string& path, const std::string& what);

/// Of the bytes of a file, 16 digits; empty if it cannot be read.
[[nodiscard]] std::string hash_of_file(const std::string& path);

}  // namespace sph
