#include <fmt/format.h>

#include "output/hdf5_file.hpp"
#include "start/start_rows.hpp"

namespace sph {
namespace {

class Source {
 public:
  Source(const std::string& path, int rank, int ranks) : file_(path) {
    const std::string id = find({"id", "particles/id"});
    if (id.empty()) throw RowProblem(0, "data set \"id\" is missing");
    all_ = file_.rows(id);
    const auto share = [&](int r) {
      return all_ * static_cast<std::uint64_t>(r) / static_cast<std::uint64_t>(ranks);
    };
    first_ = share(rank);
    rows_ = share(rank + 1) - first_;
  }
  [[nodiscard]] std::uint64_t first() const { return first_; }
  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  [[nodiscard]] const Hdf5Reader& file() const { return file_; }

  /// The first of the names that the file has, or empty.
  [[nodiscard]] std::string find(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (file_.has(name)) return name;
    return {};
  }
  /// This rank's rows of the first of the data sets that exists; empty if none does and it is not required.
  template <class T>
  [[nodiscard]] std::vector<T> read(std::initializer_list<const char*> names, Element element, int components,
                                    bool required) const {
    const std::string name = find(names);
    if (name.empty() && required)
      throw RowProblem(0, fmt::format("data set \"{}\" is missing", *names.begin()));
    if (name.empty()) return {};
    if (file_.rows(name) != all_ || file_.components(name) != components)
      throw RowProblem(0, fmt::format("data set \"{}\" has {} x {} values; it must have {} x {}", name,
                                      file_.rows(name), file_.components(name), all_, components));
    std::vector<T> values(rows_ * static_cast<std::size_t>(components));
    file_.read_rows(name, element, first_, rows_, values.data());
    return values;
  }

 private:
  Hdf5Reader file_;
  std::uint64_t all_ = 0, first_ = 0, rows_ = 0;
};

}  // namespace

StartRows read_hdf5_rows(const Scene& scene, const std::string& file, int rank, int ranks) {
  const Source source(file, rank, ranks);
  const int dim = scene.dim;
  StartRows out;
  for (std::uint64_t k = 0; k < source.rows(); ++k)
    out.number.push_back(static_cast<std::int64_t>(source.first() + k));
  out.id = source.read<std::uint64_t>({"id", "particles/id"}, Element::u64, 1, true);
  out.quanta = source.read<std::int64_t>({"particles/position_quanta"}, Element::i64, dim, false);
  if (source.find({"particles/position_quanta"}).empty())
    out.x = source.read<double>({"x", "position", "particles/position"}, Element::f64, dim, true);
  else
    out.quantum = source.file().real("quantum");
  out.v = source.read<double>({"v", "velocity", "particles/velocity"}, Element::f64, dim, true);
  out.group = source.read<std::uint32_t>({"group", "particles/group"}, Element::u32, 1, true);
  if (scene.of_grains()) {
    out.radius = source.read<double>({"radius", "particles/radius"}, Element::f64, 1, true);
    out.spin = source.read<double>({"spin", "particles/spin"}, Element::f64, dim, false);
    return out;
  }
  out.rho = source.read<double>({"rho", "density", "particles/density"}, Element::f64, 1, false);
  out.gas = source.read<double>({"m", "gas_content", "particles/gas_content"}, Element::f64, 1, false);
  out.energy =
      source.read<double>({"u", "specific_energy", "particles/specific_energy"}, Element::f64, 1, false);
  out.mass = source.read<double>({"mass", "particles/mass"}, Element::f64, 1, false);
  out.stress = source.read<double>({"stress", "particles/stress"}, Element::f64, dim * (dim + 1) / 2, false);
  return out;
}

}  // namespace sph
