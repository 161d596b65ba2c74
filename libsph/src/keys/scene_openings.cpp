// [[inlet]], [[insertion]], [[outlet]] and domain.leaves.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "keys/scene_resolve.hpp"
#include "keys/scene_writer.hpp"
#include "keys/time_curve.hpp"

namespace sph {
namespace {

constexpr std::array axis_names{"x", "y", "z"};
constexpr double settles_in = 1000;  // h / c: a pulse of 40 h leaves all but 4 %

std::string face_name(std::size_t face) { return fmt::format("{}{}", axis_names[face / 2], face % 2); }

template <class Table, class Box>
void check_box(const Table& table, const Box& box, const Scene& scene, bool all_inside) {
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    if (!(box.lower[a] < box.upper[a]))
      table.fail("upper", fmt::format("is not above lower in {}", axis_names[a]), "the box is empty");
    if (!all_inside && (box.lower[a] >= scene.domain.upper[a] || box.upper[a] <= scene.domain.lower[a]))
      table.fail("lower", fmt::format("all of the box lies outside the domain in {}", axis_names[a]),
                 "nothing comes into it: move it");
    const double rounding = 1e-9 * (scene.domain.upper[a] - scene.domain.lower[a]);
    if ((all_inside || scene.domain.periodic[a]) &&
        (box.lower[a] < scene.domain.lower[a] - rounding || box.upper[a] > scene.domain.upper[a] + rounding))
      table.fail("lower", fmt::format("the box lies outside the domain in {}", axis_names[a]),
                 "enlarge domain.lower or domain.upper");
  }
}

/// Of a box whose fluid is led along it.
template <class Table, class Box>
void check_direction(const Table& table, const Box& box, const Scene& scene) {
  const std::size_t a = axis_of(box.direction);
  if (a >= static_cast<std::size_t>(scene.dim))
    table.fail("direction", "is along z in a scene of two dimensions", "give one along x or y");
  if (scene.domain.periodic[a])
    table.fail("direction", fmt::format("is along the period in {}", axis_names[a]),
               "what flows in or out needs an axis without period");
  const double length = box.upper[a] - box.lower[a];
  if (length < scene.kernel_radius() * (1 - 1e-9))
    table.fail("upper", fmt::format("makes the box {:.6g} m long in {}", length, axis_names[a]),
               fmt::format("the kernel reaches {:.6g} m: it must be as long", scene.kernel_radius()));
}

Inlet read_inlet(const Reader<keys::inlet>& table, const Scene& scene) {
  Inlet inlet;
  table.read(inlet);
  check_box(table, inlet, scene, true);
  check_direction(table, inlet, scene);
  const std::size_t a = axis_of(inlet.direction);
  const double layers = (inlet.upper[a] - inlet.lower[a]) / scene.start.spacing;
  if (std::fabs(layers - std::round(layers)) > 1e-6 * layers)
    table.fail("upper", fmt::format("makes the box {:.6g} spacings long in {}", layers, axis_names[a]),
               "it must be a whole number of them, so that layers follow on layers");
  if (scene.start.lattice.kind != LatticeKind::square)
    table.fail("lower", "is of a box that is no square lattice", "set start.lattice = \"square\"");
  table.not_both("velocity", "pressure");
  inlet.velocity = read_curve(table.value("velocity"), dimension::speed);
  inlet.pressure = read_curve(table.value("pressure"), dimension::pressure);
  if (inlet.velocity.empty() && inlet.pressure.empty())
    table.fail_missing("velocity", "give it, or pressure");
  for (const auto& [t, v] : inlet.velocity)
    if (!(v >= 0))
      table.fail("velocity", fmt::format("is {} m/s", v), "it must be 0 or more: turn the direction round");
  const Group& g = scene.groups[static_cast<std::size_t>(inlet.group)];
  if (g.kind != GroupKind::fluid)
    table.fail("group", fmt::format("\"{}\" is no fluid", g.name), "name a group with kind = \"fluid\"");
  const double fastest = 10 * std::sqrt(g.eos.bulk_modulus / g.density);
  for (const auto& [t, v] : inlet.velocity)
    if (!(v <= fastest))
      table.fail("velocity", fmt::format("is {:.6g} m/s", v),
                 fmt::format("it must be at most {:.6g} m/s, ten times the speed of sound", fastest));
  table.only_if(scene.has_heat() && g.heat.temperature.has_value(), "temperature",
                "there is no heat: give group.heat");
  table.only_if(g.eos.law->kind == EosKind::bubbly, "gas_content",
                "the group has no gas: set eos = \"bubbly\"");
  if (inlet.gas_content) {
    Group with = g;
    with.bubbly.gas_content = *inlet.gas_content;
    try {
      with.eos.law->check(with);
    } catch (const InputError& error) {
      table.fail("gas_content", fmt::format("is too much for \"{}\"", g.name), error.what());
    }
  }
  table.finish();
  return inlet;
}

/// How long what comes with this velocity is in the box, at most [s]; infinite if nothing takes it out.
double time_to_leave(const Insertion& in, const Double3& gravity) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < 3; ++a) {
    // From one end to the other, L = v t + g t^2 / 2, without a difference of what is nearly the same; or up against
    // gravity and back.
    const double length = in.upper[a] - in.lower[a], v = std::fabs(in.velocity[a]);
    const double g = in.velocity[a] < 0    ? -gravity[a]
                     : in.velocity[a] == 0 ? std::fabs(gravity[a])
                                           : gravity[a];
    const double square = v * v + 2 * g * length;
    if (g < 0 && square < 0)
      least = std::fmin(least, (v + std::sqrt(v * v - 2 * g * length)) / -g);
    else if (v > 0 || g > 0)
      least = std::fmin(least, 2 * length / (v + std::sqrt(square)));
  }
  return least;
}

