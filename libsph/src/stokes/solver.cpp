#include "stokes/solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "conjugate_gradients.hpp"
#include "decomp/exact_sum.hpp"

namespace stokes {
namespace {

constexpr int restart = 40;
// A whole cycle of the Krylov method that leaves more than this of the residual is slow: what follows finds velocities
// to `close_enough`, in at most so many V-cycles.
constexpr double slow = 0.03, close_enough = 0.01;
constexpr int most_cycles = 100;

void add(const Patch& p, double factor, const Flow& x, Flow& y) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(p.grid.dim); ++a)
    for_own(p, [&](std::ptrdiff_t k) { y.u[a][k] += factor * x.u[a][k]; });
  for_own(p, [&](std::ptrdiff_t k) { y.p[k] += factor * x.p[k]; });
}

void scale(const Patch& p, double factor, Flow& y) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(p.grid.dim); ++a)
    for_own(p, [&](std::ptrdiff_t k) { y.u[a][k] *= factor; });
  for_own(p, [&](std::ptrdiff_t k) { y.p[k] *= factor; });
}

/// Hessenberg's matrix of the Krylov vectors made triangular by rotations as it grows (Saad 2003, 6.5.3).
class LeastSquares {
 public:
  explicit LeastSquares(double beta) : g_{beta} {}
  /// `column`: products with the vectors so far, and the norm of what is left. Returns the norm of the residual.
  double add(std::vector<double> column) {
    const std::size_t j = columns_.size();
    for (std::size_t i = 0; i < j; ++i) {
      const double t = cos_[i] * column[i] + sin_[i] * column[i + 1];
      column[i + 1] = cos_[i] * column[i + 1] - sin_[i] * column[i];
      column[i] = t;
    }
    const double length = std::sqrt(column[j] * column[j] + column[j + 1] * column[j + 1]);
    cos_.push_back(column[j] / length);
    sin_.push_back(column[j + 1] / length);
    column[j] = length;
    g_.push_back(-sin_[j] * g_[j]);
    g_[j] *= cos_[j];
    columns_.push_back(std::move(column));
    return std::fabs(g_[j + 1]);
  }
  [[nodiscard]] std::vector<double> solve() const {
    const std::size_t n = columns_.size();
    std::vector<double> y(n);
    for (std::size_t i = n; i-- > 0;) {
      double s = g_[i];
      for (std::size_t k = i + 1; k < n; ++k) s -= columns_[k][i] * y[k];
      y[i] = s / columns_[i][i];
    }
    return y;
  }

 private:
  std::vector<double> g_, cos_, sin_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace

Solver::Solver(const decomp::Comm& comm, const Grid& grid, std::vector<Box> boxes)
    : comm_(&comm), multigrid_(comm, grid, std::move(boxes)) {}

Flow& Solver::kept(std::deque<Flow>& flows, std::size_t k) const {
  while (flows.size() <= k) flows.push_back(make_flow());
  return flows[k];
}

Flow Solver::make_flow() const { return {multigrid_.finest().make_velocity(), Field(patch().size, 0.0)}; }

void Solver::set_viscosity(Field cells, Resistance resistance) {
  std::array<double, 1> fluidity{0};
  for_own(patch(), [&](std::ptrdiff_t k) { fluidity[0] = std::max(fluidity[0], 1 / cells[k]); });
  comm_->max(fluidity);
  const double scale = 1 / (fluidity[0] * patch().grid.edge[0]);
  per_divergence_ = scale * scale;
  multigrid_.set_viscosity(std::move(cells), std::move(resistance));
}

void Solver::apply_all(Flow& x, Flow& y) {
  Level& level = multigrid_.finest();
  level.refresh(x.u);
  level.refresh_cells(x.p);
  apply(level.patch(), level.viscosity(), x.u, y.u);
  add_gradient(level.patch(), x.p, 1, y.u);
  minus_divergence(level.patch(), x.u, y.p);
  take_off_resisted_means(y.u);
}

int Solver::precondition(const Flow& r, bool thorough, Flow& z) {
  Level& level = multigrid_.finest();
  const Field& eta = level.viscosity().cells;
  for_own(patch(), [&](std::ptrdiff_t k) { z.p[k] = -eta[k] * r.p[k]; });
  level.refresh_cells(z.p);
  driven_ = r.u;
  add_gradient(patch(), z.p, -1, driven_);
  int cycles = 1;
  if (thorough)
    cycles = conjugate_gradients(*comm_, multigrid_, driven_, close_enough, most_cycles, z.u);
  else
    multigrid_.cycle(driven_, z.u);
  take_off_resisted_means(z.u);
  return cycles;
}

std::vector<double> Solver::dots(const Flow& w, const std::vector<const Flow*>& others) {
  std::vector<decomp::ExactSum> sums(others.size());
  const auto dim = static_cast<std::size_t>(patch().grid.dim);
  for (std::size_t q = 0; q < others.size(); ++q)
    for_own(patch(), [&](std::ptrdiff_t k) {
      double cell = per_divergence_ * (w.p[k] * others[q]->p[k]);
      for (std::size_t a = 0; a < dim; ++a) cell += w.u[a][k] * others[q]->u[a][k];
      sums[q].add(cell);
    });
  decomp::ExactSum::all_reduce(*comm_, sums);
  std::vector<double> out;
  for (const decomp::ExactSum& s : sums) out.push_back(s.value());
  return out;
}

double Solver::norm(const Flow& w) { return std::sqrt(dots(w, {&w})[0]); }

void Solver::take_off_mean(Field& values) {
  decomp::ExactSum sum;
  for_own(patch(), [&](std::ptrdiff_t k) { sum.add(values[k]); });
  decomp::ExactSum::all_reduce(*comm_, std::span(&sum, 1));
  const Int3& n = patch().grid.cells;
  const double mean = sum.value() / static_cast<double>(n[0] * n[1] * n[2]);
  for_own(patch(), [&](std::ptrdiff_t k) { values[k] -= mean; });
}

void Solver::take_off_free_means(Velocity& u) {
  for (int a = 0; a < patch().grid.dim; ++a)
    if (patch().grid.slides(a)) take_off_mean(u[static_cast<std::size_t>(a)]);
}

// Of a component that is held to a mean of 0 all forces are without one, that by which faces resist too.
void Solver::take_off_resisted_means(Velocity& u) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(patch().grid.dim); ++a)
    if (multigrid_.finest().viscosity().resistance.along[a] && patch().grid.slides(static_cast<int>(a)))
      take_off_mean(u[a]);
}

