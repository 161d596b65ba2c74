// The resolved scene as TOML.
#include <fmt/format.h>

#include <cstddef>

#include "scene/scene_writer.hpp"
#include "sph/added_term.hpp"
#include "sph/eos/law.hpp"

namespace sph {
namespace {

void write_group(SceneWriter& out, const Scene& scene, const Group& g) {
  out.header("[[group]]");
  out.text("name", g.name);
  out.text("kind", word(group_kind_words(), g.kind));
  out.text("eos", word(eos_words(), g.eos));
  out.number("density", g.density);
  if (g.eos->kind == EosKind::ideal_gas) {
    out.number("heat_ratio", g.heat_ratio);
    out.number("start_pressure", g.start_pressure);
  } else {
    out.number("bulk_modulus", g.bulk_modulus);
  }
  for (std::size_t k = 0; k < g.eos->keys.size(); ++k) out.number(g.eos->keys[k].name, g.eos_constants[k]);
  out.number("viscosity", g.viscosity);
  if (g.eos->kind != EosKind::ideal_gas) out.number("bulk_viscosity", g.bulk_viscosity);
  if (g.kind == GroupKind::solid) {
    out.number("shear_modulus", g.shear_modulus);
    out.text("lagrangian", word(lagrangian_words(), g.lagrangian));
  }
  if (g.clamps >= 0)
    out.text("clamps", scene.groups[static_cast<std::size_t>(g.clamps)].name);
  else if (g.kind == GroupKind::wall && g.slip)
    out.flag("slip", true);
  else if (g.kind == GroupKind::wall)
    out.vector("velocity", g.wall_velocity);
  if (g.eos->kind != EosKind::bubbly) return;
  out.number("gas_content", g.gas_content);
  out.number("gas_rt", g.gas_rt);
  out.number("solubility_pressure", g.solubility_pressure);
  out.number("solubility_exponent", g.solubility_exponent);
  if (g.fragmentation_void_fraction)
    out.raw(
        "fragmentation",
        fmt::format("{{ void_fraction = {}, group = {} }}", SceneWriter::real(*g.fragmentation_void_fraction),
                    SceneWriter::quoted(scene.groups[static_cast<std::size_t>(g.fragments_to)].name)));
}

void write_region(SceneWriter& out, const Scene& scene, const Region& r) {
  out.header("[[start.region]]");
  out.text("group", r.group < 0 ? "none" : scene.groups[static_cast<std::size_t>(r.group)].name);
  out.text("shape", word(region_words(), r.shape));
  if (r.shape == RegionShape::box) {
    out.vector("lower", r.lower);
    out.vector("upper", r.upper);
  } else if (r.shape == RegionShape::ball) {
    out.vector("centre", r.centre);
    out.number("radius", r.radius);
  }
}

void write_velocity(SceneWriter& out, const Start& s) {
  switch (s.velocity) {
    case InitialVelocity::rest:
      out.text("velocity", "rest");
      break;
    case InitialVelocity::uniform:
      out.vector("velocity", s.uniform_velocity);
      break;
    case InitialVelocity::taylor_green:
      out.text("velocity", "taylor_green");
      break;
  }
}

void write_flow(SceneWriter& out, const Start& s) {
  out.number("flow_speed", s.flow_speed);
  out.number("flow_length", s.flow_length);
  switch (s.pressure) {
    case InitialPressure::zero:
      out.text("pressure", "zero");
      break;
    case InitialPressure::hydrostatic:
      out.text("pressure", "hydrostatic");
      break;
    case InitialPressure::taylor_green:
      out.text("pressure", "taylor_green");
      break;
  }
}

void write_start(SceneWriter& out, const Scene& scene) {
  const Start& s = scene.start;
  out.header("[start]");
  out.number("spacing", scene.spacing);
  if (!s.tile.file.empty()) {
    const auto& n = s.tile.repeat;
    out.raw("tile", fmt::format("{{ file = {}, repeat = [{}, {}, {}] }}", SceneWriter::quoted(s.tile.file),
                                n[0], n[1], n[2]));
  } else if (s.file.empty()) {
    out.text("lattice", word(lattice_words(), s.lattice));
    out.vector("origin", s.lattice_origin);
    out.vector("lower", s.lower);
    out.vector("upper", s.upper);
    out.number("jitter", s.jitter);
  } else {
    out.text("file", s.file);
    if (s.free_surface) out.flag("free_surface", *s.free_surface);
  }
  out.whole("seed", s.seed);
  const bool velocity_of_file = scene.of_grains() && (!s.file.empty() || !s.tile.file.empty());
  if (!velocity_of_file) write_velocity(out, s);
  if (!scene.of_grains()) write_flow(out, s);
  for (const Layer& layer : s.layers) {
    out.header("[[start.layer]]");
    out.text("group", scene.groups[static_cast<std::size_t>(layer.group)].name);
    out.number("top", layer.top);
  }
  for (const Region& r : s.regions) write_region(out, scene, r);
}

void write_fluids_and_solids(SceneWriter& out, const Scene& scene) {
  if (scene.central_pull > 0) {
    out.number("central_pull", scene.central_pull);
    out.vector("pull_centre", scene.pull_centre);
  }
  out.number("surface_pressure", scene.surface_pressure);
  out.header("[kernel]");
  out.text("shape", word(kernel_words(), scene.kernel));
  out.number("smoothing_length", scene.smoothing_length);
  if (scene.has_eos(EosKind::ideal_gas)) {
    out.number("least_growth", scene.least_growth);
    out.number("largest_growth", scene.largest_growth);
  }
  for (const Group& g : scene.groups) write_group(out, scene, g);
  write_start(out, scene);
  out.header("[terms]");
  out.number("density_diffusion", scene.terms.density_diffusion);
  out.number("artificial_viscosity", scene.terms.artificial_viscosity);
  out.flag("shifting", scene.terms.shifting);
  if (scene.total_lagrangian()) {
    out.number("hourglass", scene.terms.hourglass);
    out.number("largest_stretch", scene.terms.largest_stretch);
    return;
  }
  if (scene.formulation == Formulation::ida) return;
  if (scene.has_eos(EosKind::ideal_gas)) {
    out.number("quadratic_viscosity", scene.terms.quadratic_viscosity);
    out.number("artificial_conduction", scene.terms.conduction);
    return;
  }
  out.text("viscosity", word(viscosity_words(), scene.terms.viscosity));
  for (std::size_t k = 0; k < scene.terms.added.size(); ++k)
    if (scene.terms.added[k] > 0) out.number(added_terms()[k]->word, scene.terms.added[k]);
  if (scene.has_kind(GroupKind::solid)) return;
  out.flag("implicit_viscosity", scene.terms.implicit_viscosity);
  if (scene.terms.implicit_viscosity) out.number("viscosity_tolerance", scene.terms.viscosity_tolerance);
  out.text("pressure_weights", word(pressure_weights_words(), scene.terms.pressure_weights));
  if (const InterfaceTension& t = scene.terms.surface_tension; t.between[0] >= 0) {
    const auto name = [&](int k) {
      return SceneWriter::quoted(scene.groups[static_cast<std::size_t>(k)].name);
    };
    out.raw("surface_tension",
            fmt::format("{{ between = [{}, {}], coefficient = {}, form = {} }}", name(t.between[0]),
                        name(t.between[1]), SceneWriter::real(t.coefficient),
                        SceneWriter::quoted(word(tension_form_words(), t.form))));
  }
}

void write_physics(SceneWriter& out, const Scene& scene) {
  out.header("[domain]");
  out.vector("lower", scene.lower);
  out.vector("upper", scene.upper);
  std::string periodic;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    periodic += fmt::format("{}{}", a == 0 ? "" : ", ", scene.periodic[a]);
  out.raw("periodic", fmt::format("[{}]", periodic));
  out.vector("gravity", scene.gravity);
  if (scene.of_grains()) {
    write_grains(out, scene);
    write_start(out, scene);
  } else {
    write_fluids_and_solids(out, scene);
  }
  out.header("[time]");
  if (scene.time.dt)
    out.number("dt", *scene.time.dt);
  else if (!scene.of_grains())
    out.number("cfl", scene.time.cfl);
  if (scene.time.until) out.number("until", *scene.time.until);
  if (scene.time.steps) out.whole("steps", *scene.time.steps);
}

void write_decomposition(SceneWriter& out, const Decomposition& d) {
  out.header("[decomposition]");
  out.raw("cut_axes", fmt::format("[{}, {}]", d.cut_axes[0], d.cut_axes[1]));
  out.number("skin", d.skin);
  out.whole("rebuild_every", d.rebuild_every);
  out.flag("overlap", d.overlap);
  out.text("balance", word(cut_rule_words(), d.cuts));
  out.text("cost", word(cost_words(), d.cost));
  out.whole("chaos_seed", d.chaos_seed);
  out.whole("slow_rank", d.slow_rank);
  out.number("slowness", d.slowness);
  if (!d.record.empty()) out.text("record", d.record);
  if (!d.replay.empty()) out.text("replay", d.replay);
}

void write_output(SceneWriter& out, const Scene& scene) {
  const OutputControl& o = scene.output;
  out.header("[output]");
  out.number("snapshot_interval", o.snapshot_interval);
  out.number("series_interval", o.series_interval);
  out.number("checkpoint_interval", o.checkpoint_interval);
  out.number("status_interval", o.status_interval);
  out.number("average_time", o.average_time);
  if (scene.of_grains())
    out.flag("contacts", o.contacts);
  else
    out.flag("average_space", o.average_space);
  out.whole("sort_limit", o.sort_limit);
  out.whole("checkpoint_files", o.checkpoint_files);
  for (const Monitor& m : o.monitors) {
    out.header("[[monitor]]");
    out.text("name", m.name);
    out.text("kind", word(monitor_words(), m.kind));
    if (m.id) out.whole("id", *m.id);
    if (m.nearest_to) out.vector("nearest_to", *m.nearest_to);
    if (m.kind == MonitorKind::group) out.text("group", scene.groups[static_cast<std::size_t>(m.group)].name);
    if (m.kind == MonitorKind::wall) out.text("wall", scene.walls[static_cast<std::size_t>(m.wall)].name);
  }
}

}  // namespace

std::string to_toml(const Scene& scene) {
  SceneWriter out(scene.dim);
  out.text("title", scene.name);
  out.whole("dimension", scene.dim);
  if (!scene.of_grains()) {
    out.text("formulation", word(formulation_words(), scene.formulation));
    out.text("precision", word(precision_words(), scene.precision));
  }
  write_physics(out, scene);
  write_decomposition(out, scene.decomposition);
  write_output(out, scene);
  return out.take();
}

}  // namespace sph
