#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>

#include "decomp/migrate.hpp"
#include "output/fill_file.hpp"
#include "sph/report.hpp"
#include "sph/snapshot.hpp"

namespace sph {
namespace {

constexpr std::size_t conversion_rows = std::size_t{1} << 20;
constexpr int id_column = 0;  // the field table begins with the id

std::vector<Field> fields_of(const Particles& particles) {
  std::vector<Field> out;
  for (Field f : particles.fields().list())
    if (info(f).snapshot) out.push_back(f);
  return out;
}

/// The columns to write, in a table of their own: they are about to be sorted. Column k holds field k, then
/// follow the extra columns.
decomp::Table copy(const Particles& particles, const std::vector<Field>& fields, const Wrap& wrap,
                   const std::vector<ExtraColumn>& extra) {
  decomp::Table table;
  for (Field f : fields) table.add_column(std::string(info(f).name), width(f, particles.dim()));
  for (const ExtraColumn& e : extra)
    table.add_column(e.name, sizeof(double) * static_cast<std::size_t>(e.components));
  table.resize(particles.owned(), 0);

  int to = 0;
  for (Field f : fields) {
    decomp::Column& column = table.column(to++);
    const decomp::Column& from = particles.table().column(particles.column(f));
    if (particles.owned() > 0) std::memcpy(column.data(), from.data(), particles.owned() * column.width());
    if (f != Field::position) continue;
    auto* x = reinterpret_cast<std::int64_t*>(column.data());
    for (std::size_t row = 0; row < particles.owned(); ++row)
      for (int a = 0; a < particles.dim(); ++a, ++x) *x = wrap(a, *x);
  }
  for (const ExtraColumn& e : extra) {
    decomp::Column& column = table.column(to++);
    const std::span<const std::byte> from = std::as_bytes(std::span(e.values));
    if (from.size() != particles.owned() * column.width())
      throw std::logic_error("column " + e.name + " of the snapshot does not have one value per owned row");
    if (!from.empty()) std::memcpy(column.data(), from.data(), from.size());
  }
  return table;
}

/// Rank r gets the r-th of equal ranges of ids, then sorts its rows.
void sort_by_id(const decomp::Comm& comm, decomp::Table& table) {
  const auto* id = table.as<std::uint64_t>(id_column);
  // Flipping the top bit makes the order of int64, which the reduction knows, that of the ids.
  constexpr std::uint64_t top = std::uint64_t{1} << 63;
  const auto key = [](std::uint64_t x) { return static_cast<std::int64_t>(x ^ top); };
  std::int64_t greatest = key(0);
  std::int64_t least_negated = key(0);
  for (std::size_t row = 0; row < table.owned(); ++row) {
    greatest = std::max(greatest, key(id[row]));
    least_negated = std::max(least_negated, key(~id[row]));
  }
  const std::uint64_t last = static_cast<std::uint64_t>(comm.max(greatest)) ^ top;
  const std::uint64_t first = ~(static_cast<std::uint64_t>(comm.max(least_negated)) ^ top);

  if (comm.size() > 1) {
    const std::uint64_t range = (last - first) / static_cast<std::uint64_t>(comm.size()) + 1;
    std::vector<decomp::Rank> owner(table.owned());
    for (std::size_t row = 0; row < owner.size(); ++row)
      owner[row] = static_cast<decomp::Rank>((id[row] - first) / range);
    decomp::redistribute(comm, owner, table, nullptr);
    id = table.as<std::uint64_t>(id_column);
  }
  std::vector<std::uint32_t> order(table.owned());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return id[a] < id[b]; });
  table.reorder(order);
}