Effort Solver::solve(Velocity force, Flow& x, double tolerance, int most_iterations, const Field* source,
                     double least_norm) {
  const Patch& p = patch();
  Flow f{std::move(force), Field(p.size, 0.0)};
  if (source != nullptr) {
    for_own(p, [&](std::ptrdiff_t k) { f.p[k] = -(*source)[k]; });
    take_off_mean(f.p);
  }
  take_off_free_means(f.u);
  add_gradient(p, f.p, 0, f.u);  // nothing drives a wall
  take_off_resisted_means(x.u);
  const double wanted = tolerance * std::max(norm(f), least_norm);
  Effort effort;
  double before = 0;  // the residual when the last cycle began, after so many iterations
  int begun = 0;
  bool thorough = false;
  while (true) {
    Flow& r = kept(basis_, 0);
    apply_all(x, r);
    scale(p, -1, r);
    add(p, 1, f, r);
    const double beta = norm(r);
    effort.residual = beta == 0 ? 0 : beta * tolerance / wanted;
    effort.converged = beta <= wanted;
    if (!(beta > wanted) || effort.iterations >= most_iterations) break;  // it may be no number
    thorough = thorough || (effort.iterations == begun + restart && beta > slow * before);
    before = beta;
    begun = effort.iterations;
    improve(x, beta, wanted, most_iterations, thorough, effort);
  }
  take_off_free_means(x.u);
  take_off_mean(x.p);
  return effort;
}

void Solver::improve(Flow& x, double beta, double wanted, int most, bool thorough, Effort& effort) {
  const Patch& p = patch();
  scale(p, 1 / beta, basis_[0]);
  std::vector<const Flow*> v{&basis_[0]};
  LeastSquares least(beta);
  double left = beta;
  while (v.size() <= restart && effort.iterations < most && left > 0.9 * wanted) {
    Flow& z = kept(steps_, v.size() - 1);
    effort.cycles += precondition(*v.back(), thorough, z);
    Flow& w = kept(basis_, v.size());
    apply_all(z, w);
    std::vector<double> column = dots(w, v);
    for (std::size_t i = 0; i < v.size(); ++i) add(p, -column[i], *v[i], w);
    column.push_back(norm(w));
    const double length = column.back();
    left = least.add(std::move(column));
    ++effort.iterations;
    if (!(length > 0)) break;
    scale(p, 1 / length, w);
    v.push_back(&w);
  }
  const std::vector<double> y = least.solve();
  for (std::size_t i = 0; i < y.size(); ++i) add(p, y[i], steps_[i], x);
}

}  // namespace stokes
