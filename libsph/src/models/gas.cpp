// One step, positions advanced: density and what compression does to the energy, walls, forces with their
// heat, kick and heat. The forces derive from the energy of compression, so that the step is symplectic but
// for its viscosity.
#include "sph/models/gas.hpp"

#include <algorithm>
#include <cmath>

#include "models/gas_kernel.hpp"
#include "models/trace.hpp"
#include "pairs/for_rows.hpp"
#include "sph/laws/eos/ideal_gas.hpp"
#include "sph/models/faults.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/gas.hpp"
#include "sph/terms/shock.hpp"
#include "sph/terms/viscosity.hpp"

namespace sph {
namespace {

// What lists bear before kernels have grown out of them.
constexpr double room_to_grow = 1.2;
// Kernels that grow are not let grow faster than lists and the sums of one step bear.
constexpr double growth_in_a_step = 0.05;

std::size_t width_of_moments(std::size_t d) { return 2 + d * (d + 1) / 2 + d * d; }

// N = V^-1 spacing^D is wanted at a width s (h of the particle over that of the scene) with N s^D = 1. One
// step of Newton's method on g = N s^D - 1, from the width of the step before, gives N to second order, which
// is what the volume is taken from.
struct Compression {
  static constexpr FieldSet reads =
      Materials::reads | RangeView::reads | FieldSet{Field::number_density, Field::gas_moments};
  static constexpr FieldSet writes =
      Materials::writes | FieldSet{Field::density, Field::specific_energy, Field::smoothing_length,
                                   Field::kernel_correction, Field::velocity_gradient};
  const SphConstants* constants;
  const Materials* materials;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const Scene& scene = *constants->scene;
    const auto d = static_cast<std::size_t>(p.dim());
    const std::size_t moments = width_of_moments(d);
    double* rho = p.get<Field::density>();
    double* energy = p.get<Field::specific_energy>();
    double* h = p.get<Field::smoothing_length>();
    double* correction = p.get<Field::kernel_correction>();
    double* gradient = p.get<Field::velocity_gradient>();
    const double* sums = p.get<Field::number_density>();
    const double* more = p.get<Field::gas_moments>();
    const double* mass = p.get<Field::mass>();
    const auto* group = p.get<Field::group>();
    for_movers(step.ranges, [&](std::size_t i) {
      const double width = h[i] * constants->row_scale.inverse_h;
      const GasKernel kernel = gas_kernel(
          {width, constants->gradient_factor * scene.kernel.smoothing_length, constants->kernel_at_zero,
           sums[2 * i], sums[2 * i + 1], more[i * moments], more[i * moments + 1]},
          static_cast<int>(d), scene.kernel.least_growth, scene.kernel.largest_growth);
      if (!(kernel.open > 0))
        find_fault(*constants, p, i, step, "is inside a wall; reduce time.cfl or time.dt");
      const double before = rho[i];
      rho[i] = mass[i] * constants->row_scale.inverse_volume * kernel.number;
      h[i] = kernel.width * scene.kernel.smoothing_length;
      correction[i] = kernel.correction;
      // At the start there was no density before.
      if (before > 0)
        energy[i] =
            IdealGas{scene.groups[group[i]].eos.gas.heat_ratio}.compressed(energy[i], rho[i] / before);
      if (!(energy[i] > 0))
        find_fault(*constants, p, i, step, "has no energy left; reduce time.cfl or time.dt");
      if (d == 2)
        solve_gradient<2>(more + i * moments + 2, constants->row_scale.inverse_h, gradient + 4 * i);
      else
        solve_gradient<3>(more + i * moments + 2, constants->row_scale.inverse_h, gradient + 9 * i);
      materials->derive(p, i, i + 1);
      find_out_of_range(*constants, p, i, i + 1, step);
    });
  }
};

// The kick takes from the motion the work of the viscous forces on the mean of the velocities before and
// after it. Their heat was summed with those before: what is missing, dt/2 a.F_visc, is taken from the
// particle itself. A step compresses with the pressure that was before the heat at its start and with that
// after it at its end: heat belongs to its middle, and is what it would have been there. So energy is
// conserved to second order.
struct Heat {
  static constexpr FieldSet reads = GasView::reads | Materials::reads | RangeView::reads |
                                    FieldSet{Field::heating, Field::force, Field::velocity_gradient};
  static constexpr FieldSet writes = Materials::writes | FieldSet{Field::specific_energy};
  const SphConstants* constants;
  const Materials* materials;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const Scene& scene = *constants->scene;
    double* energy = p.get<Field::specific_energy>();
    const double* heating = p.get<Field::heating>();
    const double* force = p.get<Field::force>();
    const double* mass = p.get<Field::mass>();
    const double* gradient = p.get<Field::velocity_gradient>();
    const auto* group = p.get<Field::group>();
    const std::size_t d = static_cast<std::size_t>(p.dim());
    const double fastest_in_time = scene.time.cfl * scene.kernel.smoothing_length / growth_in_a_step;
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
      const RowRange& r = range_of(step.ranges, c);
      for (std::size_t i = r.first; i < r.last; ++i) {
        const double* own = heating + i * (1 + d);
        double power = own[0];
        for (std::size_t a = 0; a < d; ++a)
          power -= 0.5 * step.global.dt * (force[i * d + a] / mass[i]) * own[1 + a];
        const double expansion = trace_of(gradient + i * d * d, d);
        const double later =
            1 - 0.5 * (scene.groups[group[i]].eos.gas.heat_ratio - 1) * step.global.dt * expansion;
        step.maxima.sound = larger(fastest_in_time / static_cast<double>(d) * expansion, step.maxima.sound);
        energy[i] += step.global.dt * (power / mass[i]) / std::fmin(std::fmax(later, 0.7), 1.4);
        if (!(energy[i] > 0))
          find_fault(*constants, p, i, step, "has no energy left; reduce time.cfl or time.dt");
      }
      materials->derive(p, r.first, r.last);
      find_out_of_range(*constants, p, r.first, r.last, step);
      look_at_gas(*constants, p, r.first, r.last, step.maxima);
    }
  }
};

