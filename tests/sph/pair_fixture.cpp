#include "pair_fixture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/random.hpp"

namespace sph::test {
namespace {

constexpr double dx = 0.02, h_over_dx = 1.2;
const std::vector<bool> are_walls{false, false, false, true, true};  // light, heavy, solid, wall, clamp
constexpr double fastest = 1.5;                                      // of any component of a velocity

/// In (-1, 1), by particle, and not the same for two components of a field.
double uniform(std::uint64_t number, Field field, int k) {
  return uniform_minus_one_to_one(
      20270101, number * 4096 + static_cast<std::uint64_t>(field) * 32 + static_cast<std::uint64_t>(k), 0);
}

Scene scene_for(const Fusion& fusion) {
  const auto needs = [&](Value v) { return fusion.values.has(v); };
  Scene s;
  s.dim = fusion.dim;
  s.terms.precision = fusion.precision;
  s.kernel.shape = fusion.kernel;
  s.start.spacing = dx;
  s.kernel.smoothing_length = h_over_dx * dx;
  for (std::size_t a = 0; a < 3; ++a)
    s.domain.lower[a] = -0.3 - 0.1 * static_cast<double>(a), s.domain.upper[a] = 3;
  s.domain.gravity = {1.7, -8.9, 2.3};
  s.domain.background.density = 400;
  s.domain.central_pull = 2.9;
  s.domain.pull_centre = {0.11, -0.07, 0.23};
  s.groups.resize(5);
  constexpr double density[]{900, 1500, 2300, 1900, 2300}, sound[]{11, 17, 23, 19, 23};
  constexpr double viscosity[]{0.7, 2.9, 1.3, 0, 0};
  for (std::size_t g = 0; g < s.groups.size(); ++g) {
    s.groups[g].kind = g == solid ? GroupKind::solid : g < solid ? GroupKind::fluid : GroupKind::wall;
    s.groups[g].density = density[g];
    s.groups[g].eos.bulk_modulus = density[g] * sound[g] * sound[g];
    s.groups[g].viscosity = viscosity[g];
    s.groups[g].heat.material.specific_heat = 900 + 100 * static_cast<double>(g);
    s.groups[g].heat.material.conductivity = 2 + 3 * static_cast<double>(g);
    s.groups[g].bubbly.permeability.coefficient =
        1.3 - 0.5 * static_cast<double>(g);  // solids and walls: none
    s.groups[g].bubbly.water_diffusivity = g < solid ? 1e-3 * (1 + 6 * static_cast<double>(g)) : 0.0;
    s.groups[g].bubbly.gas_rt = 3000 + 500 * static_cast<double>(g);
  }
  s.groups[solid].bubbly.permeability.coefficient = 0;
  s.groups[wall].heat.temperature = 800;
  s.groups[wall].wall.gas_pressure = 300;
  if (needs(Value::wall_transfer)) {
    s.groups[clamp].heat.transfer = {90, 700};
    s.groups[clamp].heat.radiation = {0.7, 900};
  } else {
    s.groups[clamp].heat.wall_flux = 70;
  }
  s.groups[clamp].wall.slip = true;
  s.groups[solid].solid.shear_modulus = 0.4 * s.groups[solid].eos.bulk_modulus;
  s.groups[clamp].wall.clamps = solid;
  if (needs(Value::reference) || needs(Value::wet_pressure) || needs(Value::own_head))
    s.groups[solid].solid.lagrangian = Lagrangian::total;
  if (needs(Value::crack)) s.terms.bonds.reach = 1.9;
  if (needs(Value::width)) s.kernel.least_growth = 0.8, s.kernel.largest_growth = 1.3;
  s.terms.density_diffusion = 0.13;
  s.terms.artificial_viscosity = 0.6;
  s.terms.gas.quadratic_viscosity = 1.1;
  s.terms.gas.conduction = 0.4;
  s.terms.surface_tension = {{light, heavy}, 0.9, TensionForm::jump};
  return s;
}

FieldSet fields_read(const Fusion& fusion, const PairOptions& options) {
  FieldSet fields = fields_behind(fusion.values);
  if (fusion.values.has(Value::wall_slope)) fields |= {Field::wall_slope};
  if (!options.local_sound) fields = fields.without({Field::sound_speed});
  return fields;
}

FieldSet fields_there(const Fusion& fusion, const PairOptions& options) {
  FieldSet fields = fields_read(fusion, options) | fusion.writes |
                    FieldSet{Field::id, Field::group};  // of which lists are made
  if (!options.poisoned) return fields;
  for (const FieldInfo& i : field_table)
    if (i.field != Field::sound_speed) fields |= {i.field};
  return fields;
}

}  // namespace

std::vector<Placed> jittered_lattice(int dim) {
  const std::array<int, 3> n = dim == 2 ? std::array<int, 3>{18, 6, 1} : std::array<int, 3>{8, 4, 4};
  std::vector<Placed> all;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) {
        const std::uint64_t number = all.size();
        const auto random = [&](int c) { return uniform(number, Field::position, c); };
        Placed p{{i + 0.2 * random(0), j + 0.2 * random(1), k + 0.2 * random(2)}, light};
        const double lot = 0.5 + 0.5 * random(3);
        p.group = 4 * i < n[0] ? (lot < 0.7 ? wall : clamp) : lot < 0.35 ? light : lot < 0.7 ? heavy : solid;
        all.push_back(p);
      }
  return all;
}

