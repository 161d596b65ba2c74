// Ideal gases: their keys, and what has no meaning beside them.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "keys/scene_resolve.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {

// Walls are as thick as a kernel that has not grown, and as coarse as one that has not shrunk.
void set_growth(Scene& scene) {
  constexpr double narrowest = 0.05, in_the_open = 3;
  if (!has_eos(scene, EosKind::ideal_gas) || scene.has_kind(GroupKind::wall)) return;
  scene.kernel.least_growth = narrowest;
  scene.kernel.largest_growth = in_the_open;
}

// Where it is not given, kernels grow no wider than short periods have room for: `cells` of them, with a skin
// as is usual. That of the scene must not decide: it may change no bit.
void fit_growth(const KernelReader& kernel, Scene& scene, double cells) {
  if (!has_eos(scene, EosKind::ideal_gas) || kernel.has("largest_growth")) return;
  constexpr double margin = 1 - 1e-9, usual_skin = 0.2;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    if (scene.domain.periodic[a]) {
      const double room = (scene.domain.upper[a] - scene.domain.lower[a]) / (cells * scene.support());
      scene.kernel.largest_growth =
          std::clamp((room - usual_skin) * margin, 1.0, scene.kernel.largest_growth);
    }
}

// Their density is a sum over neighbours, that of other matter an integral over time.
void check_ideal_gas(const TopReader& top, const DomainReader& domain, const StartReader& start,
                     const TermsReader& terms, const Scene& scene) {
  if (!has_eos(scene, EosKind::ideal_gas)) return;
  const std::vector<GroupReader> groups = top.tables<keys::group>();
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (const Group& g = scene.groups[k];
        g.kind != GroupKind::wall && g.eos.law->kind != EosKind::ideal_gas) {
      const std::string_view right = "a scene with ideal gases has no other matter but walls";
      if (g.kind == GroupKind::solid) groups[k].fail("kind", "is \"solid\" beside an ideal gas", right);
      groups[k].fail("eos", fmt::format("is \"{}\" beside an ideal gas", g.eos.law->word), right);
    }
  if (scene.terms.formulation == Formulation::ida)
    top.fail("formulation", "is \"ida\"", "it has no energy equation, which an ideal gas needs");
  if (scene.start.pressure == InitialPressure::hydrostatic ||
      scene.start.pressure == InitialPressure::uniform)
    start.fail("pressure",
               scene.start.pressure == InitialPressure::uniform ? "is \"uniform\"" : "is \"hydrostatic\"",
               "an ideal gas starts from start_pressure, or from the column u of start.file");
  const double speed = scene.start.velocity.flow_speed;
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (const Group& g = scene.groups[k]; scene.start.pressure == InitialPressure::taylor_green &&
                                          g.kind != GroupKind::wall &&
                                          g.eos.gas.start_pressure <= 0.5 * g.density * speed * speed)
      groups[k].fail("start_pressure", fmt::format("is {}", g.eos.gas.start_pressure),
                     "with start.pressure = \"taylor_green\" it must be above rho U^2 / 2");
  if (scene.domain.surface_pressure != 0)
    domain.fail("surface_pressure", "is given", "the pressure of an ideal gas is absolute: remove it");
  if (scene.domain.central_pull != 0)
    domain.fail("central_pull", "is given", "it is for liquids without walls: remove it");
  const auto refuse = [&](bool given, TermsReader::Name<> key, std::string_view what,
                          std::string_view right) {
    if (given) terms.fail(key, what, right);
  };
  refuse(scene.terms.density_diffusion != 0, "density_diffusion", "is given",
         "the density of an ideal gas is a sum over its neighbours: remove it");
  refuse(scene.terms.shifting, "shifting", "is on",
         "particles of an ideal gas are where their mass is: remove it");
  refuse(terms.has("viscosity") && scene.terms.viscous.form != ViscosityForm::laplacian, "viscosity",
         "is \"symmetric\"", "beside an ideal gas it is \"laplacian\"");
  refuse(scene.terms.viscous.implicit, "implicit_viscosity", "is on",
         "the heat of an ideal gas is that of explicit viscosity: remove it");
  refuse(scene.terms.pressure_weights != PressureWeights::volume, "pressure_weights", "is \"density\"",
         "an ideal gas has pressures of its own: remove it");
  refuse(terms.has("surface_tension"), "surface_tension", "is given", "gases have none: remove it");
}

}  // namespace sph
