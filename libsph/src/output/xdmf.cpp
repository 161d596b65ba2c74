// XDMF 2 as ParaView's "XDMF Reader" and both "Xdmf3 Reader"s take it: a temporal collection of Polyvertex
// grids whose data items point into the snapshot files, and one of the cells of melts as a mesh. A mesh in two
// dimensions is one cell thick, below z = 0: the readers put meshes that have no thickness into the plane of y and z.
// Hyperslabs of data sets would do without views in the files, but "Xdmf3 Reader" crashes on them.
#include <fmt/format.h>

#include <iterator>

#include "files/durable_file.hpp"
#include "output/vertices.hpp"
#include "sph/core/error.hpp"
#include "sph/output/snapshot.hpp"

namespace sph {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

struct Item {
  std::string name;
  Type type;
  int components;
  bool vector;
};

std::vector<Item> items_of(FieldSet fields, int dim, const std::vector<ExtraColumn>& extra) {
  std::vector<Item> out;
  for (Field f : fields.list()) {
    const FieldInfo& i = info(f);
    if (i.snapshot && f != Field::position)
      out.push_back({std::string(i.name), i.type, components(i.shape, dim), i.shape == Shape::vector});
  }
  for (const ExtraColumn& e : extra) out.push_back({e.name, Type::f64, e.components, e.components == dim});
  return out;
}

/// Matrix keeps any number of components as they are; of Tensor6 the readers expect different orders.
std::string_view attribute_type(const Item& item) {
  if (item.components == 1) return "Scalar";
  return item.vector ? "Vector" : "Matrix";
}

std::string_view number_type(Type type) {
  switch (type) {
    case Type::f64:
      return R"(NumberType="Float" Precision="8")";
    case Type::i64:
    case Type::u64:  // XDMF 2 knows no unsigned 8-byte integer
      return R"(NumberType="Int" Precision="8")";
    case Type::u32:
      return R"(NumberType="UInt" Precision="4")";
  }
  return {};
}

/// `shape`: of the data set's rows.
std::string data_item(const SnapshotEntry& entry, const Item& item, const std::string& shape,
                      std::string_view group) {
  const std::string dimensions = item.components == 1 ? shape : fmt::format("{} {}", shape, item.components);
  return fmt::format(R"(<DataItem Format="HDF" Dimensions="{}" {}>{}:{}{}</DataItem>)", dimensions,
                     number_type(item.type), escaped(entry.file), group, escaped(item.name));
}

/// Particles of one snapshot: where their data sets are, and those of their vertices.
struct Points {
  std::string_view group, of_vertices;
  std::int64_t rows;
};

std::string grid_of(const SnapshotEntry& entry, const Points& points, int dim,
                    const std::vector<Item>& items) {
  std::string out;
  const auto to = std::back_inserter(out);
  const std::string rows = fmt::to_string(points.rows);
  const Type vertices = vertex_type(static_cast<std::uint64_t>(entry.rows));
  fmt::format_to(to, "   <Grid Name=\"step {}\" GridType=\"Uniform\">\n", entry.step);
  fmt::format_to(to, "    <Time Value=\"{}\"/>\n", entry.time);
  fmt::format_to(to,
                 "    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
                 "NodesPerElement=\"1\">{}</Topology>\n",
                 rows, data_item(entry, {"vertex", vertices, 1, false}, rows, points.of_vertices));
  fmt::format_to(to, "    <Geometry GeometryType=\"{}\">{}</Geometry>\n", dim == 2 ? "XY" : "XYZ",
                 data_item(entry, {"position", Type::f64, dim, true}, rows, points.group));
  for (const Item& item : items)
    fmt::format_to(to, "    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                   escaped(item.name), attribute_type(item), data_item(entry, item, rows, points.group));
  return out + "   </Grid>\n";
}

std::string grid_of(const SnapshotEntry& entry, const CellMesh& mesh, int dim,
                    const std::vector<Item>& items) {
  const auto& [x, y, z] = mesh.cells;
  const auto three = [](double a, double b, double c) {
    return fmt::format(
        R"(<DataItem Format="XML" Dimensions="3" NumberType="Float" Precision="8">{} {} {}</DataItem>)", a, b,
        c);
  };
  const bool flat = dim == 2;
  const double thick = flat ? mesh.edge[0] : mesh.edge[2];
  std::string out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "   <Grid Name=\"step {}\" GridType=\"Uniform\">\n", entry.step);
  fmt::format_to(to, "    <Time Value=\"{}\"/>\n", entry.time);
  fmt::format_to(to, "    <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"{} {} {}\"/>\n", z + 1, y + 1,
                 x + 1);
  fmt::format_to(to, "    <Geometry GeometryType=\"ORIGIN_DXDYDZ\">{}{}</Geometry>\n",
                 three(flat ? -thick : mesh.origin[2], mesh.origin[1], mesh.origin[0]),
                 three(thick, mesh.edge[1], mesh.edge[0]));
  const std::string shape = fmt::format("{} {} {}", z, y, x);
  for (const Item& item : items) {
    const std::string name = item.name == "velocity" ? "velocity_on_lower_faces" : item.name;
    fmt::format_to(to, "    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Cell\">{}</Attribute>\n",
                   name, attribute_type(item), data_item(entry, item, shape, "/cells/"));
  }
  return out + "   </Grid>\n";
}

/// Grids of all times.
template <class GridOf>
std::string collection(std::string_view name, const std::vector<SnapshotEntry>& entries,
                       GridOf&& grid_of_entry) {
  std::string out =
      fmt::format("  <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", name);
  for (const SnapshotEntry& entry : entries) out += grid_of_entry(entry);
  return out + "  </Grid>\n";
}

std::string collections(const std::vector<SnapshotEntry>& entries, const Particles& particles,
                        const std::vector<ExtraColumn>& extra, const std::optional<CellMesh>& mesh) {
  const int dim = particles.dim();
  if (!mesh)
    return collection("particles", entries,
                      [&, items = items_of(particles.fields(), dim, extra)](const auto& e) {
                        return grid_of(e, {"/particles/", "/", e.rows}, dim, items);
                      });
  std::string out =
      collection("cells", entries, [&, items = items_of(mesh->cell_fields, dim, {})](const auto& e) {
        return grid_of(e, *mesh, dim, items);
      });
  if (entries.empty() || entries.back().rows == mesh->count()) return out;
  return out + collection("particles", entries,
                          [&, items = items_of(mesh->particle_fields, dim, extra)](const auto& e) {
                            return grid_of(e, {"/others/", "/others/", e.rows - mesh->count()}, dim, items);
                          });
}

}  // namespace

void write_xdmf(const std::filesystem::path& path, const std::vector<SnapshotEntry>& entries,
                const Particles& particles, const std::vector<ExtraColumn>& extra,
                const std::optional<CellMesh>& mesh) {
  const std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n <Domain>\n" +
                           collections(entries, particles, extra, mesh) + " </Domain>\n</Xdmf>\n";
  try {
    write_atomically(path, text);
  } catch (const std::exception& error) {
    throw OutputError("cannot write " + path.string() + ": " + error.what());
  }
}

}  // namespace sph
