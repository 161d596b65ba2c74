// The resolved scene as TOML: what keys/ cannot write alone stands here.
#include <fmt/format.h>

#include <cstddef>

#include "keys/prescribed_motion.hpp"
#include "keys/scene_writer.hpp"
#include "keys/time_curve.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/terms/added_term.hpp"

namespace sph {
namespace {

void write_start_motion(SceneWriter& out, const RigidMaterial& body, int dim) {
  std::vector<std::string> held;
  for (std::size_t k = 0; k < body.held.size(); ++k)
    if (body.held[k]) held.push_back(SceneWriter::quoted(keys::motion_names[k]));
  if (!held.empty()) out.raw("held", fmt::format("[{}]", fmt::join(held, ", ")));
  if (body.spin && dim == 2)
    out.number("start_spin", (*body.spin)[2]);
  else if (body.spin)
    out.vector("start_spin", *body.spin);
}

void write_group(SceneWriter& out, const Group& g, int dim) {
  out.table(keys::group, g);
  write_start_motion(out, g.solid.body, dim);
  for (std::size_t k = 0; k < g.eos.law->keys.size(); ++k)
    out.number(g.eos.law->keys[k].name, g.eos.constants[k]);
  if (g.kind == GroupKind::wall && g.wall.slip)
    out.raw("slip", "true");
  else if (g.kind == GroupKind::wall && g.wall.clamps < 0)
    out.vector("velocity", g.wall.velocity);
  if (g.bubbly.permeability.coefficient > 0) out.table(keys::permeability, g.bubbly.permeability);
  if (g.viscosity_law.varies()) out.table(keys::viscosity_law, g.viscosity_law);
  if (g.solid.strength) out.table(keys::strength, *g.solid.strength);
  if (const auto& motion = g.solid.body.motion) {
    out.table(keys::motion, *motion);
    write_motion(out, *motion);
  }
  if (g.heat.material.specific_heat > 0) out.table(keys::heat, g.heat.material);
  if (g.heat.transfer.coefficient > 0) out.table(keys::heat_transfer, g.heat.transfer);
  if (g.heat.radiation.emissivity > 0) out.table(keys::radiation, g.heat.radiation);
  for (const Transition& row : g.becomes) out.table(keys::becomes, row);
}

void write_start(SceneWriter& out, const Scene& scene) {
  const Start& s = scene.start;
  out.header(keys::start);
  if (!scene.has_melt()) out.number("spacing", s.spacing);
  out.keys(keys::start, s);
  const bool velocity_of_file = scene.of_grains() && (!s.file.empty() || !s.tile.file.empty());
  if (s.velocity.kind == InitialVelocity::uniform)
    out.vector("velocity", s.velocity.uniform);
  else if (!velocity_of_file)
    out.text("velocity", s.velocity.kind == InitialVelocity::rest ? "rest" : "taylor_green");
  if (!s.tile.file.empty()) out.table(keys::tile, s.tile);
  for (const Layer& layer : s.layers) out.table(keys::layer, layer);
  for (const Region& region : s.lattice.regions) {
    out.table(keys::region, region);
    write_curve(out, "points", region.points);  // pairs of numbers too
  }
  for (const GrainFill& fill : s.fills) out.table(keys::fill, fill);
}

void write_terms(SceneWriter& out, Terms terms) {
  const ExchangeTerms& exchange = terms.exchange;
  if (!terms.viscous.implicit) terms.viscous.tolerance = 0;  // not written
  if (!exchange.implicit_conduction && !exchange.implicit_gas_flow) terms.exchange.tolerance = 0;  // nor that
  out.table(keys::terms, terms);
  for (std::size_t k = 0; k < terms.added.size(); ++k)
    if (terms.added[k] > 0) out.number(added_terms()[k]->word, terms.added[k]);
  if (terms.surface_tension.between[0] >= 0) out.table(keys::surface_tension, terms.surface_tension);
}

void write_melt(SceneWriter& out, const MeltControl& melt) {
  out.table(keys::melt_table, melt);
  for (const MeltSide& side : melt.sides) out.table(keys::melt_side, side);
}

void write_output(SceneWriter& out, const Scene& scene) {
  out.table(keys::output, scene.output);
  for (const Monitor& m : scene.output.monitors) out.table(keys::monitor, m);
}

}  // namespace

std::string to_toml(const Scene& scene) {
  SceneWriter out(scene);
  out.keys(keys::top, scene);
  out.table(keys::domain, scene.domain);
  if (scene.domain.central_pull > 0) out.vector("pull_centre", scene.domain.pull_centre);
  if (scene.domain.background.density > 0 && has_eos(scene, EosKind::bubbly))
    out.number("background_surface", scene.domain.background.surface);
  if (scene.domain.openings.any()) write_leaves(out, scene.domain);
  if (scene.has_matter()) out.table(keys::kernel, scene.kernel);
  if (scene.has_grains()) write_contacts(out, scene);
  if (scene.has_grains_in_flow()) write_drag(out, scene);
  for (const Group& g : scene.groups)
    if (g.kind == GroupKind::grain)
      write_material(out, g, *scene.grains.contact.law);
    else
      write_group(out, g, scene.dim);
  if (scene.has_grains()) write_walls(out, scene);
  write_meshes(out, scene);
  if (scene.has_melt()) write_melt(out, scene.domain.melt);
  for (const Reset& box : scene.domain.resets) {
    out.table(keys::reset, box);
    write_curve(out, "inflow", box.inflow);
  }
  write_openings(out, scene.domain);
  write_start(out, scene);
  if (scene.has_matter()) write_terms(out, scene.terms);
  TimeControl time = scene.time;
  if (time.dt) time.cfl = 0;  // not written
  out.table(keys::time, time);
  out.table(keys::decomposition, scene.decomposition);
  out.raw("cut_axes", fmt::format("[{}]", fmt::join(scene.decomposition.cut_axes, ", ")));
  write_output(out, scene);
  return out.take();
}

}  // namespace sph