std::vector<Placed> isolated_pairs(int dim) {
  std::vector<Placed> all;
  for (int k = 0; k < 250; ++k) {
    const auto n = static_cast<std::uint64_t>(k);
    Placed one{{8.0 * (k % 18), 8.0 * (k / 18), 0}, static_cast<std::uint32_t>(k % 5)};
    Placed other = one;
    other.group = static_cast<std::uint32_t>(k / 5 % 5);
    for (int a = 0; a < dim; ++a)
      other.x[static_cast<std::size_t>(a)] += 0.3 + 0.5 * uniform(n, Field::spin, a);
    all.push_back(one);
    all.push_back(other);
  }
  return all;
}

PairCase::PairCase(const Fusion& fusion, const std::vector<Placed>& placed, const PairOptions& options)
    : fusion_(fusion),
      scene_(scene_for(fusion)),
      constants_(scene_, position_scale(scene_)),
      particles_(fusion.dim, fields_there(fusion, options)),
      read_(fields_read(fusion, options)),
      lists_(lanes_of(fusion.precision), {true, true, false, false, false}),
      row_of_(placed.size()) {
  const auto class_of = [&](std::uint64_t number) -> std::size_t {
    const double lot = uniform(number, Field::id, 0);
    if (options.halo && lot > 0.6) return 4;
    return (lot < -0.3 ? 2u : 0u) + (is_wall(placed[number].group) ? 1u : 0u);
  };
  const auto key = [&](std::uint64_t number) { return uniform_minus_one_to_one(options.shuffle, number, 3); };
  std::vector<std::uint64_t> order(placed.size());
  std::iota(order.begin(), order.end(), 0u);
  // As placed, so that blocks without walls occur, or in no order at all.
  std::stable_sort(order.begin(), order.end(), [&](std::uint64_t a, std::uint64_t b) {
    if (class_of(a) != class_of(b)) return class_of(a) < class_of(b);
    return options.shuffle != 1 && key(a) < key(b);
  });
  for (std::size_t c = 0; c < ranges_.size(); ++c) {
    const auto below = [&](std::size_t than) {
      return static_cast<std::size_t>(
          std::ranges::count_if(order, [&](std::uint64_t n) { return class_of(n) < than; }));
    };
    ranges_[c] = {below(c), below(c + 1), 0};
  }
  particles_.table().resize(ranges_[3].last, placed.size() - ranges_[3].last);
  for (std::size_t row = 0; row < order.size(); ++row) {
    row_of_[order[row]] = row;
    fill(row, order[row], placed[order[row]]);
  }
  build_lists(1);
  for (const FieldInfo& i : field_table) {
    if (!particles_.has(i.field) || (read_.has(i.field) && !fusion_.writes.has(i.field))) continue;
    if (!options.poisoned && (i.field == Field::id || i.field == Field::group)) continue;  // of lists to come
    for (std::size_t row = 0; row < particles_.rows(); ++row) set(i.field, row, NAN);
  }
  if (options.poisoned) {
    const std::size_t words = (particles_.rows() + 16) * static_cast<std::size_t>(fusion.row_bytes) / 8 + 64;
    rows_.resize(words * 8);
    for (std::size_t k = 0; k < words; ++k) std::memcpy(rows_.data() + 8 * k, &poison_bits, 8);
  }
}

