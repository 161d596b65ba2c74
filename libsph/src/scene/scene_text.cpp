// The resolved scene as TOML: what keys/ cannot write alone stands here.
#include <fmt/format.h>

#include <cstddef>

#include "scene/scene_writer.hpp"

namespace sph {
namespace {

void write_group(SceneWriter& out, const Group& g) {
  out.table(keys::group, g);
  if (g.clamps >= 0)
    out.group("clamps", g.clamps);
  else if (g.kind == GroupKind::wall && g.slip)
    out.raw("slip", "true");
  else if (g.kind == GroupKind::wall)
    out.vector("velocity", g.wall_velocity);
  if (g.fragmentation_void_fraction)
    out.raw("fragmentation",
            fmt::format("{{ void_fraction = {}, group = {} }}",
                        SceneWriter::real(*g.fragmentation_void_fraction), out.name_of(g.fragments_to)));
}

void write_start(SceneWriter& out, const Scene& scene) {
  const Start& s = scene.start;
  out.header(keys::start);
  out.number("spacing", scene.spacing);
  out.keys(keys::start, s);
  if (const auto& n = s.tile.repeat; !s.tile.file.empty())
    out.raw("tile", fmt::format("{{ file = {}, repeat = [{}, {}, {}] }}", SceneWriter::quoted(s.tile.file),
                                n[0], n[1], n[2]));
  const bool velocity_of_file = scene.of_grains() && (!s.file.empty() || !s.tile.file.empty());
  if (s.velocity == InitialVelocity::uniform)
    out.vector("velocity", s.uniform_velocity);
  else if (!velocity_of_file)
    out.text("velocity", s.velocity == InitialVelocity::rest ? "rest" : "taylor_green");
  for (const Layer& layer : s.layers) {
    out.table(keys::layer, layer);
    out.group("group", layer.group);
  }
  for (const Region& region : s.regions) {
    out.table(keys::region, region);
    out.group("group", region.group);
  }
}

void write_terms(SceneWriter& out, Terms terms) {
  if (!terms.implicit_viscosity) terms.viscosity_tolerance = 0;  // not written
  out.table(keys::terms, terms);
  if (const InterfaceTension& t = terms.surface_tension; t.between[0] >= 0)
    out.raw(
        "surface_tension",
        fmt::format("{{ between = [{}, {}], coefficient = {}, form = {} }}", out.name_of(t.between[0]),
                    out.name_of(t.between[1]), SceneWriter::real(t.coefficient),
                    SceneWriter::quoted(keys::word_of(keys::one_of<TensionForm>, static_cast<int>(t.form)))));
}

void write_fluids_and_solids(SceneWriter& out, const Scene& scene) {
  out.table(keys::kernel, scene);
  for (const Group& g : scene.groups) write_group(out, g);
  write_start(out, scene);
  write_terms(out, scene.terms);
}

void write_output(SceneWriter& out, const Scene& scene) {
  out.table(keys::output, scene.output);
  for (const Monitor& m : scene.output.monitors) {
    out.table(keys::monitor, m);
    if (m.kind == MonitorKind::group) out.group("group", m.group);
    if (m.kind == MonitorKind::wall) out.text("wall", scene.walls[static_cast<std::size_t>(m.wall)].name);
  }
}

}  // namespace

std::string to_toml(const Scene& scene) {
  SceneWriter out(scene);
  out.keys(keys::top, scene);
  out.table(keys::domain, scene);
  if (scene.central_pull > 0) out.vector("pull_centre", scene.pull_centre);
  if (scene.of_grains()) {
    write_grains(out, scene);
    write_start(out, scene);
  } else {
    write_fluids_and_solids(out, scene);
  }
  TimeControl time = scene.time;
  if (time.dt) time.cfl = 0;  // not written
  out.table(keys::time, time);
  out.table(keys::decomposition, scene.decomposition);
  out.raw("cut_axes", fmt::format("[{}]", fmt::join(scene.decomposition.cut_axes, ", ")));
  write_output(out, scene);
  return out.take();
}

}  // namespace sph