// At the start neither density nor kernels are known: steps towards them.
class KernelWidths final : public Settling {
 public:
  explicit KernelWidths(const SphConstants& constants) : constants_(&constants) {
    prepares = {Field::density};
    settles = {Field::smoothing_length};
  }
  void prepare(Particles& p) override {
    double* density = p.data<Field::density>();
    const double* h = p.data<Field::smoothing_length>();
    const auto* group = p.data<Field::group>();
    for (std::size_t i = 0; i < p.owned(); ++i)
      if (!constants_->is_wall(group[i])) density[i] = 0;  // not summed yet: no work is done
    before_.assign(h, h + p.owned());
  }
  [[nodiscard]] double change(const Particles& p) const override {
    double most = 0;
    const double* h = p.data<Field::smoothing_length>();
    for (std::size_t i = 0; i < before_.size(); ++i) most = std::max(most, std::abs(h[i] / before_[i] - 1));
    return most;
  }

 private:
  const SphConstants* constants_;
  std::vector<double> before_;  ///< h [m]
};

}  // namespace

void look_at_gas(const SphConstants& constants, const GasView& p, std::size_t first, std::size_t last,
                 StepMaxima& maxima) {
  const Scene& scene = *constants.scene;
  const auto d = static_cast<std::size_t>(p.dim());
  const double* rho = p.get<Field::density>();
  const double* energy = p.get<Field::specific_energy>();
  const double* v = p.get<Field::velocity>();
  const double* h = p.get<Field::smoothing_length>();
  const auto* group = p.get<Field::group>();
  for (std::size_t i = first; i < last; ++i) {
    const Group& g = scene.groups[group[i]];
    if (g.kind == GroupKind::wall) continue;
    double square = 0;
    for (std::size_t a = 0; a < d; ++a) square += v[i * d + a] * v[i * d + a];
    const double finer = scene.kernel.smoothing_length / h[i];
    const double sound = IdealGas{g.eos.gas.heat_ratio}.sound_speed(energy[i]);
    maxima.sound = larger((sound + std::sqrt(square)) * finer, maxima.sound);
    if (rho[i] > 0) maxima.viscosity = std::fmax(maxima.viscosity, g.viscosity / rho[i] * (finer * finer));
  }
}

void add_gas(Builder& b) {
  b.add_fields({Field::smoothing_length, Field::kernel_correction, Field::velocity_gradient});
  b.add_sums("density", {term<NumberDensity>, term<GasMoments>});
  b.add_update("compression", Compression{&b.constants(), &b.materials()});
  b.settle_with_these(std::make_shared<KernelWidths>(b.constants()));
  // A gas may start with a jump of its pressure, and accelerations are never larger than then: the error of a
  // first step that takes velocities as those of half a step later would stay in its energy.
  b.begin_with_half_a_kick();
  if (b.scene().has_kind(GroupKind::wall)) add_walls(b, false);
  b.add_sums("forces", {term<GasPressure>, term<Viscosity>, term<ShockViscosity>, term<ShockHeating>});
}

void add_heat(Builder& b) { b.add_kick("heat", Heat{&b.constants(), &b.materials()}); }

const std::vector<double>& GasReach::find(const Particles& p) {
  listed_.resize(p.rows());
  const double* h = p.data<Field::smoothing_length>();
  const double radius = scene_->support() / scene_->kernel.smoothing_length;
  for (std::size_t i = 0; i < listed_.size(); ++i)
    listed_[i] = std::fmin(radius * room_to_grow * h[i], scene_->list_range());
  return listed_;
}

double GasReach::growth(const Particles& p) const {
  double most = 0;
  const double* h = p.data<Field::smoothing_length>();
  const double radius = scene_->support() / scene_->kernel.smoothing_length;
  for (std::size_t i = 0; i < (listed_.empty() ? 0 : p.owned()); ++i)
    most = std::fmax(most, std::fmin(radius * fastest_growth * h[i], scene_->list_range()) / listed_[i]);
  return most;
}

}  // namespace sph
