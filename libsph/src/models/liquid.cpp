// Fluids and updated-Lagrangian solids. One step, positions advanced: kinematics (density and stress from the
// velocities), walls (extrapolation from the new pressures), forces, kick. The density is advanced with the
// velocity of the half step before the kick that uses it: symplectic, stable to c dt/h well above 0.8
// (accuracy.md 0.3).
#include <algorithm>

#include "models/trace.hpp"
#include "pairs/for_rows.hpp"
#include "sph/models/faults.hpp"
#include "sph/models/gas_flow.hpp"
#include "sph/models/models.hpp"
#include "sph/models/stress_update.hpp"
#include "sph/terms/artificial_viscosity.hpp"
#include "sph/terms/crack.hpp"
#include "sph/terms/density_diffusion.hpp"
#include "sph/terms/divergence.hpp"
#include "sph/terms/pressure.hpp"
#include "sph/terms/shifting.hpp"
#include "sph/terms/stress.hpp"
#include "sph/terms/surface_tension.hpp"
#include "sph/terms/tension_jump.hpp"
#include "sph/terms/viscosity.hpp"
#include "sph/terms/wetted.hpp"

namespace sph {
namespace {

// A flow that disorders its particles seems compressed to their sums of div v, and the shifting that orders
// them again is in no sum: the mean density of a closed box would rise, or fall, without end. But the box is
// as large as ever, so densities are scaled to fill it.
double filling(const GlobalState& global) {
  const FluidVolume& v = global.fluid_volume;
  return v.start == v.now ? 1.0 : static_cast<double>(v.now) / static_cast<double>(v.start);
}

struct Densities {
  static constexpr FieldSet reads =
      Materials::reads | RangeView::reads |
      FieldSet{Field::diffusion, Field::divergence, Field::velocity_gradient, Field::buffer};
  static constexpr FieldSet writes = Materials::writes | FieldSet{Field::density, Field::stress};
  const SphConstants* constants;
  const Materials* materials;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
      const RowRange& r = range_of(step.ranges, c);
      update(p, r.first, r.last, step.global);
      find_out_of_range(*constants, p, r.first, r.last, step);
    }
  }

  void update(const View<reads, writes>& p, std::size_t first, std::size_t last,
              const GlobalState& global) const {
    const Scene* scene = constants->scene;
    const double dt = global.dt, fill = filling(global);
    double* rho = p.get<Field::density>();
    const double* diffusion = p.get<Field::diffusion>();
    const double* divergence = p.get<Field::divergence>();
    const double* gradient = p.get<Field::velocity_gradient>();
    double* stress = p.get<Field::stress>();
    const auto* group = p.get<Field::group>();
    const std::uint32_t* buffer = p.get<Field::buffer>();
    const std::size_t d = static_cast<std::size_t>(p.dim()), components_of_stress = d * (d + 1) / 2;
    for (std::size_t i = first; i < last; ++i) {
      const Group& g = scene->groups[group[i]];
      if (is_body(g) || (buffer != nullptr && buffer[i] != 0)) continue;
      double div = 0;
      if (divergence != nullptr) {
        div = divergence[i];
      } else {
        div = trace_of(gradient + i * d * d, d);
        if (g.kind == GroupKind::solid) {
          if (d == 2)
            update_deviator<2>(stress + i * components_of_stress, gradient + i * 4, g.solid.shear_modulus,
                               dt);
          else
            update_deviator<3>(stress + i * components_of_stress, gradient + i * 9, g.solid.shear_modulus,
                               dt);
        }
      }
      const double exchanged = g.kind == GroupKind::solid ? 0.0 : diffusion[i];
      rho[i] = (rho[i] + dt * (exchanged - rho[i] * div)) * fill;
    }
    materials->derive(p, first, last);
  }
};

// Second viscosity, Ida eq. (9): an excess pressure -zeta div v in the forces of this step only.
struct ExcessPressures {
  static constexpr FieldSet reads{Field::divergence, Field::velocity_gradient, Field::group};
  static constexpr FieldSet writes{Field::pressure};
  const Scene* scene;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double* divergence = p.get<Field::divergence>();
    const double* gradient = p.get<Field::velocity_gradient>();
    const auto* group = p.get<Field::group>();
    double* pressure = p.get<Field::pressure>();
    for_movers(step.ranges, [&](std::size_t i) {
      pressure[i] -= scene->groups[group[i]].viscosity_law.bulk *
                     (divergence != nullptr ? divergence[i] : trace_of(gradient + i * d * d, d));
    });
  }
};

