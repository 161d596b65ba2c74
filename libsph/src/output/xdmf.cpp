// XDMF 2 as ParaView's "XDMF Reader" and both "Xdmf3 Reader"s take it: a temporal collection of Polyvertex
// grids whose data items point into the snapshot files.
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

std::vector<Item> items_of(const Particles& particles, const std::vector<ExtraColumn>& extra) {
  std::vector<Item> out;
  for (Field f : particles.fields().list()) {
    const FieldInfo& i = info(f);
    if (i.snapshot && f != Field::position)
      out.push_back(
          {std::string(i.name), i.type, components(i.shape, particles.dim()), i.shape == Shape::vector});
  }
  for (const ExtraColumn& e : extra)
    out.push_back({e.name, Type::f64, e.components, e.components == particles.dim()});
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

std::string data_item(const SnapshotEntry& entry, const Item& item, std::string_view group = "/particles/") {
  const std::string dimensions = item.components == 1 ? fmt::format("{}", entry.rows)
                                                      : fmt::format("{} {}", entry.rows, item.components);
  return fmt::format(R"(<DataItem Format="HDF" Dimensions="{}" {}>{}:{}{}</DataItem>)", dimensions,
                     number_type(item.type), escaped(entry.file), group, escaped(item.name));
}

std::string grid(const SnapshotEntry& entry, int dim, const std::vector<Item>& items) {
  std::string out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "   <Grid Name=\"step {}\" GridType=\"Uniform\">\n", entry.step);
  fmt::format_to(to, "    <Time Value=\"{}\"/>\n", entry.time);
  fmt::format_to(
      to,
      "    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
      "NodesPerElement=\"1\">{}</Topology>\n",
      entry.rows,
      data_item(entry, {"vertex", vertex_type(static_cast<std::uint64_t>(entry.rows)), 1, false}, "/"));
  fmt::format_to(to, "    <Geometry GeometryType=\"{}\">{}</Geometry>\n", dim == 2 ? "XY" : "XYZ",
                 data_item(entry, {"position", Type::f64, dim, true}));
  for (const Item& item : items)
    fmt::format_to(to, "    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                   escaped(item.name), attribute_type(item), data_item(entry, item));
  return out + "   </Grid>\n";
}

}  // namespace

void write_xdmf(const std::filesystem::path& path, const std::vector<SnapshotEntry>& entries,
                const Particles& particles, const std::vector<ExtraColumn>& extra) {
  const std::vector<Item> items = items_of(particles, extra);
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n <Domain>\n"
      "  <Grid Name=\"particles\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (const SnapshotEntry& entry : entries) text += grid(entry, particles.dim(), items);
  text += "  </Grid>\n </Domain>\n</Xdmf>\n";
  try {
    write_atomically(path, text);
  } catch (const std::exception& error) {
    throw OutputError("cannot write " + path.string() + ": " + error.what());
  }
}

}  // namespace sph
