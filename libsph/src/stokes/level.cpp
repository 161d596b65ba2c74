#include "stokes/level.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "decomp/splitmix.hpp"

namespace stokes {
namespace {

constexpr int power_steps = 12;  // towards the largest eigenvalue
constexpr double margin = 1.1;   // above what they find

/// In [-1/2, 1/2), of a cell's number: the same wherever it is.
double hashed(std::uint64_t x) { return decomp::splitmix_unit(decomp::splitmix_mix(x)) - 0.5; }

}  // namespace

Level::Level(const decomp::Comm& comm, const Grid& grid, std::vector<Box> boxes)
    : comm_(&comm),
      boxes_(std::move(boxes)),
      patch_(grid, boxes_[static_cast<std::size_t>(comm.rank())]),
      halo_(comm, grid.cells, grid.periodic_axes(), boxes_, frames_of(grid, boxes_)),
      viscosity_(patch_),
      r_(make_velocity()),
      step_(make_velocity()) {}

Velocity Level::make_velocity() const {
  Velocity u;
  for (std::size_t a = 0; a < static_cast<std::size_t>(patch_.grid.dim); ++a) u[a].assign(patch_.size, 0.0);
  return u;
}

void Level::refresh(Velocity& u) {
  std::vector<decomp::CellValues> values;
  for (std::size_t a = 0; a < static_cast<std::size_t>(patch_.grid.dim); ++a)
    values.push_back(decomp::cell_values(std::span(u[a]), patch_.frame));
  halo_.copy(values, values);
  mirror_velocity(patch_, u);
}

void Level::refresh_cells(Field& c) {
  const std::array values{decomp::cell_values(std::span(c), patch_.frame)};
  halo_.copy(values, values);
  mirror_cells(patch_, c);
}

void Level::set_viscosity(Field cells, EdgeMean mean, Resistance resistance) {
  viscosity_.cells = std::move(cells);
  viscosity_.resistance = std::move(resistance);
  set_edges(patch_, mean, viscosity_);
  inverse_diagonal_ = inverse_diagonal(patch_, viscosity_);
  largest_ = margin * largest_eigenvalue();
}

// The power iteration in the maximum norm, which is exact on any number of ranks, from what hashes the faces.
double Level::largest_eigenvalue() {
  const Int3& n = patch_.grid.cells;
  const int dim = patch_.grid.dim;
  Velocity u = make_velocity();
  for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
    for_lines(patch_, [&](std::ptrdiff_t first, std::int64_t count, std::int64_t y, std::int64_t z) {
      for (std::int64_t i = 0; i < count; ++i) {
        const auto number = static_cast<std::uint64_t>((z * n[1] + y) * n[0] + patch_.own.lo[0] + i);
        u[a][first + i] = inverse_diagonal_[a][first + i] != 0
                              ? hashed(static_cast<std::uint64_t>(dim) * number + a + 1)
                              : 0.0;
      }
    });
  double largest = 1;
  for (int step = 0; step < power_steps; ++step) {
    refresh(u);
    apply(patch_, viscosity_, u, r_);
    double most = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
      for_own(patch_, [&](std::ptrdiff_t k) {
        u[a][k] = inverse_diagonal_[a][k] * r_[a][k];
        most = std::max(most, std::fabs(u[a][k]));
      });
    std::array<double, 1> all{most};
    comm_->max(all);
    largest = all[0];
    const double scale = 1 / largest;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
      for (double& v : u[a]) v *= scale;
  }
  return largest;
}

void Level::find_residual(const Velocity& f, Velocity& u) {
  refresh(u);
  apply(patch_, viscosity_, u, r_);
  for (std::size_t a = 0; a < static_cast<std::size_t>(patch_.grid.dim); ++a)
    for_own(patch_,
            [&](std::ptrdiff_t k) { r_[a][k] = inverse_diagonal_[a][k] != 0 ? f[a][k] - r_[a][k] : 0.0; });
}

const Velocity& Level::residual(const Velocity& f, Velocity& u) {
  find_residual(f, u);
  refresh(r_);
  return r_;
}

// Chebyshev's polynomial of degree n divides all within [largest / s, largest] by T_n((s + 1) / (s - 1)): with s = 3/4 n^2
// by 5, whatever n.
void Level::smooth(const Velocity& f, Velocity& u, int degree, bool from_zero) {
  const double span = 0.75 * (degree * degree), least = largest_ / span, middle = 0.5 * (least + largest_),
               half = 0.5 * (largest_ - least);
  const double sigma = middle / half;
  double rho = 1 / sigma;
  for (int step = 0; step < degree; ++step) {
    const bool zero = from_zero && step == 0;
    if (!zero) find_residual(f, u);
    const double next = 1 / (2 * sigma - rho);
    const double keep = step == 0 ? 0 : next * rho, take = step == 0 ? 1 / middle : 2 * next / half;
    if (step > 0) rho = next;
    for (std::size_t a = 0; a < static_cast<std::size_t>(patch_.grid.dim); ++a) {
      const Field& r = zero ? f[a] : r_[a];
      for_own(patch_, [&](std::ptrdiff_t k) {
        step_[a][k] = keep * step_[a][k] + take * (inverse_diagonal_[a][k] * r[k]);
        u[a][k] = (zero ? 0.0 : u[a][k]) + step_[a][k];
      });
    }
  }
}

}  // namespace stokes
