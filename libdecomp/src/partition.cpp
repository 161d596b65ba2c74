#include "decomp/partition.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

namespace decomp {

namespace {

using Line = std::vector<std::int64_t>;

constexpr std::int64_t far_away = std::int64_t{1} << 62;

struct Interval {
  std::int64_t lo, hi;
};
struct PartRange {
  std::size_t first, last;  ///< parts [first, last)
};

void check_line(const Line& cut, std::int64_t cells, const std::string& what) {
  if (cut.size() < 2 || cut.front() != 0 || cut.back() != cells)
    throw InputError(what + " must run from 0 to " + std::to_string(cells) + " cells");
  for (std::size_t i = 0; i + 1 < cut.size(); ++i)
    if (cut[i + 1] - cut[i] < JaggedPartition::min_width)
      throw InputError(what + ": part " + std::to_string(i) + " from cell " + std::to_string(cut[i]) +
                       " to " + std::to_string(cut[i + 1]) + " is thinner than " +
                       std::to_string(JaggedPartition::min_width) + " cell");
}

/// Extent of a part in quanta. Positions beyond a non-periodic end belong to its edge cells.
Interval extent(const CellGrid& grid, int axis, const Line& cut, std::size_t part) {
  const bool open = !grid.periodic()[axis];
  return {open && part == 0 ? -far_away : grid.line(axis, cut[part]),
          open && part + 2 == cut.size() ? far_away : grid.line(axis, cut[part + 1])};
}

/// Parts that share a quantum with `want`; no wrapping.
PartRange parts_meeting(const CellGrid& grid, int axis, const Line& cut, Interval want) {
  if (want.lo >= want.hi) return {0, 0};
  if (grid.periodic()[axis] && (want.hi <= grid.line(axis, 0) || want.lo >= grid.line(axis, cut.back())))
    return {0, 0};
  const auto line = [&](std::int64_t c) { return grid.line(axis, c); };
  const auto begin = cut.begin() + 1;
  const auto end = cut.end() - 1;
  const auto first = std::ranges::upper_bound(begin, end, want.lo, {}, line) - begin;
  const auto last = std::ranges::lower_bound(begin, end, want.hi, {}, line) - begin + 1;
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

/// The same with wrapping: at most two ranges, ascending and disjoint.
std::vector<PartRange> parts_meeting_wrapped(const CellGrid& grid, int axis, const Line& cut, Interval want) {
  const std::size_t parts = cut.size() - 1;
  if (axis >= grid.dim()) return {{0, parts}};
  if (!grid.periodic()[axis] || want.lo >= want.hi) return {parts_meeting(grid, axis, cut, want)};
  const std::int64_t period = grid.length()[axis];
  if (want.lo <= want.hi - period) return {{0, parts}};
  Int3 corner = grid.origin();
  corner[axis] = want.lo;
  const std::int64_t lo = grid.wrap(corner)[axis];
  const std::int64_t hi = lo + (want.hi - want.lo);
  const PartRange upper = parts_meeting(grid, axis, cut, {lo, hi});
  const PartRange lower = parts_meeting(grid, axis, cut, {lo - period, hi - period});
  return {{lower.first, std::min(lower.last, upper.first)}, upper};
}

std::vector<std::int64_t> shifts_of(const CellGrid& grid, int axis) {
  if (!grid.periodic()[axis]) return {0};
  return {-grid.length()[axis], 0, grid.length()[axis]};
}

}  // namespace

JaggedPartition::JaggedPartition(const CellGrid& grid, int row_axis, int column_axis, Cuts cuts)
    : grid_(grid), row_axis_(row_axis), column_axis_(column_axis), cuts_(std::move(cuts)) {
  const auto is_axis = [](int a) { return a >= 0 && a < max_axes; };
  if (!is_axis(row_axis) || !is_axis(column_axis) || row_axis == column_axis)
    throw InputError("the two cut axes must be different axes out of 0, 1, 2, not " +
                     std::to_string(row_axis) + " and " + std::to_string(column_axis));
  check_line(cuts_.row, grid_.cells()[row_axis], "row cuts");
  if (cuts_.column.size() + 1 != cuts_.row.size())
    throw InputError(std::to_string(cuts_.row.size() - 1) + " rows but column cuts for " +
                     std::to_string(cuts_.column.size()));
  first_.push_back(0);
  for (std::size_t row = 0; row < cuts_.column.size(); ++row) {
    const Line& column = cuts_.column[row];
    check_line(column, grid_.cells()[column_axis], "column cuts of row " + std::to_string(row));
    first_.push_back(first_.back() + static_cast<std::int64_t>(column.size()) - 1);
  }
}

Rank JaggedPartition::owner(const Int3& cell) const {
  const auto part_of = [](const Line& cut, std::int64_t c) {
    return std::upper_bound(cut.begin() + 1, cut.end() - 1, c) - cut.begin() - 1;
  };
  const auto row = static_cast<std::size_t>(part_of(cuts_.row, cell[row_axis_]));
  return static_cast<Rank>(first_[row] + part_of(cuts_.column[row], cell[column_axis_]));
}

std::size_t JaggedPartition::row_of(Rank r) const {
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), r) - first_.begin() - 1);
}