void PairCase::set(Field field, std::size_t row, double value) {
  const std::size_t bytes = width(field, particles_.dim()), each = sph::bytes(info(field).type);
  const std::uint64_t bits = std::isnan(value) ? poison_bits : std::bit_cast<std::uint64_t>(value);
  std::byte* at = particles_.table().column(particles_.column(field)).data() + row * bytes;
  for (std::size_t k = 0; k < bytes; k += each)
    std::memcpy(at + k, each == 4 ? "\xff\xff\xff\xff" : reinterpret_cast<const char*>(&bits), each);
}

void PairCase::fill(std::size_t row, std::uint64_t number, const Placed& at) {
  const auto d = static_cast<std::size_t>(particles_.dim());
  const Group& g = scene_.groups[at.group];
  const double h = scene_.kernel.smoothing_length;
  const bool still = is_wall(at.group), beside = at.group == light || at.group == heavy;
  const bool far = at.x[0] > 11;  // from the interface, whoever is there
  const bool faint = uniform(number, Field::colour_gradient, 9) > 0.8;
  // mean + spread u, or no number where nobody may look
  const auto numbers = [&](Field field, double mean, double spread, bool known = true) {
    if (!particles_.has(field)) return;
    double* to = particles_.table().as<double>(particles_.column(field));
    const int n = components(info(field).shape, particles_.dim());
    if (!known) set(field, row, NAN);
    for (int k = 0; k < n && known; ++k)
      to[row * static_cast<std::size_t>(n) + static_cast<std::size_t>(k)] =
          mean + spread * uniform(number, field, k);
  };
  particles_.data<Field::id>()[row] =
      (std::bit_cast<std::uint64_t>(uniform(number, Field::id, 1)) & 0xffffffffffu) * 512 + number;
  particles_.data<Field::group>()[row] = at.group;
  for (std::size_t a = 0; a < d; ++a) {
    particles_.data<Field::position>()[row * d + a] = constants_.scale.quanta(at.x[a] * dx);
    if (particles_.has(Field::displacement))
      particles_.data<Field::displacement>()[row * d + a] =
          constants_.scale.quanta(0.03 * dx * uniform(number, Field::displacement, static_cast<int>(a)));
  }
  numbers(Field::velocity, 0, fastest);
  numbers(Field::density, g.density, 0.1 * g.density);
  numbers(Field::mass, g.density * std::pow(dx, fusion_.dim), 0.1 * g.density * std::pow(dx, fusion_.dim));
  numbers(Field::specific_energy, still ? 0 : 50, still ? 0 : 20);
  numbers(Field::smoothing_length, still ? h : 1.05 * h, still ? 0 : 0.25 * h);
  numbers(Field::stress, 0, 3000);
  numbers(Field::pressure, 1000, 4000);
  const double sound = std::sqrt(g.eos.bulk_modulus / g.density);
  numbers(Field::sound_speed, sound, 0.2 * sound);
  numbers(Field::kernel_correction, 1, 0.1, !still);
  numbers(Field::velocity_gradient, 0, 40, !still);
  numbers(Field::colour_gradient, 0, far ? 0 : (faint ? 0.01 : 0.3) / h,
          beside || fusion_.values.has(Value::capillary));
  numbers(Field::wall_pressures, 1000, 4000, still);
  numbers(Field::bond_stress, 0, 3000);
  numbers(Field::clamp_shift, 0, at.group == clamp ? 0.03 * dx : 0);
  numbers(Field::clamp_reaction, 0, 20, still);
  numbers(Field::wet_pressure, 1000, 4000);
  numbers(Field::wet_velocity, 0, fastest);
  numbers(Field::flux, 0, 1);
  numbers(Field::acceleration, 0, 20);
  numbers(Field::direction, 0, fastest);
  numbers(Field::wall_slope, 0, uniform(number, Field::wall_slope, 9) > 0 ? 1 : 0,
          row < particles_.owned() && !still);
  numbers(Field::curvature, 0, 0.5 / h, beside);
  numbers(Field::temperature, 1000, 300);
  numbers(Field::viscosity, 1.5, 1.4);
  numbers(Field::gas_mobility, 0.5, 0.4);
  numbers(Field::gas_pressure, 6000, 4000);
  numbers(Field::trial, 6000, 4000);
  numbers(Field::gas_content, 0.05, 0.03);
  numbers(Field::dissolved_gas, 0.04, 0.03);
  numbers(Field::crack, 0, uniform(number, Field::crack, 9) > -0.5 ? 1 : 0);
  numbers(Field::crack_distance, 0, 0.5);
  numbers(Field::crack_closing, 0.1, 0.1);
  if (particles_.has(Field::overload))  // some are alike
    particles_.data<Field::overload>()[row] = std::round(2 * uniform(number, Field::overload, 0));
  if (particles_.has(Field::failing))
    particles_.data<Field::failing>()[row] = uniform(number, Field::failing, 0) > 0 ? 1 : 0;
}

