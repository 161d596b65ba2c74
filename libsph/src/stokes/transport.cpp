#include "stokes/transport.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stokes {
namespace {

constexpr double most_gain = 0.1;  // of a cell, in a step

constexpr int limiter_reach = 2;

/// Of a line of n faces: c is the cell above the first, `step` leads to the next along the axis, `courant` is signed.
void limited_values(const double* c, std::ptrdiff_t step, const double* courant, std::ptrdiff_t n,
                    double* face) {
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double c0 = c[i - 2 * step], c1 = c[i - step], c2 = c[i], c3 = c[i + step];
    const bool up = courant[i] > 0;
    const double from = up ? c1 : c2, behind = up ? c1 - c0 : c2 - c3, ahead = up ? c2 - c1 : c1 - c2;
    // minmod(ahead, third order, behind), the half of Koren's limiter times `behind`
    const double third = (behind + 2 * ahead) * (1.0 / 6);
    const double least = std::min(ahead, std::min(third, behind)),
                 most = std::max(ahead, std::max(third, behind));
    face[i] = from + (std::max(least, 0.0) + std::min(most, 0.0));
  }
}

/// What a patch's faces carry, line by line, each face found once.
template <int D>
class Inflow {
 public:
  Inflow(const Patch& p, const Patch& wide, const Velocity& courant, const Field& c)
      : p_(p), wide_(wide), courant_(courant), c_(c), n_(p.own.hi[0] - p.own.lo[0]) {
    const auto n = static_cast<std::size_t>(n_);
    const auto lines = static_cast<std::size_t>(p.own.hi[1] - p.own.lo[1]);
    lower_[0].resize(n + 1);
    lower_[1].resize(n);
    if (D == 3) lower_[2].resize(n * lines);
    upper_.resize(n);
    sum_.resize(n);
  }

  /// sum F (C_face - C) of a line of cells, the next of the patch. `k`: its first cell.
  const double* of_line(std::ptrdiff_t k, std::int64_t y, std::int64_t z) {
    const double* c = c_.data() + wide_.at(p_.own.lo[0], y, z);
    limited_values(c, 1, courant_[0].data() + k, n_ + 1, lower_[0].data());
    const double *f = lower_[0].data(), *x = courant_[0].data() + k;
    for (std::ptrdiff_t i = 0; i < n_; ++i) sum_[i] = x[i] * (f[i] - c[i]) - x[i + 1] * (f[i + 1] - c[i]);
    add(1, c, k, lower_[1].data(), y == p_.own.lo[1]);
    if (D == 3) add(2, c, k, lower_[2].data() + (y - p_.own.lo[1]) * n_, z == p_.own.lo[2]);
    return sum_.data();
  }

 private:
  /// `lower`: values on the lower faces of the line, found when it was the upper side of the one before.
  void add(std::size_t axis, const double* c, std::ptrdiff_t k, double* lower, bool first) {
    const std::ptrdiff_t s = wide_.stride[axis];
    const double *x = courant_[axis].data() + k, *above = x + p_.stride[axis];
    if (first) limited_values(c, s, x, n_, lower);
    double *upper = upper_.data(), *sum = sum_.data();
    limited_values(c + s, s, above, n_, upper);
    for (std::ptrdiff_t i = 0; i < n_; ++i) {
      sum[i] += x[i] * (lower[i] - c[i]) - above[i] * (upper[i] - c[i]);
      lower[i] = upper[i];
    }
  }

  const Patch &p_, &wide_;
  const Velocity& courant_;
  const Field& c_;
  std::ptrdiff_t n_;
  std::array<Field, 3> lower_;
  Field upper_, sum_;
};

/// work(index of the first cell, number of cells, their sums F (C_face - C)) for each line.
template <class Work>
void for_inflow(const Patch& p, const Patch& wide, const Velocity& courant, const Field& c, Work work) {
  if (p.own.empty()) return;
  const auto all_lines = [&](auto inflow) {
    for_lines(p, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t y, std::int64_t z) {
      work(first, n, inflow.of_line(first, y, z));
    });
  };
  if (p.grid.dim == 2)
    all_lines(Inflow<2>(p, wide, courant, c));
  else
    all_lines(Inflow<3>(p, wide, courant, c));
}

/// 0 of nothing.
double share(double part, double whole) {
  return part / (whole > 0 ? whole : std::numeric_limits<double>::infinity());
}

}  // namespace