/// Solids whose stress follows the rate of strain.
bool has_updated(const Scene& s) { return s.has_kind(GroupKind::solid) && !s.total_lagrangian(); }
bool slips(const Scene& s) { return has_updated(s) && s.has_kind(GroupKind::fluid); }
bool weighted(const Scene& s) { return s.terms.pressure_weights == PressureWeights::density; }
bool tension(const Scene& s) { return s.terms.surface_tension.coefficient > 0; }

}  // namespace

bool bulk_viscous(const Scene& s) {
  return std::ranges::any_of(s.groups, [](const Group& g) { return g.viscosity_law.bulk > 0; });
}

void add_kinematics(Builder& b) {
  const Scene& s = b.scene();
  const auto movers = std::ranges::count_if(s.groups, is_matter);
  const bool solid = has_updated(s);
  const bool single = movers == 1 && !b.fields().has(Field::sound_speed);
  std::vector<Term> terms{slips(s)      ? term<SlippingGradient>
                          : solid       ? term<VelocityGradient>
                          : weighted(s) ? term<WeightedDivergence>
                                        : term<Divergence>,
                          has_drag(s)                        ? term<MixtureDensityDiffusion>
                          : s.domain.central_pull > 0        ? term<PulledDensityDiffusion>
                          : single && !solid && !weighted(s) ? term<UniformDensityDiffusion>
                                                             : term<DensityDiffusion>};
  if (has_wet_bodies(s)) {
    add_flow_onto_solids(b);
    terms.push_back(term<FlowFromSolids>);
  }
  if (s.terms.shifting || has_escape(s)) terms.push_back(term<Concentration>);
  if (tension(s)) terms.push_back(term<ColourGradient>);
  b.add_sums("kinematics", terms);
  b.add_update("densities", Densities{&b.constants(), &b.materials()});
  if (weighted(s)) b.add_fields({Field::wall_pressures});
}

void add_excess_pressures(Builder& b) { b.add_update("excess pressures", ExcessPressures{&b.scene()}); }

namespace {

void add_wet_forces(Builder& b) {
  const Scene& s = b.scene();
  std::vector<Term> terms{has_failure(s) ? term<CrackedWettedPressure> : term<WettedPressure>};
  if (has_failure(s)) terms.push_back(term<BorneByFluid>);
  terms.push_back(s.terms.viscous.form == ViscosityForm::symmetric ? term<WettedSymmetricViscosity>
                                                                   : term<WettedViscosity>);
  if (s.terms.artificial_viscosity > 0) terms.push_back(term<WettedArtificialViscosity>);
  b.add_sums("forces", terms);
}

}  // namespace

void add_forces(Builder& b) {
  const Scene& s = b.scene();
  if (has_wet_bodies(s)) return add_wet_forces(b);
  const bool solid = has_updated(s);
  const bool uniform_viscosity =
      std::ranges::all_of(s.groups, [first = std::ranges::find_if(s.groups, is_matter)](const Group& g) {
        return g.kind == GroupKind::grain || (g.viscosity == first->viscosity && !g.viscosity_law.varies());
      });
  const bool jump = tension(s) && s.terms.surface_tension.form == TensionForm::jump;
  const bool symmetric = s.terms.viscous.form == ViscosityForm::symmetric;
  const bool uniform = uniform_viscosity && !solid && !weighted(s) && !tension(s) && !symmetric;
  std::vector<Term> terms{slips(s)      ? term<SlippingStress>
                          : solid       ? term<StressDivergence>
                          : weighted(s) ? term<WeightedPressure>
                                        : term<Pressure>};
  if (!s.terms.viscous.implicit)
    terms.push_back(uniform     ? term<UniformViscosity>
                    : symmetric ? term<SymmetricViscosity>
                                : term<Viscosity>);
  if (tension(s))
    terms.push_back(!jump         ? term<SurfaceTension>
                    : weighted(s) ? term<WeightedTensionJump>
                                  : term<TensionJump>);
  if (s.terms.artificial_viscosity > 0) terms.push_back(term<ArtificialViscosity>);
  b.add_sums("forces", terms);
}

}  // namespace sph
