// HDF5 converts whatever it is asked for: 0.9 to group 0, NaN to id 2^63, -1 to 0. So each column is looked
// at as it is stored, and read as a type that holds all it may hold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/hdf5_file.hpp"
#include "files/tensor_order.hpp"
#include "start/start_rows.hpp"

namespace sph {
namespace {

using Numbers = StoredAs::Numbers;

std::string size_text(const std::vector<std::uint64_t>& extent) {
  if (extent.empty()) return "one value";
  return fmt::format("{} values", fmt::join(extent, " x "));
}

class Source {
 public:
  Source(const std::string& path, int rank, int ranks) : file_(path) {
    const std::string id = find({"id", "particles/id"});
    if (id.empty()) throw RowProblem(0, "data set \"id\" is missing");
    const StoredAs stored = file_.stored_as(id);
    if (stored.extent.empty()) throw RowProblem(0, "data set \"id\" has one value; it must have one a row");
    all_ = stored.extent.front();
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
  [[nodiscard]] std::vector<double> real(std::initializer_list<const char*> names, int components,
                                         bool required) const {
    const std::string name = find(names);
    const StoredAs stored = check(name, names, components, required);
    if (name.empty()) return {};
    if (stored.numbers == Numbers::none || stored.bytes > sizeof(double))
      fail_type(name, stored, "numbers of at most 64 bits");
    return read<double>(name, Element::f64, components);
  }
  /// Whole numbers from `least` to `most`.
  template <class T>
  [[nodiscard]] std::vector<T> whole(std::initializer_list<const char*> names, int components, bool required,
                                     std::int64_t least, std::uint64_t most) const {
    const std::string name = find(names);
    const StoredAs stored = check(name, names, components, required);
    if (name.empty()) return {};
    if (stored.numbers != Numbers::whole || stored.bytes > sizeof(std::uint64_t))
      fail_type(name, stored, "integers of at most 64 bits");
    if (stored.with_sign)
      return within<T>(name, read<std::int64_t>(name, Element::i64, components), components, least, most);
    return within<T>(name, read<std::uint64_t>(name, Element::u64, components), components, least, most);
  }

 private:
  [[nodiscard]] StoredAs check(const std::string& name, std::initializer_list<const char*> names,
                               int components, bool required) const {
    if (name.empty() && required)
      throw RowProblem(0, fmt::format("data set \"{}\" is missing", *names.begin()));
    if (name.empty()) return {};
    StoredAs stored = file_.stored_as(name);
    const auto width = static_cast<std::uint64_t>(components);
    const bool flat = components == 1 && stored.extent.size() == 1;
    const bool table = stored.extent.size() == 2 && stored.extent[1] == width;
    if (!(flat || table) || stored.extent[0] != all_)
      throw RowProblem(0, fmt::format("data set \"{}\" has {}; it must have {} x {}", name,
                                      size_text(stored.extent), all_, components));
    return stored;
  }
  [[noreturn]] static void fail_type(const std::string& name, const StoredAs& stored, const char* right) {
    throw RowProblem(0, fmt::format("data set \"{}\" holds {}; it must hold {}", name, stored.type, right));
  }
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& name, Element element, int components) const {
    std::vector<T> values(rows_ * static_cast<std::size_t>(components));
    file_.read_rows(name, element, first_, rows_, values.data());
    return values;
  }
  template <class T, class Stored>
  [[nodiscard]] std::vector<T> within(const std::string& name, const std::vector<Stored>& values,
                                      int components, std::int64_t least, std::uint64_t most) const {
    const auto bad = std::find_if(values.begin(), values.end(), [&](Stored value) {
      return std::cmp_less(value, least) || std::cmp_greater(value, most);
    });
    if (bad != values.end()) {
      const auto row =
          static_cast<std::int64_t>(first_) + (bad - values.begin()) / static_cast<std::int64_t>(components);
      throw RowProblem(row,
                       fmt::format("row {}: {} is {}; it must be {} to {}", row, name, *bad, least, most));
    }
    return std::vector<T>(values.begin(), values.end());
  }

  Hdf5Reader file_;
  std::uint64_t all_ = 0, first_ = 0, rows_ = 0;
};

}  // namespace

std::int64_t count_hdf5_rows(const std::string& file) {
  return static_cast<std::int64_t>(Source(file, 0, 1).rows());
}

StartRows read_hdf5_rows(const Scene& scene, const std::string& file, int rank, int ranks) {
  constexpr std::int64_t farthest = std::int64_t{1} << 62;  // [quanta]: differences do not overflow
  const Source source(file, rank, ranks);
  const int dim = scene.dim;
  StartRows out;
  for (std::uint64_t k = 0; k < source.rows(); ++k)
    out.number.push_back(static_cast<std::int64_t>(source.first() + k));
  out.id = source.whole<std::uint64_t>({"id", "particles/id"}, 1, true, 0, largest_id);
  out.position.quanta =
      source.whole<std::int64_t>({"particles/position_quanta"}, dim, false, -farthest, farthest);
  if (source.find({"particles/position_quanta"}).empty())
    out.position.x = source.real({"x", "position", "particles/position"}, dim, true);
  else
    out.position.quantum = source.file().real("quantum");
  if (!out.position.quanta.empty() && !(out.position.quantum > 0 && std::isfinite(out.position.quantum)))
    throw RowProblem(0,
                     fmt::format("attribute \"quantum\" is {}; it must be positive", out.position.quantum));
  out.v = source.real({"v", "velocity", "particles/velocity"}, dim, true);
  out.group = source.whole<std::uint32_t>({"group", "particles/group"}, 1, true, 0, scene.groups.size() - 1);
  if (scene.of_grains()) {
    out.grains.radius = source.real({"radius", "particles/radius"}, 1, true);
    out.grains.spin = source.real({"spin", "particles/spin"}, dim, false);
    return out;
  }
  out.matter.rho = source.real({"rho", "density", "particles/density"}, 1, false);
  out.matter.gas = source.real({"m", "gas_content", "particles/gas_content"}, 1, false);
  out.matter.temperature = source.real({"T", "temperature", "particles/temperature"}, 1, false);
  out.matter.energy = source.real({"u", "specific_energy", "particles/specific_energy"}, 1, false);
  out.matter.mass = source.real({"mass", "particles/mass"}, 1, false);
  out.matter.stress = source.real({"stress", "particles/stress"}, dim * (dim + 1) / 2, false);
  if (!out.matter.stress.empty())
    to_state_order(source.file(), source.find({"stress", "particles/stress"}), dim, out.matter.stress.data(),
                   source.rows());
  return out;
}

}  // namespace sph