Box JaggedPartition::cells(Rank r) const {
  const std::size_t row = row_of(r);
  const auto column = static_cast<std::size_t>(r - first_[row]);
  Box box{{0, 0, 0}, grid_.cells()};
  box.lo[row_axis_] = cuts_.row[row];
  box.hi[row_axis_] = cuts_.row[row + 1];
  box.lo[column_axis_] = cuts_.column[row][column];
  box.hi[column_axis_] = cuts_.column[row][column + 1];
  return box;
}

Box JaggedPartition::quanta(Rank r) const {
  const std::size_t row = row_of(r);
  Box box;
  const auto set = [&](int axis, const Line& cut, std::size_t part) {
    const Interval i = extent(grid_, axis, cut, part);
    box.lo[axis] = i.lo;
    box.hi[axis] = i.hi;
  };
  const int uncut = max_axes - row_axis_ - column_axis_;
  set(row_axis_, cuts_.row, row);
  set(column_axis_, cuts_.column[row], static_cast<std::size_t>(r - first_[row]));
  set(uncut, {0, grid_.cells()[uncut]}, 0);
  return box;
}

std::vector<JaggedPartition::Image> JaggedPartition::neighbours(Rank r, std::int64_t reach) const {
  std::vector<Image> found;
  if (reach < 1) return found;
  for (int a = 0; a < max_axes; ++a)
    if (grid_.periodic()[a] && reach >= grid_.length()[a])
      throw InputError("the halo of " + std::to_string(reach) + " quanta is wider than periodic axis " +
                       std::string(1, "xyz"[a]));
  const Box mine = quanta(r);
  // A gap below `reach` between mine and (theirs + shift) means that theirs meets mine grown by reach -
  // shift.
  const auto wanted = [&](int axis, std::int64_t shift) {
    return Interval{mine.lo[axis] - reach - shift, mine.hi[axis] + reach - shift};
  };
  const int uncut = max_axes - row_axis_ - column_axis_;
  for (const std::int64_t row_shift : shifts_of(grid_, row_axis_)) {
    const PartRange rows = parts_meeting(grid_, row_axis_, cuts_.row, wanted(row_axis_, row_shift));
    for (std::size_t row = rows.first; row < rows.last; ++row)
      for (const std::int64_t column_shift : shifts_of(grid_, column_axis_)) {
        const PartRange columns =
            parts_meeting(grid_, column_axis_, cuts_.column[row], wanted(column_axis_, column_shift));
        for (std::size_t column = columns.first; column < columns.last; ++column)
          for (const std::int64_t uncut_shift : shifts_of(grid_, uncut)) {
            Image image{static_cast<Rank>(first_[row] + static_cast<std::int64_t>(column)), {}};
            image.shift[row_axis_] = row_shift;
            image.shift[column_axis_] = column_shift;
            image.shift[uncut] = uncut_shift;
            if (image != Image{r, {}}) found.push_back(image);
          }
      }
  }
  std::ranges::sort(found, {}, [](const Image& i) { return std::tie(i.rank, i.shift); });
  return found;
}

std::vector<Rank> JaggedPartition::ranks_touching(const Box& box) const {
  std::vector<Rank> found;
  const int uncut = max_axes - row_axis_ - column_axis_;
  if (uncut < grid_.dim() && box.lo[uncut] >= box.hi[uncut]) return found;
  const auto wanted = [&](int axis) { return Interval{box.lo[axis], box.hi[axis]}; };
  for (const PartRange rows : parts_meeting_wrapped(grid_, row_axis_, cuts_.row, wanted(row_axis_)))
    for (std::size_t row = rows.first; row < rows.last; ++row)
      for (const PartRange columns :
           parts_meeting_wrapped(grid_, column_axis_, cuts_.column[row], wanted(column_axis_)))
        for (std::size_t column = columns.first; column < columns.last; ++column)
          found.push_back(static_cast<Rank>(first_[row] + static_cast<std::int64_t>(column)));
  return found;
}

}  // namespace decomp
