#include "stokes/conduction.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace stokes {
namespace {

constexpr double tolerance = 1e-12;

/// work(index) for the rank's cells at a wall.
template <class Work>
void for_cells_at(const Patch& p, int axis, int side, Work work) {
  if (!p.at_wall(axis, side)) return;
  const auto a = static_cast<std::size_t>(axis);
  Box cells = p.own;
  (side == 0 ? cells.hi[a] : cells.lo[a]) = side == 0 ? cells.lo[a] + 1 : cells.hi[a] - 1;
  for (std::int64_t z = cells.lo[2]; z < cells.hi[2]; ++z)
    for (std::int64_t y = cells.lo[1]; y < cells.hi[1]; ++y)
      for (std::int64_t x = cells.lo[0]; x < cells.hi[0]; ++x) work(p.at(x, y, z));
}

/// sum_a weight_a (t_+ - 2 t + t_-), as differences of fluxes.
template <int D>
double diffusion(const double* t, const std::array<std::ptrdiff_t, 3>& stride,
                 const std::array<double, 3>& weight) {
  double sum = weight[0] * ((t[stride[0]] - t[0]) - (t[0] - t[-stride[0]]));
  for (std::size_t a = 1; a < D; ++a) sum += weight[a] * ((t[stride[a]] - t[0]) - (t[0] - t[-stride[a]]));
  return sum;
}

template <int D>
void diffuse(const Patch& p, const std::array<double, 3>& weight, const Field& t, Field& out) {
  for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t, std::int64_t) {
    const double* from = t.data() + first;
    double* to = out.data() + first;
    for (std::ptrdiff_t i = 0; i < n; ++i) to[i] = diffusion<D>(from + i, p.stride, weight);
  });
}

/// step = keep step + take (right - A x), y = x + step.
template <int D>
void improve(const Patch& p, const std::array<double, 3>& weight, const std::array<double, 2>& keep_take,
             const Field& right, const Field& x, Field& step, Field& y) {
  for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t, std::int64_t) {
    const std::array w = weight;  // a copy that no store can alias
    const auto [keep, take] = keep_take;
    const double *b = right.data() + first, *from = x.data() + first;
    double *s = step.data() + first, *to = y.data() + first;
    // Two loops: of one, too many arrays might overlap for gcc to find lanes.
    for (std::ptrdiff_t i = 0; i < n; ++i)
      s[i] = keep * s[i] + take * (b[i] - (from[i] - diffusion<D>(from + i, p.stride, w)));
    for (std::ptrdiff_t i = 0; i < n; ++i) to[i] = from[i] + s[i];
  });
}

}  // namespace

Conduction::Conduction(const decomp::Comm& comm, const Grid& grid, const std::vector<Box>& boxes,
                       double diffusivity, const ThermalWalls& walls)
    : comm_(&comm),
      patch_(grid, boxes[static_cast<std::size_t>(comm.rank())]),
      halo_(comm, grid.cells, grid.periodic_axes(), boxes, frames_of(grid, boxes)),
      diffusivity_(diffusivity),
      walls_(walls),
      right_(patch_.size, 0.0),
      change_(right_),
      next_(right_),
      step_(right_) {
  if (!(diffusivity > 0)) throw std::logic_error("a diffusivity is above 0");
}

void Conduction::refresh(Field& t, bool change) {
  const std::array values{decomp::cell_values(std::span(t), patch_.frame)};
  halo_.copy(values, values);
  extend(patch_, t, change ? 0.0 : 1.0);
}

void Conduction::extend(const Patch& patch, Field& t, double share) const {
  for (int axis = 0; axis < patch.grid.dim; ++axis) {
    if (patch.grid.periodic(axis)) continue;
    const auto a = static_cast<std::size_t>(axis);
    for (int side = 0; side < 2; ++side) {
      const ThermalWall& wall = walls_[a][static_cast<std::size_t>(side)];
      const double value = share * wall.value;
      if (wall.kind == ThermalWall::Kind::temperature)
        set_behind(patch, axis, side, -1, 2 * value, t);
      else
        set_behind(patch, axis, side, 1,
                   wall.kind == ThermalWall::Kind::flux ? value * patch.grid.edge[a] / diffusivity_ : 0.0, t);
    }
  }
}

int Conduction::advance(double dt, Field& temperature, double theta, const Field* volume) {
  const Patch& p = patch_;
  std::array<double, 3> whole{}, weight{};
  double largest = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(p.grid.dim); ++a) {
    whole[a] = dt * diffusivity_ / (p.grid.edge[a] * p.grid.edge[a]);
    weight[a] = theta * whole[a];
    largest += 4 * weight[a];
  }
  refresh(temperature, false);
  if (p.grid.dim == 2)
    diffuse<2>(p, whole, temperature, right_);
  else
    diffuse<3>(p, whole, temperature, right_);

  const double middle = 0.5 * (1 + largest), half = 0.5 * (largest - 1);
  // The error is divided by Chebyshev's polynomial of its degree, of middle / half: 1 / rho is its ratio to the last.
  double rho = half / middle, left = rho;
  for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(p.size); ++k)
    change_[k] = step_[k] = right_[k] / middle;
  int iterations = 1;
  for (; left > tolerance; ++iterations) {
    const double rho_next = 1 / (2 * middle / half - rho);
    const std::array keep_take{rho_next * rho, 2 * rho_next / half};
    refresh(change_, true);
    if (p.grid.dim == 2)
      improve<2>(p, weight, keep_take, right_, change_, step_, next_);
    else
      improve<3>(p, weight, keep_take, right_, change_, step_, next_);
    std::swap(change_, next_);
    rho = rho_next;
    left *= rho;
  }
  for_own(p, [&](std::ptrdiff_t k) {
    temperature[k] += volume == nullptr ? change_[k] : change_[k] / (*volume)[k];
  });
  return iterations;
}

decomp::ExactSum Conduction::inflow(const Field& t, int axis, int side) const {
  const auto a = static_cast<std::size_t>(axis);
  const ThermalWall& wall = walls_[a][static_cast<std::size_t>(side)];
  const double per_kelvin = 2 * diffusivity_ / patch_.grid.edge[a];
  decomp::ExactSum sum;
  for_cells_at(patch_, axis, side, [&](std::ptrdiff_t k) {
    if (wall.kind == ThermalWall::Kind::temperature) sum.add(per_kelvin * (wall.value - t[k]));
    if (wall.kind == ThermalWall::Kind::flux) sum.add(wall.value);
  });
  return sum;
}

double Conduction::mean_inflow(const Field& t, int axis, int side) const {
  std::array sums{inflow(t, axis, side)};
  decomp::ExactSum::all_reduce(*comm_, sums);
  std::int64_t faces = 1;
  for (std::size_t a = 0; a < static_cast<std::size_t>(patch_.grid.dim); ++a)
    if (static_cast<int>(a) != axis) faces *= patch_.grid.cells[a];
  return sums[0].value() / static_cast<double>(faces);
}

}  // namespace stokes
