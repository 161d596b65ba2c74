#include <algorithm>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>

#include "decomp/memory.hpp"
#include "files/fill_file.hpp"
#include "files/packed_rows.hpp"
#include "files/sorted_table.hpp"
#include "files/tensor_order.hpp"
#include "output/vertices.hpp"
#include "sph/files/provenance.hpp"
#include "sph/output/snapshot.hpp"

namespace sph {
namespace {

constexpr std::size_t conversion_rows = std::size_t{1} << 20;

std::vector<Field> fields_of(const Particles& particles) {
  std::vector<Field> out;
  for (Field f : particles.fields().list())
    if (info(f).snapshot) out.push_back(f);
  return out;
}

/// The columns to write, in a table of their own: they are about to be sorted. Column k holds field k, the
/// id first as in the field table, then follow the extra columns, whose values are taken away.
decomp::Table copy(const Particles& particles, const std::vector<Field>& fields, const Wrap& wrap,
                   std::vector<ExtraColumn>& extra) {
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
    if (info(f).shape == Shape::symmetric && particles.dim() == 3)
      exchange_yz_xz(reinterpret_cast<double*>(column.data()), particles.owned());
    if (f != Field::position) continue;
    auto* x = reinterpret_cast<std::int64_t*>(column.data());
    for (std::size_t row = 0; row < particles.owned(); ++row)
      for (int a = 0; a < particles.dim(); ++a, ++x) *x = wrap(a, *x);
  }
  for (ExtraColumn& e : extra) {
    decomp::Column& column = table.column(to++);
    const std::span<const std::byte> from = std::as_bytes(std::span(e.values));
    if (from.size() != particles.owned() * column.width())
      throw std::logic_error("column " + e.name + " of the snapshot does not have one value per owned row");
    if (!from.empty()) std::memcpy(column.data(), from.data(), from.size());
    decomp::release(e.values);
  }
  return table;
}

/// Contacts as a table; id and partner come first, for the sort.
decomp::Table table_of(ContactColumns contacts) {
  decomp::Table table;
  const std::size_t rows = contacts.id.size();
  const auto add = [&](const std::string& name, const auto& values, std::size_t components) {
    if (values.size() != components * rows)
      throw std::logic_error("contacts of the snapshot: " + name + " does not have one value per contact");
    table.add_column(name, 8 * components);
  };
  add("id", contacts.id, 1);
  add("partner", contacts.partner, 1);
  add("point", contacts.point, 3);
  add("force", contacts.force, 3);
  add("overlap", contacts.overlap, 1);
  table.resize(rows, 0);
  int to = 0;
  const auto fill = [&](auto& values) {
    decomp::Column& column = table.column(to++);
    if (!values.empty()) std::memcpy(column.data(), values.data(), rows * column.width());
    decomp::release(values);
  };
  fill(contacts.id);
  fill(contacts.partner);
  fill(contacts.point);
  fill(contacts.force);
  fill(contacts.overlap);
  return table;
}

std::vector<DataSet> contact_sets(std::uint64_t rows) {
  return {{"contacts/id", Element::u64, rows, 1, "1", "the lower id of the two, or the grain at a wall"},
          {"contacts/partner", Element::u64, rows, 1, "1", "the higher id, or 2^63 + index of the wall"},
          {"contacts/point", Element::f64, rows, 3, "m", "middle of the overlap, or on the wall"},
          {"contacts/force", Element::f64, rows, 3, "N",
           "on id: elastic normal force at the present overlap and tangential spring, no dashpots"},
          {"contacts/overlap", Element::f64, rows, 1, "m", "r_i + r_j - distance"}};
}

/// A table as it goes into the file: sorted unless it is too long, with this rank's place in it.
struct Placed {
  decomp::Table table;
  std::int64_t all_rows = 0;
  std::uint64_t first = 0, rows = 0;

  void place(const decomp::Comm& comm, std::int64_t sort_limit, int keys, bool in_chunks) {
    all_rows = comm.sum(static_cast<std::int64_t>(table.owned()));
    if (all_rows <= sort_limit) sort_by_id(comm, table, keys);
    if (in_chunks && all_rows > 0) share_out(comm, table, static_cast<std::int64_t>(chunk_rows));
    rows = static_cast<std::uint64_t>(table.owned());
    first = static_cast<std::uint64_t>(comm.exclusive_sum(static_cast<std::int64_t>(rows)));
  }
  /// The table's columns are the data sets from `set` on.
  void write(RowSink& out, std::size_t set) const {
    for (int c = 0; c < table.columns(); ++c) out.write(set++, first, rows, table.column(c).data());
  }
};

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
                   std::string(i.unit), std::string(i.meaning),
                   i.shape == Shape::symmetric ? components_in_files(dim) : std::string()});
  }
  for (const ExtraColumn& e : extra)
    out.push_back({"particles/" + e.name, Element::f64, rows, e.components, e.unit, "not state: for output",
                   e.component_names});
  out.push_back({"particles/position", Element::f64, rows, dim, "m", "position"});
  return out;
}

