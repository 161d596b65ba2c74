#include "start/placement_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "decomp/migrate.hpp"
#include "run/agree.hpp"
#include "start/initial_fields.hpp"

namespace sph {
namespace {

bool is_hdf5(const std::string& path) {
  std::array<char, 4> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return std::memcmp(start.data(), "\x89HDF", start.size()) == 0;
}

/// Runs `work` on every rank; throws what it threw in the lowest row of the file, on every rank.
template <class Work>
void in_row_order(const decomp::Comm& comm, const Scene& scene, Work&& work) {
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::int64_t number = none;
  std::string text;
  try {
    work();
  } catch (const RowProblem& problem) {
    number = problem.number;
    text = problem.what();
  } catch (const std::exception& error) {
    number = 0;
    text = error.what();
  }
  const std::int64_t lowest = -comm.max(-number);
  if (lowest == none) return;
  throw InputError(scene.start.file + ": " + agree(comm, number == lowest ? text : std::string()));
}

[[noreturn]] void fail(const StartRows& rows, std::size_t k, const std::string& what) {
  throw RowProblem(rows.number[k], fmt::format("{} {}: {}", rows.unit, rows.number[k], what));
}

void check_finite(const StartRows& rows, std::size_t k, const char* column, const std::vector<double>& values,
                  std::size_t components) {
  if (values.empty()) return;
  for (std::size_t c = 0; c < components; ++c)
    if (!std::isfinite(values[k * components + c])) fail(rows, k, fmt::format("{} is not finite", column));
}

decomp::Int3 quanta_of(const StartRows& rows, std::size_t k, const PositionScale& scale, std::size_t d) {
  decomp::Int3 out{};
  for (std::size_t a = 0; a < d; ++a) {
    if (rows.quanta.empty())
      out[a] = scale.quanta(rows.x[k * d + a]);
    else if (rows.quantum == scale.quantum)
      out[a] = rows.quanta[k * d + a];
    else
      out[a] = scale.quanta(static_cast<double>(rows.quanta[k * d + a]) * rows.quantum);
  }
  return out;
}

void check_row(const StartRows& rows, std::size_t k, const Scene& scene, const PositionScale& scale,
               const decomp::CellGrid& grid) {
  const auto d = static_cast<std::size_t>(scene.dim);
  check_finite(rows, k, "x", rows.x, d);
  check_finite(rows, k, "v", rows.v, d);
  check_finite(rows, k, "rho", rows.rho, 1);
  check_finite(rows, k, "m", rows.gas, 1);
  check_finite(rows, k, "mass", rows.mass, 1);
  check_finite(rows, k, "stress", rows.stress, d * (d + 1) / 2);
  if (rows.group[k] >= scene.groups.size())
    fail(rows, k,
         fmt::format("group {} is not in the scene, which has {}", rows.group[k], scene.groups.size()));
  if (!rows.rho.empty() && !(rows.rho[k] > 0))
    fail(rows, k, fmt::format("rho is {}; it must be positive", rows.rho[k]));
  if (!rows.mass.empty() && !(rows.mass[k] > 0))
    fail(rows, k, fmt::format("mass is {}; it must be positive", rows.mass[k]));
  if (!rows.gas.empty() && !(rows.gas[k] >= 0 && rows.gas[k] < 1))
    fail(rows, k, fmt::format("m is {}; it must be at least 0 and below 1", rows.gas[k]));
  // Far outside, the coordinate in quanta would overflow.
  constexpr double periods = 2;
  for (std::size_t a = 0; a < d && !rows.x.empty(); ++a) {
    const double margin = periods * (scene.upper[a] - scene.lower[a]);
    if (rows.x[k * d + a] < scene.lower[a] - margin || rows.x[k * d + a] > scene.upper[a] + margin)
      fail(rows, k, fmt::format("particle {} lies outside the domain", rows.id[k]));
  }
  if (!grid.inside(grid.wrap(quanta_of(rows, k, scale, d))))
    fail(rows, k, fmt::format("particle {} lies outside the domain", rows.id[k]));
}

void add_particle(const StartRows& rows, std::size_t k, const Scene& scene, const PositionScale& scale,
                  const decomp::CellGrid& grid, Particles& particles) {
  const auto d = static_cast<std::size_t>(scene.dim), n = d * (d + 1) / 2;
  const decomp::Int3 q = grid.wrap(quanta_of(rows, k, scale, d));
  NewParticle p{rows.id[k], {}, {}, rows.group[k], 0, 0};
  for (std::size_t a = 0; a < d; ++a) p.position[a] = scale.metres(q[a]);
  set_initial_fields(scene, p);
  for (std::size_t a = 0; a < d; ++a) p.velocity[a] = rows.v[k * d + a];
  if (!rows.rho.empty()) {
    double volume = 1;
    for (std::size_t a = 0; a < d; ++a) volume *= scene.spacing;
    p.density = rows.rho[k];
    p.mass = p.density * volume;  // as on a lattice, to the bit
  }
  if (!rows.mass.empty()) p.mass = rows.mass[k];
  append(scene, p, q, particles);
  const std::size_t i = particles.owned() - 1;
  if (auto* m = particles.data<Field::gas_content>(); m != nullptr && !rows.gas.empty()) m[i] = rows.gas[k];
  if (auto* s = particles.data<Field::stress>(); s != nullptr && !rows.stress.empty())
    std::copy_n(rows.stress.data() + k * n, n, s + i * n);
}

/// Equal ids meet on one rank.
void check_ids_differ(const decomp::Comm& comm, const Scene& scene, const StartRows& rows) {
  decomp::Table table;
  const int id = table.add_column("id", sizeof(std::uint64_t));
  const int number = table.add_column("number", sizeof(std::int64_t));
  table.resize(rows.id.size(), 0);
  std::vector<decomp::Rank> to;
  for (std::size_t k = 0; k < rows.id.size(); ++k) {
    table.as<std::uint64_t>(id)[k] = rows.id[k];
    table.as<std::int64_t>(number)[k] = rows.number[k];
    to.push_back(static_cast<decomp::Rank>(rows.id[k] % static_cast<std::uint64_t>(comm.size())));
  }
  decomp::redistribute(comm, to, table, nullptr);
  in_row_order(comm, scene, [&] {
    std::vector<std::pair<std::uint64_t, std::int64_t>> all;
    for (std::size_t k = 0; k < table.owned(); ++k)
      all.emplace_back(table.as<std::uint64_t>(id)[k], table.as<std::int64_t>(number)[k]);
    std::sort(all.begin(), all.end());
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    std::string text;
    for (std::size_t k = 1; k < all.size(); ++k)
      if (all[k].first == all[k - 1].first && all[k].second < first) {
        first = all[k].second;
        text = fmt::format("{} {}: id {} was given in {} {} already", rows.unit, first, all[k].first,
                           rows.unit, all[k - 1].second);
      }
    if (!text.empty()) throw RowProblem(first, text);
  });
}

}  // namespace

void place_particles_from_file(const Scene& scene, const PositionScale& scale, Distribution& distribution,
                               Particles& particles) {
  const decomp::Comm& comm = distribution.comm();
  const decomp::CellGrid& grid = distribution.grid();
  StartRows rows;
  in_row_order(comm, scene, [&] {
    rows = is_hdf5(scene.start.file) ? read_hdf5_rows(scene, comm.rank(), comm.size())
                                     : read_csv_rows(scene, comm.rank(), comm.size());
    for (std::size_t k = 0; k < rows.id.size(); ++k) check_row(rows, k, scene, scale, grid);
  });
  check_ids_differ(comm, scene, rows);
  for (std::size_t k = 0; k < rows.id.size(); ++k) add_particle(rows, k, scene, scale, grid, particles);
  distribution.scatter(particles);
}

}  // namespace sph