Insertion read_insertion(const Reader<keys::insertion>& table, const Scene& scene) {
  Insertion in;
  table.read(in);
  check_box(table, in, scene, true);
  const Group& g = scene.groups[static_cast<std::size_t>(in.group)];
  if (!(g.grain.largest_radius > 0) || g.grain.fixed)
    table.fail("group", fmt::format("\"{}\" {}", g.name, g.grain.fixed ? "is fixed" : "has no diameter"),
               "name a group of grains that move");
  for (std::size_t a = 0; a < 3; ++a)
    if (!(in.upper[a] - in.lower[a] >= 2 * g.grain.largest_radius))
      table.fail("upper",
                 fmt::format("makes the box {:.6g} m long in {}", in.upper[a] - in.lower[a], axis_names[a]),
                 fmt::format("a grain of {:.6g} m must fit in", 2 * g.grain.largest_radius));
  in.rate = read_curve(table.value("rate"), dimension::mass_rate);
  for (const auto& [t, rate] : in.rate)
    if (!(rate >= 0)) table.fail("rate", fmt::format("is {} kg/s", rate), "it must be 0 or more");
  if (!table.has("every")) {
    in.every = time_to_leave(in, scene.domain.gravity);
    if (!std::isfinite(in.every))
      table.fail_missing(
          "every", "neither velocity nor gravity takes the grains out of the box: say how often they come");
  }
  if (!(in.every >= 1e-12))
    table.fail("every", fmt::format("is {:.3g} s", in.every), "shorter than any step: give 1e-12 s or more");
  table.finish();
  return in;
}

Outlet read_outlet(const Reader<keys::outlet>& table, const Scene& scene) {
  Outlet outlet;
  for (const Group& g : scene.groups)
    if (g.kind == GroupKind::fluid)
      outlet.settle_time = std::fmax(outlet.settle_time, settles_in * scene.kernel.smoothing_length /
                                                             std::sqrt(g.eos.bulk_modulus / g.density));
  const double usual = outlet.settle_time;
  table.read(outlet);
  outlet.pressure = read_curve(table.value("pressure"), dimension::pressure);
  if (table.has("every") && !(outlet.every >= 1e-12))
    table.fail("every", fmt::format("is {:.3g} s", outlet.every),
               "shorter than any step: give 1e-12 s or more");
  const bool led = !outlet.pressure.empty();
  if (led) table.require("direction");
  const std::string_view deletes = "the outlet has no pressure: what comes into it is deleted";
  table.only_if(led || outlet.direction == Outlet{}.direction, "direction", deletes);
  table.only_if(led || outlet.settle_time == usual, "settle_time", deletes);
  check_box(table, outlet, scene, led);
  if (led) check_direction(table, outlet, scene);
  for (std::size_t face = 0; outlet.every > 0 && face < 6; ++face) {
    const std::size_t a = face / 2;
    const bool beyond =
        face % 2 == 0 ? outlet.lower[a] < scene.domain.lower[a] : outlet.upper[a] > scene.domain.upper[a];
    if (beyond && !scene.domain.periodic[a] && !scene.domain.openings.deletes[face])
      table.fail("every", fmt::format("lets grains wait beyond {}, where they end the run", face_name(face)),
                 fmt::format("add \"{}\" to domain.leaves, or leave it out", face_name(face)));
  }
  table.finish();
  return outlet;
}

}  // namespace

