#include "transfers.hpp"

#include <algorithm>

namespace stokes {
namespace {

/// Offsets in a frame and their weights.
struct Stencil {
  std::vector<std::pair<std::ptrdiff_t, double>> points{{0, 1.0}};
  void times(std::initializer_list<std::pair<std::ptrdiff_t, double>> line) {
    std::vector<std::pair<std::ptrdiff_t, double>> product;
    for (const auto& [at, weight] : points)
      for (const auto& [step, share] : line) product.emplace_back(at + step, weight * share);
    points = std::move(product);
  }
};

template <class Work>
void for_cells(const Patch& p, Work work) {
  for (std::int64_t z = p.own.lo[2]; z < p.own.hi[2]; ++z)
    for (std::int64_t y = p.own.lo[1]; y < p.own.hi[1]; ++y)
      for (std::int64_t x = p.own.lo[0]; x < p.own.hi[0]; ++x) work(Int3{x, y, z});
}

Int3 twice(const Grid& fine, Int3 x) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(fine.dim); ++a) x[a] *= 2;
  return x;
}

bool is_wall(const Grid& g, int axis, const Int3& x) {
  return !g.periodic(axis) && x[static_cast<std::size_t>(axis)] == 0;
}

}  // namespace

void mean_of_cells(const Patch& fine, const Field& cells, const Patch& coarse, Field& means) {
  Stencil s;
  for (std::size_t a = 0; a < static_cast<std::size_t>(fine.grid.dim); ++a)
    s.times({{0, 0.5}, {fine.stride[a], 0.5}});
  for_cells(coarse, [&](const Int3& x) {
    const std::ptrdiff_t k = fine.at(twice(fine.grid, x));
    double sum = 0;
    for (const auto& [at, weight] : s.points) sum += weight * cells[k + at];
    means[coarse.at(x)] = sum;
  });
}

void restrict_faces(const Patch& fine, int axis, const Field& r, const Patch& coarse, Field& out) {
  Stencil s;
  for (int b = 0; b < fine.grid.dim; ++b) {
    const std::ptrdiff_t step = fine.stride[static_cast<std::size_t>(b)];
    if (b == axis)
      s.times({{-step, 0.25}, {0, 0.5}, {step, 0.25}});
    else
      s.times({{-step, 0.125}, {0, 0.375}, {step, 0.375}, {2 * step, 0.125}});
  }
  for_cells(coarse, [&](const Int3& x) {
    const std::ptrdiff_t k = fine.at(twice(fine.grid, x));
    double sum = 0;
    for (const auto& [at, weight] : s.points) sum += weight * r[k + at];
    out[coarse.at(x)] = is_wall(coarse.grid, axis, x) ? 0.0 : sum;
  });
}

void add_prolonged(const Patch& coarse_patch, int axis, const Field& coarse, const Patch& fine, Field& u) {
  const auto dim = static_cast<std::size_t>(fine.grid.dim);
  // Of each of the 2^dim places that a fine face may have in its coarse cell.
  std::vector<Stencil> stencils(std::size_t{1} << dim);
  for (std::size_t place = 0; place < stencils.size(); ++place)
    for (std::size_t b = 0; b < dim; ++b) {
      const bool odd = (place >> b & 1) != 0;
      const std::ptrdiff_t step = coarse_patch.stride[b];
      if (static_cast<int>(b) != axis)
        stencils[place].times({{0, 0.75}, {odd ? step : -step, 0.25}});
      else if (odd)
        stencils[place].times({{0, 0.5}, {step, 0.5}});
    }
  for_cells(fine, [&](const Int3& x) {
    if (is_wall(fine.grid, axis, x)) return;
    Int3 half = x;
    std::size_t place = 0;
    for (std::size_t b = 0; b < dim; ++b) {
      place |= static_cast<std::size_t>(x[b] & 1) << b;
      half[b] = x[b] >> 1;
    }
    const std::ptrdiff_t k = coarse_patch.at(half);
    double sum = 0;
    for (const auto& [at, weight] : stencils[place].points) sum += weight * coarse[k + at];
    u[fine.at(x)] += sum;
  });
}

}  // namespace stokes