std::vector<Attribute> attributes_of(int dim, std::int64_t rows, const GlobalState& global,
                                     const PositionScale& scale, const Provenance& provenance) {
  const BuildInfo& build = build_info();
  return {{"format", std::string("peperite snapshot 1")},
          {"dim", std::int64_t{dim}},
          {"particles", rows},
          {"step", global.step},
          {"time", global.time},
          {"dt", global.dt},
          {"max_speed", global.max_speed},
          {"max_acceleration", global.max_acceleration},
          {"quantum", scale.quantum},
          {"origin", std::vector<std::int64_t>(scale.origin.begin(), scale.origin.end())},
          {"fingerprint", provenance.fingerprint},
          {"group_names", provenance.group_names},
          {"scene", provenance.scene_toml},
          {"version", build.version},
          {"git", build.git},
          {"compiler", build.compiler},
          {"flags", build.flags},
          {"build_type", build.build_type},
          {"mpi", build.mpi},
          {"hdf5", build.hdf5}};
}

/// One data set per column of the table, then the position in metres.
std::vector<DataSet> data_sets_of(int dim, std::uint64_t rows, const std::vector<Field>& fields,
                                  const std::vector<ExtraColumn>& extra) {
  std::vector<DataSet> out;
  for (Field f : fields) {
    const FieldInfo& i = info(f);
    const std::string name = f == Field::position ? "position_quanta" : std::string(i.name);
    out.push_back({"particles/" + name, element_of(i.type), rows, components(i.shape, dim),
                   std::string(i.unit), std::string(i.meaning)});
  }
  for (const ExtraColumn& e : extra)
    out.push_back({"particles/" + e.name, Element::f64, rows, e.components, e.unit, "not state: for output"});
  out.push_back({"particles/position", Element::f64, rows, dim, "m", "position"});
  return out;
}

void write_metres(SharedHdf5File& file, const DataSet& set, std::uint64_t first, std::uint64_t rows,
                  const std::int64_t* quanta, const PositionScale& scale) {
  const auto d = static_cast<std::size_t>(set.components);
  std::vector<double> metres;
  for (std::uint64_t done = 0; done < rows;) {
    const std::uint64_t n = std::min<std::uint64_t>(conversion_rows, rows - done);
    metres.resize(n * d);
    for (std::size_t k = 0; k < metres.size(); ++k) metres[k] = scale.metres(quanta[done * d + k]);
    file.write(set, first + done, n, metres.data());
    done += n;
  }
}

}  // namespace

void write_snapshot(const decomp::Comm& comm, const std::filesystem::path& path, const Particles& particles,
                    const GlobalState& global, const PositionScale& scale, const Wrap& wrap,
                    const Provenance& provenance, const std::vector<ExtraColumn>& extra,
                    std::int64_t sort_limit) {
  const std::string what = "cannot write " + path.string();
  const std::vector<Field> fields = fields_of(particles);
  decomp::Table table;
  all_or_none(comm, what, [&] { table = copy(particles, fields, wrap, extra); });
  const std::int64_t all_rows = comm.sum(static_cast<std::int64_t>(table.owned()));
  if (all_rows <= sort_limit) sort_by_id(comm, table);
  const auto rows = static_cast<std::uint64_t>(table.owned());
  const auto first = static_cast<std::uint64_t>(comm.exclusive_sum(static_cast<std::int64_t>(rows)));

  const std::vector<DataSet> sets =
      data_sets_of(particles.dim(), static_cast<std::uint64_t>(all_rows), fields, extra);
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  try {
    all_or_none(comm, what, [&] {
      if (comm.rank() == 0)
        lay_out(temporary, attributes_of(particles.dim(), all_rows, global, scale, provenance), sets);
    });
    fill_in(comm, comm, temporary, what, [&](SharedHdf5File& file) {
      for (int c = 0; c < table.columns(); ++c)
        file.write(sets[static_cast<std::size_t>(c)], first, rows, table.column(c).data());
      const auto position = std::find(fields.begin(), fields.end(), Field::position) - fields.begin();
      if (particles.has(Field::position))
        write_metres(file, sets.back(), first, rows, table.as<std::int64_t>(static_cast<int>(position)),
                     scale);
    });
    all_or_none(comm, what, [&] {
      if (comm.rank() == 0) rename_durably(temporary, path);
    });
  } catch (const OutputError&) {
    std::error_code ignored;
    if (comm.rank() == 0) std::filesystem::remove(temporary, ignored);
    throw;
  }
}

}  // namespace sph