void read_leaves(const DomainReader& table, Scene& scene) {
  const std::optional<KeyValue> value = table.value("leaves");
  if (!value) return;
  const auto axes = static_cast<std::size_t>(scene.dim);
  const toml_tree::Array* faces = value->node().array();
  if (faces == nullptr) {
    const std::string word = value->text();
    if (word != "stop" && word != "delete") value->fail_word(word, {"stop", "delete"});
    for (std::size_t face = 0; face < 2 * axes; ++face)
      scene.domain.openings.deletes[face] = word == "delete" && !scene.domain.periodic[face / 2];
    return;
  }
  std::vector<std::string> names;
  for (std::size_t face = 0; face < 2 * axes; ++face)
    if (!scene.domain.periodic[face / 2]) names.push_back(face_name(face));
  for (const toml_tree::Node& n : *faces) {
    const auto* name = std::get_if<std::string>(&n.value);
    if (name == nullptr || std::ranges::find(names, *name) == names.end())
      value->fail(name == nullptr ? "holds what is no name" : fmt::format("names \"{}\"", shown(*name)),
                  fmt::format("its faces, on axes without period: {}", fmt::join(names, ", ")));
    for (std::size_t face = 0; face < 2 * axes; ++face)
      if (*name == face_name(face)) scene.domain.openings.deletes[face] = true;
  }
}

void read_openings(const TopReader& top, const DomainReader& domain, Scene& scene) {
  for (const auto& table : top.tables<keys::insertion>())
    scene.domain.openings.insertions.push_back(read_insertion(table, scene));
  for (const auto& table : top.tables<keys::inlet>())
    scene.domain.openings.inlets.push_back(read_inlet(table, scene));
  for (const auto& table : top.tables<keys::outlet>())
    scene.domain.openings.outlets.push_back(read_outlet(table, scene));
  if (!scene.domain.openings.any() || scene.of_grains()) return;
  const auto refuse = [&](bool where, std::string_view what) {
    if (!where) return;
    const std::string why = fmt::format("is of liquids and bubbly fluids that move, {}", what);
    if (!scene.domain.openings.inlets.empty()) top.fail("inlet", why, "remove it");
    if (!scene.domain.openings.outlets.empty()) top.fail("outlet", why, "remove it");
    domain.fail("leaves", why, "remove it");
  };
  refuse(scene.terms.formulation == Formulation::ida, "and formulation = \"ida\" has none");
  refuse(has_eos(scene, EosKind::ideal_gas), "and the scene has an ideal gas");
  refuse(has_dry_bodies(scene), "and the scene has total-Lagrangian solids alone");
  refuse(!scene.terms.exchange.motion, "and terms.motion is false");
}

void write_leaves(SceneWriter& out, const Domain& domain) {
  std::vector<std::string> names;
  for (std::size_t face = 0; face < domain.openings.deletes.size(); ++face)
    if (domain.openings.deletes[face]) names.push_back(SceneWriter::quoted(face_name(face)));
  out.raw("leaves", fmt::format("[{}]", fmt::join(names, ", ")));
}

void write_openings(SceneWriter& out, const Domain& domain) {
  for (const Inlet& inlet : domain.openings.inlets) {
    out.table(keys::inlet, inlet);
    write_curve(out, "velocity", inlet.velocity);
    write_curve(out, "pressure", inlet.pressure);
  }
  for (const Insertion& insertion : domain.openings.insertions) {
    out.table(keys::insertion, insertion);
    write_curve(out, "rate", insertion.rate);
  }
  for (const Outlet& outlet : domain.openings.outlets) {
    out.table(keys::outlet, outlet);
    write_curve(out, "pressure", outlet.pressure);
  }
}

}  // namespace sph
