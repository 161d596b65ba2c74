#include "stokes/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "stokes/partition.hpp"
#include "transfers.hpp"

namespace stokes {
namespace {

constexpr std::int64_t coarsest = 4;         // cells along the shortest axis, at least
constexpr std::int64_t most_coarsest = 7;    // ... along any, at most
constexpr std::int64_t on_all_ranks = 4096;  // as few cells every rank has

/// Of the polynomial that smooths level k. Coarse viscosities are means, of which a coarse grid corrects worse than the
/// finest one: with one degree for all, iterations grow with depth where viscosity jumps. Work per cycle that grows
/// towards coarse levels stops that (variable V-cycle, Bramble & Pasciak 1987) and costs little, as these have few cells.
int degree_of(std::size_t k) { return k == 0 ? 4 : 8; }

std::int64_t count(const Grid& g) { return g.cells[0] * g.cells[1] * g.cells[2]; }

bool can_be_halved(const Grid& g) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(g.dim); ++a)
    if (g.cells[a] % 2 != 0 || g.cells[a] / 2 < coarsest) return false;
  return true;
}

bool are_even(const std::vector<Box>& boxes, int dim) {
  return std::ranges::all_of(boxes, [&](const Box& b) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
      if (b.lo[a] % 2 != 0 || b.hi[a] % 2 != 0) return false;
    return true;
  });
}

std::vector<Box> halves_of(std::vector<Box> boxes, int dim) {
  for (Box& b : boxes)
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a) b.lo[a] /= 2, b.hi[a] /= 2;
  return boxes;
}

std::string cells_text(const Grid& g) {
  std::string text = std::to_string(g.cells[0]);
  for (std::size_t a = 1; a < static_cast<std::size_t>(g.dim); ++a)
    text += " x " + std::to_string(g.cells[a]);
  return text;
}

}  // namespace

void check_cells(const Grid& grid) {
  Grid last = grid;
  while (can_be_halved(last)) last = last.halved();
  const auto [least, most] = std::minmax_element(last.cells.begin(), last.cells.begin() + grid.dim);
  if (*most <= most_coarsest && *least >= coarsest && last.cells != grid.cells) return;
  throw decomp::InputError("makes a grid of " + cells_text(grid) + " cells, which can be halved to " +
                           cells_text(last) +
                           " only; take m 2^k cells along each axis with the same k of 1 or more, m from " +
                           std::to_string(coarsest) + " to " + std::to_string(most_coarsest));
}

Multigrid::Multigrid(const decomp::Comm& comm, const Grid& grid, std::vector<Box> boxes)
    : alone_(MPI_COMM_SELF) {
  check_cells(grid);
  levels_.push_back(std::make_unique<Level>(comm, grid, std::move(boxes)));
  while (can_be_halved(levels_.back()->grid())) {
    const Level& fine = *levels_.back();
    const Grid coarse = fine.grid().halved();
    const bool everywhere = count(coarse) <= on_all_ranks;
    const std::vector<Box> halves = halves_of(fine.boxes(), coarse.dim);
    std::vector<Box> next{coarse.box()};
    if (!everywhere)
      next = are_even(halves, coarse.dim) ? halves
                                          : even_boxes(coarse, fine.comm().size() / (1 << coarse.dim) + 1);
    if (!everywhere) next.resize(static_cast<std::size_t>(fine.comm().size()));
    const decomp::Comm& whose = everywhere ? alone_ : fine.comm();
    // Each rank gets what it needs of the coarser grid around its own cells.
    const auto me = static_cast<std::size_t>(fine.comm().rank());
    std::vector<Box> wanted_down = next, wanted_up = frames_of(coarse, halves);
    if (everywhere) wanted_down.assign(static_cast<std::size_t>(fine.comm().size()), coarse.box());
    if (everywhere) wanted_up = {wanted_up[me]};
    transfers_.push_back(std::make_unique<Transfer>(
        Transfer{Patch(coarse, halves[me]),
                 decomp::BoxExchange(fine.comm(), coarse.cells, coarse.periodic_axes(), halves, wanted_down),
                 decomp::BoxExchange(whose, coarse.cells, coarse.periodic_axes(), next, wanted_up),
                 {},
                 {},
                 {}}));
    levels_.push_back(std::make_unique<Level>(whose, coarse, next));
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
  level.smooth(f, u, degree_of(k), true);
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
  level.smooth(f, u, degree_of(k), false);
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
