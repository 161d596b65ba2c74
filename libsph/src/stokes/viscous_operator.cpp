#include "stokes/viscous_operator.hpp"

namespace stokes {
namespace {

/// 0 on faces that are walls.
template <int A>
void clear_walls(const Patch& p, Field& y) {
  if (!p.at_wall(A, 0)) return;
  for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t yy, std::int64_t z) {
    if (A == 0) y[first] = 0;
    if ((A == 1 && yy == 0) || (A == 2 && z == 0))
      for (std::ptrdiff_t k = first; k < first + n; ++k) y[k] = 0;
  });
}

template <int D, int A>
void apply_component(const Patch& p, const Viscosity& viscosity, const Velocity& u, Field& out) {
  const double* cells = viscosity.cells.data();
  const double* ua = u[A].data();
  const std::ptrdiff_t sa = p.stride[A];
  const double per_edge = 1 / p.grid.edge[A], normal = 2 * per_edge * per_edge;
  for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t, std::int64_t) {
    double* y = out.data();
    for (std::ptrdiff_t k = first; k < first + n; ++k)
      y[k] = normal * (cells[k - sa] * (ua[k] - ua[k - sa]) - cells[k] * (ua[k + sa] - ua[k]));
    const auto add_shear = [&](int b) {
      const double* edges = viscosity.edges[pair_of(A, b)].data();
      const double* ub = u[static_cast<std::size_t>(b)].data();
      const std::ptrdiff_t sb = p.stride[static_cast<std::size_t>(b)];
      const double across = 1 / p.grid.edge[static_cast<std::size_t>(b)], own = across * across,
                   other = across * per_edge;
      for (std::ptrdiff_t k = first; k < first + n; ++k) {
        const double below = edges[k] * (own * (ua[k] - ua[k - sb]) + other * (ub[k] - ub[k - sa]));
        const double above =
            edges[k + sb] * (own * (ua[k + sb] - ua[k]) + other * (ub[k + sb] - ub[k + sb - sa]));
        y[k] += below - above;
      }
    };
    for (int b = 0; b < D; ++b)
      if (b != A) add_shear(b);
    if (const Field& c = viscosity.resistance.faces[A]; viscosity.resistance.along[A])
      for (std::ptrdiff_t k = first; k < first + n; ++k) y[k] += c[k] * ua[k];
  });
  clear_walls<A>(p, out);
}

template <int A>
void diagonal_component(const Patch& p, const Viscosity& viscosity, Field& out) {
  const std::ptrdiff_t sa = p.stride[A];
  const double normal = 2 / (p.grid.edge[A] * p.grid.edge[A]);
  for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t y, std::int64_t z) {
    for (std::int64_t i = 0; i < n; ++i) {
      const std::ptrdiff_t k = first + i;
      double d = normal * (viscosity.cells[k] + viscosity.cells[k - sa]);
      if (viscosity.resistance.along[A]) d += viscosity.resistance.faces[A][k];
      const Int3 x{p.own.lo[0] + i, y, z};
      for (int b = 0; b < p.grid.dim; ++b) {
        if (b == A) continue;
        const auto bb = static_cast<std::size_t>(b);
        const Field& edges = viscosity.edges[pair_of(A, b)];
        // Behind a wall is the image of the velocity itself: no share of it where it slips, twice where not.
        const auto share = [&](int side, bool beside) {
          if (!beside || p.grid.periodic(b)) return 1.0;
          return p.grid.sides[bb][static_cast<std::size_t>(side)] == Side::free_slip ? 0.0 : 2.0;
        };
        const double below = share(0, x[bb] == 0) * edges[k];
        const double above = share(1, x[bb] == p.grid.cells[bb] - 1) * edges[k + p.stride[bb]];
        d += (below + above) / (p.grid.edge[bb] * p.grid.edge[bb]);
      }
      out[k] = 1 / d;
    }
  });
  clear_walls<A>(p, out);
}

}  // namespace

Viscosity::Viscosity(const Patch& p) : cells(p.size, 1.0) {
  for (int a = 0; a < p.grid.dim; ++a)
    for (int b = a + 1; b < p.grid.dim; ++b) edges[pair_of(a, b)].assign(p.size, 1.0);
}

void set_edges(const Patch& p, EdgeMean mean, Viscosity& v) {
  if (p.own.empty()) return;
  for (int a = 0; a < p.grid.dim; ++a)
    for (int b = a + 1; b < p.grid.dim; ++b) {
      const std::ptrdiff_t sa = p.stride[static_cast<std::size_t>(a)],
                           sb = p.stride[static_cast<std::size_t>(b)];
      Box edges = p.own;
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(p.grid.dim); ++axis) ++edges.hi[axis];
      for (std::int64_t z = edges.lo[2]; z < edges.hi[2]; ++z)
        for (std::int64_t y = edges.lo[1]; y < edges.hi[1]; ++y)
          for (std::int64_t x = edges.lo[0]; x < edges.hi[0]; ++x) {
            const std::ptrdiff_t k = p.at(x, y, z);
            const double c0 = v.cells[k], c1 = v.cells[k - sa], c2 = v.cells[k - sb],
                         c3 = v.cells[k - sa - sb];
            v.edges[pair_of(a, b)][k] = mean == EdgeMean::harmonic
                                            ? 4 / ((1 / c0 + 1 / c1) + (1 / c2 + 1 / c3))
                                            : 0.25 * ((c0 + c1) + (c2 + c3));
          }
    }
}

void apply(const Patch& p, const Viscosity& viscosity, const Velocity& u, Velocity& y) {
  if (p.grid.dim == 2) {
    apply_component<2, 0>(p, viscosity, u, y[0]);
    apply_component<2, 1>(p, viscosity, u, y[1]);
  } else {
    apply_component<3, 0>(p, viscosity, u, y[0]);
    apply_component<3, 1>(p, viscosity, u, y[1]);
    apply_component<3, 2>(p, viscosity, u, y[2]);
  }
}

Velocity inverse_diagonal(const Patch& p, const Viscosity& viscosity) {
  Velocity d;
  for (std::size_t a = 0; a < static_cast<std::size_t>(p.grid.dim); ++a) d[a].assign(p.size, 0.0);
  diagonal_component<0>(p, viscosity, d[0]);
  diagonal_component<1>(p, viscosity, d[1]);
  if (p.grid.dim == 3) diagonal_component<2>(p, viscosity, d[2]);
  return d;
}

void add_gradient(const Patch& p, const Field& pressure, double factor, Velocity& y) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(p.grid.dim); ++a) {
    const double per_edge = factor / p.grid.edge[a];
    const std::ptrdiff_t s = p.stride[a];
    for_own(p, [&](std::ptrdiff_t k) { y[a][k] += per_edge * (pressure[k] - pressure[k - s]); });
  }
  clear_walls<0>(p, y[0]);
  clear_walls<1>(p, y[1]);
  if (p.grid.dim == 3) clear_walls<2>(p, y[2]);
}

void minus_divergence(const Patch& p, const Velocity& u, Field& y) {
  for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t, std::int64_t) {
    for (std::ptrdiff_t k = first; k < first + n; ++k) y[k] = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(p.grid.dim); ++a) {
      const double per_edge = 1 / p.grid.edge[a];
      const std::ptrdiff_t s = p.stride[a];
      for (std::ptrdiff_t k = first; k < first + n; ++k) y[k] -= per_edge * (u[a][k + s] - u[a][k]);
    }
  });
}

}  // namespace stokes
