#include "conjugate_gradients.hpp"

#include <algorithm>
#include <array>

#include "decomp/exact_sum.hpp"

namespace stokes {
namespace {

double dot(const decomp::Comm& comm, const Patch& p, const Velocity& x, const Velocity& y) {
  std::array<decomp::ExactSum, 1> sum;
  for_own(p, [&](std::ptrdiff_t k) {
    double cell = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(p.grid.dim); ++a) cell += x[a][k] * y[a][k];
    sum[0].add(cell);
  });
  decomp::ExactSum::all_reduce(comm, sum);
  return sum[0].value();
}

/// y = keep y + take x
void combine(const Patch& p, double keep, double take, const Velocity& x, Velocity& y) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(p.grid.dim); ++a)
    for_own(p, [&](std::ptrdiff_t k) { y[a][k] = keep * y[a][k] + take * x[a][k]; });
}

}  // namespace

int conjugate_gradients(const decomp::Comm& comm, Multigrid& multigrid, const Velocity& f, double share,
                        int most, Velocity& u) {
  Level& level = multigrid.finest();
  const Patch& p = level.patch();
  Velocity r = f, z = level.make_velocity(), direction = z, image = z;
  for (Field& c : u) std::ranges::fill(c, 0.0);
  multigrid.cycle(r, z);
  int cycles = 1;
  double left = dot(comm, p, r, z), keep = 0;
  const double enough = share * share * left;
  while (left > enough && cycles < most) {
    combine(p, keep, 1, z, direction);
    level.refresh(direction);
    apply(p, level.viscosity(), direction, image);
    const double step = left / dot(comm, p, direction, image);
    combine(p, 1, step, direction, u);
    combine(p, 1, -step, image, r);
    multigrid.cycle(r, z);
    ++cycles;
    const double next = dot(comm, p, r, z);
    keep = next / left;
    left = next;
  }
  return cycles;
}

}  // namespace stokes
