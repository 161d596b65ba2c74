// The resolved scene as TOML. Numbers are the shortest texts that read back to the same bits.
#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "scene/scene_resolve.hpp"

namespace sph {
namespace {

template <class E>
std::string_view word(const Choices<E>& words, E value) {
  for (const auto& [name, v] : words)
    if (v == value) return name;
  return {};
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (code < 0x20 || code == 0x7f)
      out += fmt::format("\\u{:04X}", code);
    else
      out += c;
  }
  return out + '"';
}

/// Always a TOML float: an integer "-0" would lose its sign.
std::string real(double x) {
  std::string text = fmt::format("{}", x);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

class Writer {
 public:
  explicit Writer(int dim) : dim_(dim) {}
  void header(std::string_view text) { out_ += fmt::format("\n{}\n", text); }
  void raw(std::string_view key, std::string_view value) { out_ += fmt::format("{} = {}\n", key, value); }
  void text(std::string_view key, std::string_view value) { raw(key, quoted(value)); }
  void number(std::string_view key, double x) { raw(key, real(x)); }
  template <class I>
  void whole(std::string_view key, I n) {
    raw(key, fmt::format("{}", n));
  }
  void flag(std::string_view key, bool on) { raw(key, on ? "true" : "false"); }
  void vector(std::string_view key, const Double3& x) {
    std::string list;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim_); ++a)
      list += (a == 0 ? "" : ", ") + real(x[a]);
    raw(key, fmt::format("[{}]", list));
  }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  int dim_;
  std::string out_;
};

void write_group(Writer& out, const Scene& scene, const Group& g) {
  out.header("[[group]]");
  out.text("name", g.name);
  out.text("kind", word(group_kind_words(), g.kind));
  out.text("eos", word(eos_words(), g.eos));
  out.number("density", g.density);
  out.number("bulk_modulus", g.bulk_modulus);
  out.number("viscosity", g.viscosity);
  out.number("bulk_viscosity", g.bulk_viscosity);
  if (g.kind == GroupKind::solid) out.number("shear_modulus", g.shear_modulus);
  if (g.kind == GroupKind::wall) out.vector("velocity", g.wall_velocity);
  if (g.eos != EosKind::bubbly) return;
  out.number("gas_content", g.gas_content);
  out.number("gas_rt", g.gas_rt);
  out.number("solubility_pressure", g.solubility_pressure);
  out.number("solubility_exponent", g.solubility_exponent);
  if (g.fragmentation_void_fraction)
    out.raw("fragmentation",
            fmt::format("{{ void_fraction = {}, group = {} }}", real(*g.fragmentation_void_fraction),
                        quoted(scene.groups[static_cast<std::size_t>(g.fragments_to)].name)));
}

void write_region(Writer& out, const Scene& scene, const Region& r) {
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

void write_start(Writer& out, const Scene& scene) {
  const Start& s = scene.start;
  out.header("[start]");
  out.number("spacing", scene.spacing);
  if (s.file.empty()) {
    out.text("lattice", word(lattice_words(), s.lattice));
    out.vector("origin", s.lattice_origin);
    out.vector("lower", s.lower);
    out.vector("upper", s.upper);
    out.number("jitter", s.jitter);
  } else {
    out.text("file", s.file);
  }
  out.whole("seed", s.seed);
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
  out.number("surface_height", s.surface_height);
  for (const Region& r : s.regions) write_region(out, scene, r);
}

void write_physics(Writer& out, const Scene& scene) {
  out.header("[domain]");
  out.vector("lower", scene.lower);
  out.vector("upper", scene.upper);
  std::string periodic;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    periodic += fmt::format("{}{}", a == 0 ? "" : ", ", scene.periodic[a]);
  out.raw("periodic", fmt::format("[{}]", periodic));
  out.vector("gravity", scene.gravity);
  out.number("surface_pressure", scene.surface_pressure);
  out.header("[kernel]");
  out.text("shape", word(kernel_words(), scene.kernel));
  out.number("smoothing_length", scene.smoothing_length);
  for (const Group& g : scene.groups) write_group(out, scene, g);
  write_start(out, scene);
  out.header("[terms]");
  out.number("density_diffusion", scene.terms.density_diffusion);
  out.number("artificial_viscosity", scene.terms.artificial_viscosity);
  out.flag("shifting", scene.terms.shifting);
  out.header("[time]");
  if (scene.time.dt)
    out.number("dt", *scene.time.dt);
  else
    out.number("cfl", scene.time.cfl);
  if (scene.time.until) out.number("until", *scene.time.until);
  if (scene.time.steps) out.whole("steps", *scene.time.steps);
}

void write_decomposition(Writer& out, const Decomposition& d) {
  out.header("[decomposition]");
  out.raw("cut_axes", fmt::format("[{}, {}]", d.cut_axes[0], d.cut_axes[1]));
  out.number("skin", d.skin);
  out.whole("rebuild_every", d.rebuild_every);
  out.flag("overlap", d.overlap);
  out.text("balance", word(cut_rule_words(), d.cuts));
  out.text("cost", word(cost_words(), d.cost));
  out.whole("chaos_seed", d.chaos_seed);
  if (!d.record.empty()) out.text("record", d.record);
  if (!d.replay.empty()) out.text("replay", d.replay);
}

void write_output(Writer& out, const Scene& scene) {
  const OutputControl& o = scene.output;
  out.header("[output]");
  out.number("snapshot_interval", o.snapshot_interval);
  out.number("series_interval", o.series_interval);
  out.number("checkpoint_interval", o.checkpoint_interval);
  out.number("status_interval", o.status_interval);
  out.number("average_time", o.average_time);
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
  }
}

}  // namespace

std::string to_toml(const Scene& scene) {
  Writer out(scene.dim);
  out.text("title", scene.name);
  out.whole("dimension", scene.dim);
  out.text("formulation", word(formulation_words(), scene.formulation));
  out.text("precision", word(precision_words(), scene.precision));
  write_physics(out, scene);
  write_decomposition(out, scene.decomposition);
  write_output(out, scene);
  return out.take();
}

}  // namespace sph