Transport::Transport(const decomp::Comm& comm, const Grid& grid, std::vector<Box> boxes)
    : comm_(&comm),
      patch_(grid, boxes[static_cast<std::size_t>(comm.rank())]),
      wide_(grid, patch_.own, limiter_reach),
      face_halo_(comm, grid.cells, grid.periodic_axes(), boxes, frames_of(grid, boxes)),
      cell_halo_(comm, grid.cells, grid.periodic_axes(), boxes, frames_of(grid, boxes, limiter_reach)),
      growth_(patch_.size, 0.0) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(grid.dim); ++a) courant_[a].assign(patch_.size, 0.0);
}

void Transport::set_courant(const Velocity& u, double dt) {
  std::vector<decomp::CellValues> values;
  for (std::size_t a = 0; a < static_cast<std::size_t>(patch_.grid.dim); ++a) {
    const double per_speed = dt / patch_.grid.edge[a];
    for_own(patch_, [&](std::ptrdiff_t k) { courant_[a][k] = per_speed * u[a][k]; });
    values.push_back(decomp::cell_values(std::span(courant_[a]), patch_.frame));
  }
  face_halo_.copy(values, values);
  mirror_velocity(patch_, courant_);
}

void Transport::widen(std::span<const Carried> fields) {
  wide_values_.resize(std::max(wide_values_.size(), fields.size()), Field(wide_.size, 0.0));
  std::vector<decomp::CellValues> values;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    for_lines(patch_, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t y, std::int64_t z) {
      std::copy_n(fields[f].values->data() + first, n,
                  wide_values_[f].data() + wide_.at(wide_.own.lo[0], y, z));
    });
    values.push_back(decomp::cell_values(std::span(wide_values_[f]), wide_.frame));
  }
  cell_halo_.copy(values, values);
  for (std::size_t f = 0; f < fields.size(); ++f) {
    mirror_cells(wide_, wide_values_[f]);
    if (fields[f].conduction != nullptr) fields[f].conduction->extend(wide_, wide_values_[f]);
  }
}

void Transport::advect(const Velocity& u, double dt, Field& volume, std::span<const Carried> carried) {
  set_courant(u, dt);
  for_lines(patch_, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t, std::int64_t) {
    for (std::ptrdiff_t k = first; k < first + n; ++k) growth_[k] = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(patch_.grid.dim); ++a) {
      const double *x = courant_[a].data(), *above = x + patch_.stride[a];
      for (std::ptrdiff_t k = first; k < first + n; ++k) growth_[k] += x[k] - above[k];
    }
  });
  const double *m = volume.data(), *growth = growth_.data();
  widen(carried);
  stage_.resize(std::max(stage_.size(), carried.size()), Field(patch_.size, 0.0));
  std::vector<Carried> stages;
  for (std::size_t f = 0; f < carried.size(); ++f) {
    const double* old = carried[f].values->data();
    double* next = stage_[f].data();
    for_inflow(patch_, wide_, courant_, wide_values_[f],
               [&](std::ptrdiff_t first, std::int64_t n, const double* in) {
                 for (std::ptrdiff_t k = first; k < first + n; ++k)
                   next[k] = old[k] + share(in[k - first], m[k] + growth[k]);
               });
    stages.push_back({&stage_[f], carried[f].conduction});
  }
  widen(stages);
  for (std::size_t f = 0; f < carried.size(); ++f) {
    double* c = carried[f].values->data();
    const double* middle = stage_[f].data();
    for_inflow(patch_, wide_, courant_, wide_values_[f],
               [&](std::ptrdiff_t first, std::int64_t n, const double* in) {
                 for (std::ptrdiff_t k = first; k < first + n; ++k) {
                   const double m2 = (m[k] + growth[k]) + growth[k];
                   const double c2 = middle[k] + share(in[k - first], m2);
                   c[k] += share(m2, m[k] + m2) * (c2 - c[k]);
                 }
               });
  }
  for_own(patch_, [&](std::ptrdiff_t k) { volume[k] += growth_[k]; });
}

double Transport::longest_step(const Velocity& u, double cfl) {
  set_courant(u, 1);
  std::array<double, 2> most{};  // passed, and gained
  for_own(patch_, [&](std::ptrdiff_t k) {
    double sum = 0, gain = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(patch_.grid.dim); ++a) {
      const double lower = courant_[a][k], upper = courant_[a][k + patch_.stride[a]];
      sum += std::max(std::fabs(lower), std::fabs(upper));
      gain += upper - lower;
    }
    most[0] = std::max(most[0], sum);
    most[1] = std::max(most[1], std::fabs(gain));
  });
  comm_->max(most);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return std::min(most[0] > 0 ? cfl / most[0] : infinite, most[1] > 0 ? most_gain / most[1] : infinite);
}

}  // namespace stokes
