#include "models/conduction_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "models/conjugate_gradients.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/models/faults.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/conduction.hpp"

namespace sph {
namespace {

constexpr int most_iterations = 2000, most_linearisations = 60;
// Of the temperatures: what sums are rounded by.
constexpr double rounding = 1e-14;

class ConductionSolver final : public Solver {
 public:
  static constexpr FieldSet reads =
      FaultView::reads | FieldSet{Field::mass, Field::exchange_sums, Field::wall_heat, Field::viscous_heat};
  static constexpr FieldSet writes{Field::trial, Field::enthalpy, Field::temperature, Field::heat_inflow};
  using Rows = View<reads, writes>;

  explicit ConductionSolver(const SphConstants& constants);

  /// The first temperatures that are tried are those of the start of the step.
  void begin(const Rows&, const Step&);
  [[nodiscard]] std::span<decomp::ExactSum> products(const StepState&) override;
  [[nodiscard]] bool improve(StepState&) override;

 private:
  /// From walls and friction, if the particle were at T [W].
  [[nodiscard]] double outside(const Rows&, std::size_t row, double temperature) const;
  [[nodiscard]] const HeatMaterial& material(const Rows&, std::size_t row) const;
  void look(const Rows&, const Step&);
  /// The square of the imbalances that the heat of all particles bears.
  [[nodiscard]] double enough_now() const;
  void linearise(const Rows&, const Step&);
  void correct(const Rows&, const Step&);
  void finish(const Rows&, const Step&) const;