/// Cells and other particles apart. Of the sets the last two are the position in metres and the vertices.
std::vector<DataView> views_of(const CellMesh& mesh, const std::vector<DataSet>& sets,
                               const std::vector<Field>& fields) {
  const auto count = static_cast<std::uint64_t>(mesh.count());
  const std::size_t vertex = sets.size() - 1, metres = vertex - 1;
  if (sets[metres].rows < count)
    throw std::logic_error("the snapshot has fewer rows than its mesh has cells");
  const std::uint64_t others = sets[metres].rows - count;
  std::vector<std::uint64_t> shape;
  for (std::size_t a = 3; a-- > 0;) shape.push_back(static_cast<std::uint64_t>(mesh.cells[a]));

  std::vector<DataView> out;
  const auto add = [&](const std::string& group, std::size_t set, std::uint64_t first,
                       const std::vector<std::uint64_t>& as) {
    out.push_back({group + sets[set].name.substr(sets[set].name.find('/') + 1), set, first, as});
  };
  for (std::size_t k = 0; k < metres; ++k) {
    const bool extra = k >= fields.size();
    if (!extra && fields[k] == Field::position) continue;
    if (!extra && mesh.cell_fields.has(fields[k])) add("cells/", k, 0, shape);
    if (others > 0 && (extra || mesh.particle_fields.has(fields[k]))) add("others/", k, count, {others});
  }
  add("cells/", metres, 0, shape);
  if (others == 0) return out;
  add("others/", metres, count, {others});
  add("others/", vertex, 0, {others});
  return out;
}

void write_metres(RowSink& out, std::size_t set, int dim, std::uint64_t first, std::uint64_t rows,
                  const std::int64_t* quanta, const PositionScale& scale) {
  const auto d = static_cast<std::size_t>(dim);
  std::vector<double> metres;
  for (std::uint64_t done = 0; done < rows;) {
    const std::uint64_t n = std::min<std::uint64_t>(conversion_rows, rows - done);
    metres.resize(n * d);
    for (std::size_t k = 0; k < metres.size(); ++k) metres[k] = scale.metres(quanta[done * d + k]);
    out.write(set, first + done, n, metres.data());
    done += n;
  }
}

template <class T>
void count_rows(RowSink& out, std::size_t set, std::uint64_t first, std::uint64_t rows) {
  std::vector<T> numbers;
  for (std::uint64_t done = 0; done < rows; done += numbers.size()) {
    numbers.resize(std::min<std::uint64_t>(conversion_rows, rows - done));
    std::iota(numbers.begin(), numbers.end(), static_cast<T>(first + done));
    out.write(set, first + done, numbers.size(), numbers.data());
  }
}

}  // namespace

void write_snapshot(const decomp::Comm& comm, const std::filesystem::path& path, const Particles& particles,
                    const GlobalState& global, const PositionScale& scale, const Wrap& wrap,
                    const Provenance& provenance, std::vector<ExtraColumn> extra, std::int64_t sort_limit,
                    std::optional<ContactColumns> contacts, const std::optional<CellMesh>& mesh,
                    int compression) {
  const std::string what = "cannot write " + path.string();
  const std::vector<Field> fields = fields_of(particles);
  Placed rows, touching;
  all_or_none(comm, what, [&] {
    rows.table = copy(particles, fields, wrap, extra);
    if (contacts) touching.table = table_of(std::move(*contacts));
  });
  rows.place(comm, sort_limit, 1, compression > 0);
  std::vector<DataSet> sets =
      data_sets_of(particles.dim(), static_cast<std::uint64_t>(rows.all_rows), fields, extra);
  const std::size_t of_particles = sets.size();  // the last one is the position in metres
  sets.push_back({"vertex", element_of(vertex_type(sets.front().rows)), sets.front().rows, 1, "1",
                  "number of the row: XDMF's vertices"});
  const std::vector<DataView> views = mesh ? views_of(*mesh, sets, fields) : std::vector<DataView>{};
  if (contacts) {
    touching.place(comm, sort_limit, 2, compression > 0);
    for (DataSet& set : contact_sets(static_cast<std::uint64_t>(touching.all_rows)))
      sets.push_back(std::move(set));
  }

  const auto write_rows = [&](RowSink& out) {
    rows.write(out, 0);
    touching.write(out, of_particles + 1);
    sets[of_particles].element == Element::u32
        ? count_rows<std::uint32_t>(out, of_particles, rows.first, rows.rows)
        : count_rows<std::int64_t>(out, of_particles, rows.first, rows.rows);
    const auto position = std::find(fields.begin(), fields.end(), Field::position) - fields.begin();
    if (particles.has(Field::position))
      write_metres(out, of_particles - 1, particles.dim(), rows.first, rows.rows,
                   rows.table.as<std::int64_t>(static_cast<int>(position)), scale);
  };
  std::optional<PackedRows> packed;
  if (compression > 0) {
    all_or_none(comm, what, [&] { write_rows(packed.emplace(sets, compression)); });
    packed->agree_on_sizes(comm);
  }
  const std::filesystem::path temporary = path.string() + ".tmp";
  try {
    std::vector<Extent> extents;
    all_or_none(comm, what, [&] {
      if (comm.rank() == 0)
        extents = lay_out(temporary, attributes_of(particles.dim(), rows.all_rows, global, scale, provenance),
                          sets, views);
    });
    fill_in(comm, comm, temporary, sets, extents, what,
            [&](RowFile& file) { packed ? packed->fill(file) : write_rows(file); });
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
