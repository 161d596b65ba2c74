#include "stokes/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "stokes/partition.hpp"
#include "transfers.hpp"

namespace stokes {
namespace {

constexpr std::int64_t most_coarsest = 7;  // cells along any axis of the coarsest grid, at most

std::int64_t count(const Grid& g) { return g.cells[0] * g.cells[1] * g.cells[2]; }

std::string cells_text(const Grid& g) {
  std::string text = std::to_string(g.cells[0]);
  for (std::size_t a = 1; a < static_cast<std::size_t>(g.dim); ++a)
    text += " x " + std::to_string(g.cells[a]);
  return text;
}

}  // namespace

int smoothing_degree(std::size_t level) { return level == 0 ? 4 : 8; }

void check_cells(const Grid& grid) {
  const Grid last = coarsest_grid(grid);
  const auto [least, most] = std::minmax_element(last.cells.begin(), last.cells.begin() + grid.dim);
  if (*most <= most_coarsest && *least >= least_coarsest && last.cells != grid.cells) return;
  throw decomp::InputError("makes a grid of " + cells_text(grid) + " cells, which can be halved to " +
                           cells_text(last) +
                           " only; take m 2^k cells along each axis with the same k of 1 or more, m from " +
                           std::to_string(least_coarsest) + " to " + std::to_string(most_coarsest));
}

Multigrid::Multigrid(const decomp::Comm& comm, const Grid& grid, std::vector<Box> boxes)
    : alone_(MPI_COMM_SELF) {
  check_cells(grid);
  std::vector<CoarseGrid> grids = coarse_grids(grid, boxes);
  levels_.push_back(std::make_unique<Level>(comm, grid, std::move(boxes)));
  for (CoarseGrid& g : grids) {
    const decomp::Comm &fine = levels_.back()->comm(), &whose = g.everywhere ? alone_ : fine;
    const auto me = static_cast<std::size_t>(fine.rank());
    const Grid& coarse = g.grid;
    // Each rank gets what it needs of the coarser grid around its own cells.
    std::vector<Box> around = frames_of(coarse, g.halves);
    if (g.everywhere) around = {around[me]};
    Patch half(coarse, g.halves[me]);
    decomp::BoxExchange down(fine, coarse.cells, coarse.periodic_axes(), g.halves, g.boxes);
    if (g.everywhere) g.boxes = {coarse.box()};
    decomp::BoxExchange up(whose, coarse.cells, coarse.periodic_axes(), g.boxes, around);
    levels_.push_back(std::make_unique<Level>(whose, coarse, std::move(g.boxes)));
    transfers_.push_back(
        std::make_unique<Transfer>(Transfer{std::move(half), std::move(down), std::move(up), {}, {}, {}}));
    Transfer& t = *transfers_.back();
    for (std::size_t a = 0; a < static_cast<std::size_t>(coarse.dim); ++a)
      t.halves[a].assign(t.half.size, 0.0);
    t.force = t.velocity = levels_.back()->make_velocity();
  }
}

void Multigrid::restrict_to(std::size_t coarse, std::vector<Field*> halves, std::vector<Field*> values) {
  Transfer& t = *transfers_[coarse - 1];
  std::vector<decomp::CellValues> from, to;
  for (Field* f : halves) from.push_back(decomp::cell_values(std::span(*f), t.half.frame));
  for (Field* f : values) to.push_back(decomp::cell_values(std::span(*f), levels_[coarse]->patch().frame));
  t.down.copy(from, to);
}

void Multigrid::set_viscosity(Field cells, Resistance resistance) {
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    Level& level = *levels_[k];
    level.refresh_cells(cells);
    for (std::size_t a = 0; a < 3; ++a)
      if (resistance.along[a]) level.refresh_cells(resistance.faces[a]);
    Field coarse;
    Resistance coarse_resistance{resistance.along, {}};
    if (k + 1 < levels_.size()) {
      const Patch& half = transfers_[k]->half;
      const std::size_t size = levels_[k + 1]->patch().size;
      Field means(half.size);
      mean_of_cells(level.patch(), cells, half, means);
      coarse.assign(size, 1.0);
      restrict_to(k + 1, {&means}, {&coarse});
      for (int a = 0; a < level.grid().dim; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        if (!resistance.along[axis]) continue;
        restrict_faces(level.patch(), a, resistance.faces[axis], half, means);
        coarse_resistance.faces[axis].assign(size, 0.0);
        restrict_to(k + 1, {&means}, {&coarse_resistance.faces[axis]});
      }
    }
    level.set_viscosity(std::move(cells), k == 0 ? EdgeMean::harmonic : EdgeMean::arithmetic,
                        std::move(resistance));
    cells = std::move(coarse);
    resistance = std::move(coarse_resistance);
  }
  factorise();
}