// Pairs are taken where they were half a step ago, at most `back` farther apart.
void PairCase::build_lists(double widened, bool walls_list_walls) {
  leaves_out_ = false;
  const double back = fastest * std::sqrt(3.0) * dt();
  const double range = widened * (scene_.list_range() + back);
  if (fusion_.values.has(Value::width)) {
    std::vector<double> reach(particles_.rows());
    const double* h = particles_.data<Field::smoothing_length>();
    for (std::size_t i = 0; i < reach.size(); ++i)  // of walls, and beside them, not less than h wide
      reach[i] = widened * 3 * std::fmax(h[i], scene_.kernel.smoothing_length) / quantum() + 1;
    lists_.all.build(particles_, reach, ranges_, timers_);
  } else {
    decomp::Int3 length{};
    for (std::size_t a = 0; a < 3; ++a)
      length[a] = constants_.scale.quanta(scene_.domain.upper[a]) - constants_.scale.origin[a];
    const std::int64_t radius = constants_.scale.quanta(range) + 1;
    const decomp::CellGrid grid(fusion_.dim, constants_.scale.origin, length, {}, radius);
    lists_.all.build(particles_, grid, {{}, grid.cells()}, radius, ranges_, timers_, PartnerOrder::by_id,
                     walls_list_walls ? nullptr : &are_walls);
  }
}

void PairCase::leave_out() {
  leaves_out_ = true;
  lists_.walls.build(particles_, lists_.all, ranges_, are_walls);
  if (particles_.has(Field::displacement))
    lists_.bonds.build(particles_, lists_.all, ranges_, constants_.longest_bond(),
                       constants_.groups.bodies.number);
  lists_.fluid.forget();
  lists_.fluid.look_at_interior(particles_, lists_.all, ranges_);
  lists_.fluid.look_at_boundary(particles_, lists_.all, ranges_);
}

PassContext PairCase::context() {
  PassContext c = constants_.context(particles_, lists_.all, rows_, dt());
  if (leaves_out_ && lists_.bonds.blocks() > 0) c.bonds = &lists_.bonds;
  if (leaves_out_) c.walls = &lists_.walls;
  if (leaves_out_) c.fluid = &lists_.fluid;
  return c;
}
void PairCase::pack() { fusion_.pack(context(), 0, particles_.rows()); }
void PairCase::repack() { fusion_.repack(context(), 0, particles_.rows()); }
void PairCase::run() {
  for (const RowRange& range : ranges_) fusion_.run(context(), range);
}

std::vector<std::uint64_t> PairCase::bits(const std::vector<bool>& wanted) const {
  std::vector<std::uint64_t> all;
  for (std::size_t number = 0; number < row_of_.size(); ++number) {
    const std::size_t row = row_of_[number];
    if (row >= particles_.owned() || !wanted[number]) continue;
    for (const Field f : fusion_.writes.list()) {
      const auto n = static_cast<std::size_t>(components(info(f).shape, fusion_.dim));
      const double* sums = particles_.table().as<double>(particles_.column(f));
      for (std::size_t k = 0; k < n; ++k) all.push_back(std::bit_cast<std::uint64_t>(sums[row * n + k]));
    }
  }
  return all;
}

std::string title_of(const Fusion& fusion) {
  std::string text =
      std::to_string(fusion.dim) + (fusion.precision == Precision::mixed ? "D mixed " : "D double ");
  text += fusion.kernel == KernelShape::quintic       ? "Quintic"
          : fusion.kernel == KernelShape::wendland_c2 ? "WendlandC2"
                                                      : "WendlandC4";
  for (const Term t : fusion.terms) text += (t == fusion.terms.front() ? ": " : ", ") + std::string(t.name);
  return text;
}

}  // namespace sph::test
