// How many rows and columns, and where they start. With heights proportional to the columns of a row,
// h_r = R Q_r / n, and widths C / Q_r, the half perimeter summed over parts, which is the halo, is
//     sum_r Q_r (h_r + C / Q_r) = R sum_r Q_r^2 / n + P C        (R x C cells, n ranks, P rows).
#include <algorithm>

#include "decomp/partition.hpp"

namespace decomp {

namespace {

constexpr std::int64_t width = JaggedPartition::min_width;

/// Columns of row r: n / P rounded up or down, the longer rows spread evenly.
std::int64_t columns_of(std::int64_t r, std::int64_t rows, std::int64_t ranks) {
  return (r + 1) * ranks / rows - r * ranks / rows;
}

double half_perimeter(std::int64_t rows, std::int64_t ranks, double row_cells, double column_cells) {
  const std::int64_t fewer = ranks / rows;
  const std::int64_t longer_rows = ranks % rows;
  // sum of squares of `longer_rows` times fewer + 1 and the rest fewer
  const double squares = static_cast<double>(fewer) * static_cast<double>(fewer) * static_cast<double>(rows) +
                         static_cast<double>(2 * fewer + 1) * static_cast<double>(longer_rows);
  return row_cells * squares / static_cast<double>(ranks) + static_cast<double>(rows) * column_cells;
}

void check_feasible(int ranks, std::int64_t row_cells, std::int64_t column_cells) {
  if (ranks < 1) throw InputError("the number of ranks must be at least 1, not " + std::to_string(ranks));
  const std::int64_t most = max_ranks(row_cells, column_cells);
  if (ranks > most)
    throw InputError(std::to_string(ranks) + " ranks are too many for " + std::to_string(row_cells) + " x " +
                     std::to_string(column_cells) + " cells of the cut axes: at most " +
                     std::to_string(most) + " ranks");
}

/// Moves the inner cuts as little as needed for every part to be `width` cells or more.
void widen(std::vector<std::int64_t>& cut) {
  for (std::size_t i = 1; i + 1 < cut.size(); ++i) cut[i] = std::max(cut[i], cut[i - 1] + width);
  for (std::size_t i = cut.size() - 2; i > 0; --i) cut[i] = std::min(cut[i], cut[i + 1] - width);
}

}  // namespace

std::size_t part_count(const Cuts& cuts) {
  std::size_t n = 0;
  for (const auto& column : cuts.column) n += column.size() - 1;
  return n;
}

std::int64_t max_ranks(std::int64_t row_cells, std::int64_t column_cells) {
  return (row_cells / width) * (column_cells / width);
}

std::vector<int> jagged_shape(int ranks, std::int64_t row_cells, std::int64_t column_cells) {
  check_feasible(ranks, row_cells, column_cells);
  // A part of aspect ratio 2 has 6 % more perimeter than a square one: so much is the seed's form worth.
  constexpr double equal_columns_bonus = 1.07;
  const std::int64_t most_rows = std::min<std::int64_t>(ranks, row_cells / width);
  const std::int64_t most_columns = column_cells / width;
  std::int64_t best_rows = 0;
  double best = 0;
  for (std::int64_t rows = (ranks + most_columns - 1) / most_columns; rows <= most_rows; ++rows) {
    double halo =
        half_perimeter(rows, ranks, static_cast<double>(row_cells), static_cast<double>(column_cells));
    if (ranks % rows == 0) halo /= equal_columns_bonus;
    if (best_rows == 0 || halo < best) {
      best = halo;
      best_rows = rows;
    }
  }
  std::vector<int> shape(static_cast<std::size_t>(best_rows));
  for (std::size_t r = 0; r < shape.size(); ++r)
    shape[r] = static_cast<int>(columns_of(static_cast<std::int64_t>(r), best_rows, ranks));
  return shape;
}

Cuts uniform_cuts(int ranks, std::int64_t row_cells, std::int64_t column_cells) {
  const std::vector<int> shape = jagged_shape(ranks, row_cells, column_cells);
  Cuts cuts;
  cuts.row.push_back(0);
  std::int64_t before = 0;
  for (const int columns : shape) {
    before += columns;
    cuts.row.push_back((2 * row_cells * before + ranks) / (2 * std::int64_t{ranks}));  // round to nearest
    std::vector<std::int64_t> column;
    for (std::int64_t j = 0; j <= columns; ++j)
      column.push_back((2 * column_cells * j + columns) / (2 * std::int64_t{columns}));
    cuts.column.push_back(std::move(column));
  }
  widen(cuts.row);  // a short row may have been rounded to nothing; even columns never are
  return cuts;
}

}  // namespace decomp