void Multigrid::cycle(const Velocity& f, Velocity& u) { cycle(0, f, u); }

void Multigrid::cycle(std::size_t k, const Velocity& f, Velocity& u) {
  Level& level = *levels_[k];
  if (k + 1 == levels_.size()) return solve_coarsest(f, u);
  level.smooth(f, u, smoothing_degree(k), true);
  Transfer& t = *transfers_[k];
  const Velocity& r = level.residual(f, u);
  std::vector<Field*> from, to;
  for (int a = 0; a < level.grid().dim; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    restrict_faces(level.patch(), a, r[axis], t.half, t.halves[axis]);
    from.push_back(&t.halves[axis]);
    to.push_back(&t.force[axis]);
  }
  restrict_to(k + 1, from, to);
  cycle(k + 1, t.force, t.velocity);
  std::vector<decomp::CellValues> owned, around;
  for (std::size_t a = 0; a < from.size(); ++a) {
    owned.push_back(decomp::cell_values(std::span(t.velocity[a]), levels_[k + 1]->patch().frame));
    around.push_back(decomp::cell_values(std::span(t.halves[a]), t.half.frame));
  }
  t.up.copy(owned, around);
  mirror_velocity(t.half, t.halves);
  for (int a = 0; a < level.grid().dim; ++a)
    add_prolonged(t.half, a, t.halves[static_cast<std::size_t>(a)], level.patch(),
                  u[static_cast<std::size_t>(a)]);
  level.smooth(f, u, smoothing_degree(k), false);
}

// Column by column, A of a unit vector. Where a constant velocity meets no resistance, its square is added: what a
// force without a mean asks for then has none either.
void Multigrid::factorise() {
  Level& level = *levels_.back();
  const Patch& p = level.patch();
  const auto dim = static_cast<std::size_t>(p.grid.dim);
  const auto cells = static_cast<std::size_t>(count(p.grid)), n = dim * cells;
  const auto row = [&](std::size_t r) {
    const auto c = static_cast<std::int64_t>(r / dim);
    return p.at(c % p.grid.cells[0], c / p.grid.cells[0] % p.grid.cells[1],
                c / (p.grid.cells[0] * p.grid.cells[1]));
  };
  factor_.assign(n * n, 0.0);
  Velocity u = level.make_velocity(), y = level.make_velocity();
  for (std::size_t c = 0; c < n; ++c) {
    u[c % dim][row(c)] = 1;
    level.refresh(u);
    const bool wall = u[c % dim][row(c)] == 0;
    apply(p, level.viscosity(), u, y);
    for (std::size_t r = 0; r < n; ++r) factor_[r * n + c] = y[r % dim][row(r)];
    if (wall) factor_[c * n + c] = 1;
    for (Field& f : u) std::ranges::fill(f, 0.0);
  }
  for (std::size_t a = 0; a < dim; ++a)
    if (p.grid.slides(static_cast<int>(a))) {
      const double share = factor_[a * n + a] / static_cast<double>(cells);
      for (std::size_t r = a; r < n; r += dim)
        for (std::size_t c = a; c < n; c += dim) factor_[r * n + c] += share;
    }
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = 0; c <= r; ++c) {
      double s = factor_[r * n + c];
      for (std::size_t k = 0; k < c; ++k) s -= factor_[r * n + k] * factor_[c * n + k];
      if (r == c && !(s > 0)) throw decomp::GuardError("the coarsest viscous operator is not positive");
      factor_[r * n + c] = r == c ? std::sqrt(s) : s / factor_[c * n + c];
    }
}

void Multigrid::solve_coarsest(const Velocity& f, Velocity& u) const {
  const Patch& p = levels_.back()->patch();
  const auto dim = static_cast<std::size_t>(p.grid.dim);
  const std::size_t n = dim * static_cast<std::size_t>(count(p.grid));
  std::vector<double> x(n);
  std::size_t r = 0;
  for_own(p, [&](std::ptrdiff_t k) {
    for (std::size_t a = 0; a < dim; ++a) x[r++] = f[a][k];
  });
  for (r = 0; r < n; ++r) {
    for (std::size_t k = 0; k < r; ++k) x[r] -= factor_[r * n + k] * x[k];
    x[r] /= factor_[r * n + r];
  }
  for (r = n; r-- > 0;) {
    for (std::size_t k = r + 1; k < n; ++k) x[r] -= factor_[k * n + r] * x[k];
    x[r] /= factor_[r * n + r];
  }
  r = 0;
  for_own(p, [&](std::ptrdiff_t k) {
    for (std::size_t a = 0; a < dim; ++a) u[a][k] = x[r++];
  });
}

}  // namespace stokes
