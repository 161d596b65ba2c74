// [domain] and [[reset]], and what a background cannot be combined with.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "keys/scene_resolve.hpp"
#include "keys/time_curve.hpp"
#include "sph/laws/eos/law.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};

void read_pull(const DomainReader& table, Scene& scene) {
  table.only_if(scene.domain.central_pull > 0, "pull_centre", "give central_pull too");
  scene.domain.pull_centre = table.vector("pull_centre").value_or(Double3{});
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    if (scene.domain.central_pull > 0 && scene.domain.periodic[a])
      table.fail("central_pull", fmt::format("would jump across the period in {}", axis_names[a]),
                 "use it in domains without periods");
}

/// Of each bubbly fluid that may come by.
void check_content(const Reader<keys::reset>& table, double gas_content, const std::vector<Group>& groups) {
  for (Group g : groups) {
    if (g.kind == GroupKind::grain || g.eos.law->kind != EosKind::bubbly) continue;
    g.bubbly.gas_content = gas_content;
    try {
      g.eos.law->check(g);
    } catch (const InputError& error) {
      table.fail("gas_content", fmt::format("is too much for \"{}\"", g.name), error.what());
    }
  }
}

}  // namespace

void read_domain(const DomainReader& table, Scene& scene) {
  table.read(scene.domain);
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    if (!(scene.domain.lower[a] < scene.domain.upper[a]))
      table.fail("upper", fmt::format("is not above lower in {}", axis_names[a]), "the domain is empty");
  read_pull(table, scene);
  read_leaves(table, scene);
  scene.domain.background.surface = table.number("background_surface").value_or(0);
  table.finish();
}

void read_resets(const TopReader& top, Scene& scene) {
  using Name = Reader<keys::reset>::Name<>;
  for (const auto& table : top.tables<keys::reset>()) {
    Reset box;
    table.read(box);
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
      if (!(box.lower[a] < box.upper[a]))
        table.fail("upper", fmt::format("is not above lower in {}", axis_names[a]), "the box is empty");
      if (box.lower[a] >= scene.domain.upper[a] || box.upper[a] <= scene.domain.lower[a])
        table.fail("lower", fmt::format("all of the box lies outside the domain in {}", axis_names[a]),
                   "nothing comes into it: move it");
    }
    box.inflow = read_curve(table.value("inflow"), dimension::mass_rate);
    for (const auto& [t, rate] : box.inflow)
      if (!(rate >= 0)) table.fail("inflow", fmt::format("is {} kg/s", rate), "it must be 0 or more");
    if (!box.temperature && !box.gas_content && !box.pressure && box.inflow.empty())
      table.fail_missing("temperature", "give it, gas_content, pressure or inflow");
    table.not_both("pressure", "inflow");
    if (box.rise_time > 0 && !box.pressure)
      table.fail("rise_time", fmt::format("is {} s", box.rise_time), "it is of a pressure: give that");
    for (const Name& key : {Name("pressure"), Name("inflow")}) {
      table.only_if(scene.has_kind(GroupKind::fluid) && !has_eos(scene, EosKind::ideal_gas), key,
                    "it is of liquids and bubbly fluids");
      table.only_if(!scene.is_mixture() && scene.terms.exchange.motion, key,
                    "it is of fluids that move, without grains");
    }
    table.only_if(scene.has_heat(), "temperature", "there is no heat: give group.heat");
    table.only_if(has_eos(scene, EosKind::bubbly), "gas_content", "no group has gas: set eos = \"bubbly\"");
    if (box.gas_content) check_content(table, *box.gas_content, scene.groups);
    table.finish();
    scene.domain.resets.push_back(box);
  }
}

void check_background(const DomainReader& domain, const Scene& scene) {
  const bool given = scene.domain.background.density > 0, gas = has_eos(scene, EosKind::bubbly);
  domain.only_if(given && gas, "background_surface",
                 given ? "no bubbly fluid asks for it" : "give background_density too");
  if (!given) return;
  const auto refuse = [&](bool where, std::string_view what, std::string_view why) {
    if (where) domain.fail("background_density", what, why);
  };
  refuse(scene.has_grains(), "is given beside grains", "they do not know its pressure");
  refuse(has_eos(scene, EosKind::ideal_gas), "is given beside an ideal gas",
         "its pressure is absolute: remove it");
  refuse(scene.terms.formulation == Formulation::ida, "is given with formulation = \"ida\"",
         "that has none: remove it");
  refuse(has_strength(scene.groups), "is given with a solid that has strength",
         "its stress is judged without the background's: remove it");
  refuse(has_dry_bodies(scene), "is given with total-Lagrangian solids alone",
         "without a fluid nothing presses on them: remove it");
  refuse(scene.domain.central_pull > 0, "is given with central_pull", "gravity alone presses on it");
  refuse(scene.start.has_surface && !scene.domain.openings.any(), "is given, and there is a free surface",
         "nothing bears the background's pressure there: close the box with walls or periods");
  double weight = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    weight += std::fabs(scene.domain.gravity[a]);
    refuse(gas && scene.domain.periodic[a] && scene.domain.gravity[a] != 0,
           fmt::format("would press on gas along the periodic {}", axis_names[a]),
           "its pressure would jump there: use it across gravity");
  }
  refuse(weight == 0, "is given without gravity", "it has no weight: set domain.gravity");
  if (gas) domain.require("background_surface");
}

}  // namespace sph