  const SphConstants* constants_;
  double tolerance_;
  bool latent_;             ///< some H(T) has a kink
  bool searching_ = false;  ///< for a correction; else the temperatures that were tried are looked at
  int linearisations_ = 0, iterations_ = 0;
  double enough_ = 0, target_ = 0;            ///< squares of residuals: of the step, of the correction
  std::vector<double> enthalpy_, imbalance_;  ///< tried [J/kg]; of the balance above [J]
  /// Of imbalances and temperatures as the gradients weigh them; of imbalances, of what the step changes and of
  /// temperatures as they are warmth: over and times a heat capacity.
  std::array<decomp::ExactSum, 5> squares_;
  ConjugateGradients changes_;  ///< of temperatures
};

ConductionSolver::ConductionSolver(const SphConstants& constants)
    : constants_(&constants),
      tolerance_(constants.scene->terms.exchange.tolerance),
      latent_(std::ranges::any_of(constants.scene->groups,
                                  [](const Group& g) { return g.heat.material.latent_heat > 0; })) {}

const HeatMaterial& ConductionSolver::material(const Rows& p, std::size_t i) const {
  return constants_->scene->groups[p.get<Field::group>()[i]].heat.material;
}

double ConductionSolver::outside(const Rows& p, std::size_t i, double t) const {
  double heat = 0;
  if (const double* walls = p.get<Field::wall_heat>())
    heat += walls[2 * i] - walls[2 * i + 1] * (t - p.get<Field::temperature>()[i]);
  if (const double* friction = p.get<Field::viscous_heat>()) heat += friction[i];
  return heat;
}

void ConductionSolver::begin(const Rows& p, const Step& step) {
  const double *h = p.get<Field::enthalpy>(), *t = p.get<Field::temperature>();
  double* trial = p.get<Field::trial>();
  enthalpy_.assign(h, h + p.owned());
  imbalance_.assign(p.owned(), 0.0);
  for_movers(step.ranges, [&](std::size_t i) { trial[i] = t[i]; });
  for_walls(step.ranges, [&](std::size_t i) { trial[i] = 0; });
  searching_ = false;
  linearisations_ = 0;
}

std::span<decomp::ExactSum> ConductionSolver::products(const StepState& s) {
  const Rows p(s.particles);
  if (!searching_) {
    look(p, s);
    return squares_;
  }
  const double dt = s.global.dt, *mass = p.get<Field::mass>(), *sums = p.get<Field::exchange_sums>();
  const double *walls = p.get<Field::wall_heat>(), *direction = p.get<Field::trial>();
  return changes_.multiply(s.ranges, direction, [&](std::size_t i, std::size_t) {
    const double kept = mass[i] * heat_capacity(material(p, i), enthalpy_[i]) +
                        (walls != nullptr ? dt * walls[2 * i + 1] : 0.0);
    return kept * direction[i] - dt * sums[2 * i];
  });
}

// What the balance lacks at the temperatures tried, and how much it changes with a particle's own.
void ConductionSolver::look(const Rows& p, const Step& step) {
  const double dt = step.global.dt, *mass = p.get<Field::mass>(), *sums = p.get<Field::exchange_sums>();
  const double *walls = p.get<Field::wall_heat>(), *h = p.get<Field::enthalpy>(),
               *t = p.get<Field::temperature>(), *trial = p.get<Field::trial>();
  squares_ = {};
  changes_.clear(p.owned(), 1);
  for_movers(step.ranges, [&](std::size_t i) {
    const double capacity = mass[i] * heat_capacity(material(p, i), enthalpy_[i]),
                 gain = mass[i] * (enthalpy_[i] - h[i]);
    const double diagonal = capacity + dt * (sums[2 * i + 1] + (walls != nullptr ? walls[2 * i + 1] : 0.0));
    const double lack = dt * (sums[2 * i] + outside(p, i, trial[i])) - gain;
    changes_.residual(i) = lack;
    changes_.diagonal(i) = diagonal;
    squares_[0].add(lack * lack / diagonal);
    squares_[1].add(diagonal * t[i] * t[i]);
    squares_[2].add(lack * lack / capacity);
    squares_[3].add(gain * gain / capacity);
    squares_[4].add(diagonal * t[i] * (diagonal * t[i]) / capacity);
  });
}

// The first imbalance is what an explicit step would change: in long steps far more than this one does, and what the balance
// lacks is the error of the heat that the final fluxes bring. That must be a share of what the step has turned out to
// change.
double ConductionSolver::enough_now() const {
  const double error = squares_[2].value(), wanted = std::fmax(tolerance_ * tolerance_ * squares_[3].value(),
                                                               rounding * rounding * squares_[4].value());
  return error > wanted ? std::fmin(enough_, squares_[0].value() * (wanted / error)) : enough_;
}

bool ConductionSolver::improve(StepState& s) {
  const Rows p(s.particles);
  double* trial = p.get<Field::trial>();
  if (!searching_) {
    const double square = squares_[0].value();
    if (linearisations_ == 0)
      enough_ = std::fmax(tolerance_ * tolerance_ * square, rounding * rounding * squares_[1].value());
    const double enough = linearisations_ == 0 ? enough_ : enough_now();
    if (!(square > enough)) {
      finish(p, s);
      return false;
    }
    target_ = 0.25 * enough;
    if (latent_) target_ = std::fmax(target_, 1e-4 * square);
    ++linearisations_;
    iterations_ = 0;
    changes_.begin(s.ranges, trial);
    searching_ = true;
    return true;
  }
  if (!(changes_.square() > target_)) {
    correct(p, s);
    searching_ = false;
    return true;
  }
  if (linearisations_ <= most_linearisations && iterations_++ < most_iterations &&
      changes_.advance(s.ranges, trial))
    return true;
  throw GuardError(fmt::format(
      "step {}: implicit conduction did not converge; reduce time.dt or raise terms.exchange_tolerance",
      s.global.step));
}

void ConductionSolver::correct(const Rows& p, const Step& step) {
  double* trial = p.get<Field::trial>();
  for_movers(step.ranges, [&](std::size_t i) {
    enthalpy_[i] += heat_capacity(material(p, i), enthalpy_[i]) * changes_.change(i);
    trial[i] = temperature(material(p, i), enthalpy_[i]);
  });
}

void ConductionSolver::finish(const Rows& p, const Step& step) const {
  const double dt = step.global.dt, *mass = p.get<Field::mass>(), *sums = p.get<Field::exchange_sums>();
  double *h = p.get<Field::enthalpy>(), *t = p.get<Field::temperature>(),
         *inflow = p.get<Field::heat_inflow>();
  const double* trial = p.get<Field::trial>();
  for_movers(step.ranges, [&](std::size_t i) {
    const double from_outside = outside(p, i, trial[i]);
    h[i] += dt * (sums[2 * i] + from_outside) / mass[i];
    if (inflow != nullptr) inflow[i] += dt * from_outside;
    t[i] = temperature(material(p, i), h[i]);
    if (!(h[i] >= 0 && std::isfinite(h[i])))
      find_fault(
          *constants_, p, i, step,
          fmt::format("is at {:.3g} K; reduce terms.exchange_tolerance, time.dt, or the heat that walls take",
                      t[i]));
  });
}

struct FirstTemperatures {
  static constexpr FieldSet reads = ConductionSolver::reads;
  static constexpr FieldSet writes = ConductionSolver::writes;
  std::shared_ptr<ConductionSolver> solver;

  void operator()(const View<reads, writes>& p, const Step& step) const { solver->begin(p, step); }
};

}  // namespace

void add_implicit_conduction(Builder& b) {
  b.add_fields({Field::trial});
  const auto solver = std::make_shared<ConductionSolver>(b.constants());
  b.add_update("first temperatures", FirstTemperatures{solver});
  b.add_loop({{b.sums_over_pairs("conduction", {term<ConductionOperator>}, Builder::Rows::movers,
                                 Precision::double_)},
              solver,
              ConductionSolver::writes});
}

}  // namespace sph
