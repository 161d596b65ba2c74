// Particles for the tests of halo and migration: every value is a function of the particle's id, so that a
// datum in the wrong place tells where it came from, and any rank can work out what all the others hold.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "decomp/grid.hpp"
#include "decomp/partition.hpp"
#include "decomp/splitmix.hpp"
#include "decomp/table.hpp"

namespace decomp_test {

using namespace decomp;

/// Draw number `draw` of stream `stream`, in [0, below).
inline std::int64_t draw(std::uint64_t stream, std::uint64_t draw, std::int64_t below) {
  return static_cast<std::int64_t>(splitmix(splitmix(stream) + draw) % static_cast<std::uint64_t>(below));
}

struct Scene {
  std::string name;
  int dim;
  Int3 cells;
  std::array<bool, 3> periodic;
  std::uint64_t particles;
  int row_axis = 0, column_axis = 1;
  double filled = 1.0;  ///< part of each axis that holds particles: leaves ranks without any

  static constexpr std::int64_t edge = 1000;
  [[nodiscard]] CellGrid grid() const {
    Int3 length{};
    for (int a = 0; a < dim; ++a) length[a] = cells[a] * edge + 37 * (a + 1);  // the last cell is longer
    return CellGrid(dim, {-5000, 123, 7}, length, periodic, edge);
  }
};

inline std::vector<Scene> scenes() {
  const std::array<bool, 3> walls{false, false, false}, all{true, true, true}, slab{true, false, false};
  return {{"2D walls", 2, {8, 9, 1}, walls, 300},
          {"2D periodic", 2, {7, 8, 1}, all, 300, 1, 0},
          {"2D periodic, least cells", 2, {3, 3, 1}, all, 120},
          {"2D channel", 2, {9, 4, 1}, slab, 300},
          {"3D walls", 3, {5, 6, 4}, walls, 350, 2, 0},
          {"3D periodic", 3, {5, 4, 3}, all, 350},
          {"3D periodic, least cells", 3, {3, 3, 3}, all, 150, 1, 2},
          {"3D channel, empty ranks", 3, {6, 5, 3}, slab, 200, 0, 1, 0.3}};
}

/// Cells along the two cut axes allow this many ranks at least: every scene takes the launches of the suite.
inline Cuts random_cuts(const CellGrid& grid, int row_axis, int column_axis, int ranks, std::uint64_t seed) {
  const auto draw_line = [](std::int64_t parts, std::int64_t cells, std::uint64_t stream) {
    std::set<std::int64_t> line{0, cells};
    for (std::uint64_t k = 0; static_cast<std::int64_t>(line.size()) < parts + 1; ++k)
      line.insert(1 + draw(stream, k, cells - 1));
    return std::vector<std::int64_t>(line.begin(), line.end());
  };
  const std::int64_t row_cells = grid.cells()[row_axis], column_cells = grid.cells()[column_axis];
  const std::int64_t least = (ranks + column_cells - 1) / column_cells;
  const std::int64_t rows = least + draw(seed, 0, std::min<std::int64_t>(ranks, row_cells) - least + 1);
  std::vector<std::int64_t> columns(static_cast<std::size_t>(rows), 1);
  for (std::int64_t left = ranks - rows, k = 1; left > 0; ++k) {
    std::int64_t& row = columns[static_cast<std::size_t>(draw(seed, static_cast<std::uint64_t>(k), rows))];
    if (row < column_cells) ++row, --left;
  }
  Cuts cuts{draw_line(rows, row_cells, seed + 1000), {}};
  for (std::size_t r = 0; r < columns.size(); ++r)
    cuts.column.push_back(draw_line(columns[r], column_cells, seed + 2000 + r));
  return cuts;
}

inline JaggedPartition random_partition(const Scene& scene, int ranks, std::uint64_t seed) {
  const CellGrid grid = scene.grid();
  return JaggedPartition(grid, scene.row_axis, scene.column_axis,
                         random_cuts(grid, scene.row_axis, scene.column_axis, ranks, seed));
}

/// Wrapped start position. Many lie on a cell line or just below it on some axis, or one cell edge from the
/// far end; where there is no period, some lie outside the domain.
inline Int3 position_of(const Scene& scene, Gid id) {
  const CellGrid grid = scene.grid();
  Int3 x{};
  for (int a = 0; a < scene.dim; ++a) {
    const auto k = static_cast<std::uint64_t>(10 * a);
    const auto extent = static_cast<std::int64_t>(static_cast<double>(grid.length()[a]) * scene.filled);
    x[a] = grid.origin()[a] + draw(id, k, extent);
    const std::int64_t kind = draw(id, k + 1, 8);
    const Int3 cell = grid.cell_of(x);
    if (kind == 0) x[a] = grid.line(a, cell[a]);
    if (kind == 1) x[a] = grid.line(a, cell[a] + 1) - 1;
    if (kind == 3 && scene.filled == 1)
      x[a] = grid.line(a, grid.cells()[a]) - Scene::edge - draw(id, k + 3, 2);
    if (kind == 2 && !grid.periodic()[a] && cell[a] == 0) x[a] = grid.origin()[a] - draw(id, k + 2, 300);
  }
  return x;
}

inline constexpr std::array<std::size_t, 9> value_widths{1, 4, 5, 8, 12, 16, 24, 32, 48};

/// Columns: 0 the id, 1 the position, then one of each width of value_widths, last one that passes.
inline Table make_table(int dim) {
  Table table;
  table.add_column("id", sizeof(Gid));
  table.add_column("x", static_cast<std::size_t>(dim) * sizeof(std::int64_t));
  for (const std::size_t w : value_widths) table.add_column("value" + std::to_string(w), w);
  table.add_column("passing", 20, decomp::Values::passing);
  return table;
}

inline std::vector<int> all_columns(const Table& table) {
  std::vector<int> columns(static_cast<std::size_t>(table.columns()));
  std::iota(columns.begin(), columns.end(), 0);
  return columns;
}

/// What a row of `width` bytes in column c holds: the id again and again, marked with column and version.
inline std::vector<std::byte> expected_value(Gid id, int c, std::size_t width, int version = 0) {
  const std::uint64_t word =
      id + (static_cast<std::uint64_t>(c) << 48) + (static_cast<std::uint64_t>(version) << 56) + 1;
  std::vector<std::byte> bytes(width);
  for (std::size_t b = 0; b < width; ++b) bytes[b] = static_cast<std::byte>(word >> (8 * (b % 8)) & 0xFF);
  return bytes;
}

inline void write_values(Table& table, std::size_t row, Gid id, int version = 0) {
  for (int c = 2; c < table.columns(); ++c) {
    if (!table.column(c).kept()) continue;
    const std::size_t width = table.column(c).width();
    std::memcpy(table.column(c).data() + row * width, expected_value(id, c, width, version).data(), width);
  }
}

/// Empty if all values of the row belong to `id`, else the first column that differs.
inline std::string wrong_value(const Table& table, std::size_t row, Gid id, int version = 0) {
  for (int c = 2; c < table.columns(); ++c) {
    if (!table.column(c).kept()) continue;
    const std::size_t width = table.column(c).width();
    if (std::memcmp(table.column(c).data() + row * width, expected_value(id, c, width, version).data(),
                    width) != 0)
      return "row " + std::to_string(row) + " (id " + std::to_string(id) + "), column " +
             table.column(c).name();
  }
  return {};
}

inline Int3 position_in(const Table& table, std::size_t row, int dim) {
  Int3 x{};
  for (int a = 0; a < dim; ++a) x[a] = table.as<std::int64_t>(1)[row * static_cast<std::size_t>(dim) + a];
  return x;
}

inline void set_position(Table& table, std::size_t row, int dim, const Int3& x) {
  for (int a = 0; a < dim; ++a) table.as<std::int64_t>(1)[row * static_cast<std::size_t>(dim) + a] = x[a];
}

inline Rank owner_of(const JaggedPartition& partition, const Int3& x) {
  return partition.owner(partition.grid().cell_of(x));
}

/// The rows that rank `me` owns at the start, in an order of no particular sense.
inline Table fill_table(const Scene& scene, const JaggedPartition& partition, Rank me) {
  Table table = make_table(scene.dim);
  std::vector<Gid> ids;
  for (Gid id = 0; id < scene.particles; ++id)
    if (owner_of(partition, position_of(scene, id)) == me) ids.push_back(id);
  std::sort(ids.begin(), ids.end(), [](Gid a, Gid b) { return splitmix(a) < splitmix(b); });
  table.resize(ids.size(), 0);
  for (std::size_t r = 0; r < ids.size(); ++r) {
    table.as<Gid>(0)[r] = ids[r];
    set_position(table, r, scene.dim, position_of(scene, ids[r]));
    write_values(table, r, ids[r]);
  }
  return table;
}

}  // namespace decomp_test
