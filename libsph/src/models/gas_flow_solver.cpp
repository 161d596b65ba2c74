#include "models/gas_flow_solver.hpp"

#include <fmt/format.h>

#include <cmath>

#include "models/conjugate_gradients.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/terms/gas_flow.hpp"

namespace sph {
namespace {

constexpr int most_iterations = 2000;
// Of the pressures: what sums are rounded by.
constexpr double rounding = 1e-14;

class GasFlowSolver final : public Solver {
 public:
  static constexpr FieldSet reads =
      GasOutside::reads | FieldSet{Field::gas_content, Field::gas_gain, Field::exchange_sums,
                                   Field::liquid_mass, Field::dissolved_gas};
  static constexpr FieldSet writes{Field::trial};
  using Rows = View<reads, writes>;

  GasFlowSolver(const SphConstants& constants, GasOutside outside)
      : constants_(&constants),
        outside_(std::move(outside)),
        tolerance_(constants.scene->terms.exchange.tolerance) {}

  /// Applied to anything, the operator tells its diagonal.
  void begin(const Rows& p, const Step& step) {
    for_rows(step.ranges,
             {RowClass::interior_movers, RowClass::boundary_movers, RowClass::interior_walls,
              RowClass::boundary_walls},
             [&](std::size_t i) { p.get<Field::trial>()[i] = 0; });
    iteration_ = 0;
  }
  [[nodiscard]] std::span<decomp::ExactSum> products(const StepState&) override;
  [[nodiscard]] bool improve(StepState&) override;

 private:
  void set_out(const Rows&, const Step&);
  [[nodiscard]] double capacity(const Rows&, std::size_t row) const;

  const SphConstants* constants_;
  GasOutside outside_;
  double tolerance_;
  int iteration_ = 0;
  double enough_ = 0;           ///< what the residual's square must not be above
  std::vector<double> kept_;    ///< C + dt dq/dp of what comes from outside [kg/Pa], 0 without gas that flows
  ConjugateGradients changes_;  ///< of pressures; beside them squares of pressures
};

/// Gas for a rise of the pressure in a volume that stays [kg/Pa]; 0 where there is no gas that flows.
double GasFlowSolver::capacity(const Rows& p, std::size_t i) const {
  if (!(p.get<Field::liquid_mass>()[i] > 0)) return 0;
  const Scene& scene = *constants_->scene;
  const Group& g = scene.groups[p.get<Field::group>()[i]];
  if (g.eos.law->kind != EosKind::bubbly) return 0;         // was, and keeps its gas
  const double* dissolved = p.get<Field::dissolved_gas>();  // what is in solution stays there in this step
  const double stiffness =
      gas_stiffness(g, p.get<Field::gas_content>()[i], dissolved != nullptr ? dissolved + i : nullptr,
                    p.get<Field::gas_pressure>()[i] + scene.domain.surface_pressure);
  return stiffness > 0 ? p.get<Field::mass>()[i] / p.get<Field::density>()[i] / stiffness : 0.0;
}

std::span<decomp::ExactSum> GasFlowSolver::products(const StepState& s) {
  if (iteration_ == 0) return {};
  const Rows p(s.particles);
  const double dt = s.global.dt, *sums = p.get<Field::exchange_sums>(), *direction = p.get<Field::trial>();
  return changes_.multiply(s.ranges, direction, [&](std::size_t i, std::size_t) {
    return kept_[i] > 0 ? kept_[i] * direction[i] - dt * sums[2 * i] : 0.0;
  });
}

bool GasFlowSolver::improve(StepState& s) {
  const Rows p(s.particles);
  double* trial = p.get<Field::trial>();
  if (iteration_++ == 0) {
    set_out(p, s);
    changes_.begin(s.ranges, trial);
    return true;
  }
  const double square = changes_.square();
  if (changes_.is_first())
    enough_ = std::fmax(tolerance_ * tolerance_ * square, rounding * rounding * changes_.beside(0).value());
  if (!(square > enough_)) {
    const double* pressure = p.get<Field::gas_pressure>();
    for_movers(s.ranges, [&](std::size_t i) { trial[i] = pressure[i] + changes_.change(i); });
    for_walls(s.ranges, [&](std::size_t i) { trial[i] = pressure[i]; });
    return false;
  }
  if (iteration_ <= most_iterations && changes_.advance(s.ranges, trial)) return true;
  throw GuardError(fmt::format(
      "step {}: implicit gas flow did not converge; reduce time.dt or raise terms.exchange_tolerance",
      s.global.step));
}

void GasFlowSolver::set_out(const Rows& p, const Step& step) {
  const double dt = step.global.dt, *sums = p.get<Field::exchange_sums>();
  const double *gain = p.get<Field::gas_gain>(), *pressure = p.get<Field::gas_pressure>();
  const auto d = static_cast<std::size_t>(p.dim());
  const double surface = constants_->scene->domain.surface_pressure;
  changes_.clear(p.owned(), 1);
  kept_.assign(p.owned(), 0.0);
  for_movers(step.ranges, [&](std::size_t i) {
    const double content = capacity(p, i);
    if (!(content > 0)) return;
    kept_[i] = content + dt * outside_.slope(p, i);
    const double diagonal = kept_[i] + dt * sums[2 * i + 1], absolute = pressure[i] + surface;
    changes_.residual(i) = dt * (gain[i * (d + 1)] + outside_.rate(p, i, pressure[i]));
    changes_.diagonal(i) = diagonal;
    changes_.beside(0).add(diagonal * absolute * absolute);
  });
  for_walls(step.ranges, [&](std::size_t i) { p.get<Field::trial>()[i] = 0; });
}

struct FirstChange {
  static constexpr FieldSet reads = GasFlowSolver::reads;
  static constexpr FieldSet writes = GasFlowSolver::writes;
  std::shared_ptr<GasFlowSolver> solver;

  void operator()(const View<reads, writes>& p, const Step& step) const { solver->begin(p, step); }
};

}  // namespace

void add_implicit_gas_pressures(Builder& b, const GasOutside& outside) {
  b.add_fields({Field::trial});
  const auto solver = std::make_shared<GasFlowSolver>(b.constants(), outside);
  b.add_update("no change of pressure", FirstChange{solver});
  b.add_loop(
      {{b.sums_over_pairs("gas pressures", {term<GasOperator>}, Builder::Rows::movers, Precision::double_)},
       solver,
       GasFlowSolver::writes});
}

}  // namespace sph
