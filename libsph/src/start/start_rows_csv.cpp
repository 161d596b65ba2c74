// Rank r takes the lines that begin in the r-th of equal parts of the file's bytes.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>

#include "core/nearest.hpp"
#include "files/durable_file.hpp"
#include "start/start_rows.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;

constexpr std::array axis_names{"x", "y", "z"};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\"";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin != std::string_view::npos;) {
    const std::size_t comma = line.find(',', begin);
    cells.push_back(trimmed(line.substr(begin, comma - begin)));
    begin = comma == std::string_view::npos ? comma : comma + 1;
  }
  return cells;
}

[[noreturn]] void fail(std::int64_t line, const std::string& what) {
  throw RowProblem(line, fmt::format("line {}: {}", line, what));
}

bool is_comment(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.front() == '#';
}

/// Where the columns are; -1: absent.
struct Columns {
  std::size_t count = 0;
  int id = -1, group = -1, rho = -1, gas = -1, energy = -1, temperature = -1, mass = -1, radius = -1;
  std::array<int, 3> x{-1, -1, -1}, v{-1, -1, -1}, spin{-1, -1, -1};
};

struct KnownColumn {
  std::string name;
  int* place;
  bool required;
};

std::vector<KnownColumn> known_columns(const Scene& scene, Columns& c) {
  std::vector<KnownColumn> known{{"id", &c.id, true}};
  const auto vector = [&](const std::string& prefix, std::array<int, 3>& places, bool required) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
      known.push_back({prefix + axis_names[a], &places[a], required});
  };
  vector("", c.x, true);
  vector("v", c.v, true);
  known.push_back({"group", &c.group, true});
  if (scene.of_grains()) {
    known.push_back({"radius", &c.radius, true});
    vector("w", c.spin, false);
  } else {
    known.insert(known.end(), {{"rho", &c.rho, false},
                               {"m", &c.gas, false},
                               {"u", &c.energy, false},
                               {"T", &c.temperature, false},
                               {"mass", &c.mass, false}});
  }
  return known;
}

std::string names_of(const std::vector<KnownColumn>& known, bool required) {
  std::string out;
  for (const KnownColumn& k : known)
    if (k.required == required) out += (out.empty() ? "" : ",") + k.name;
  return out;
}

Columns columns_of(std::string_view header, const Scene& scene) {
  Columns c;
  const std::vector<KnownColumn> known = known_columns(scene, c);
  const std::vector<std::string_view> names = cells_of(header);
  c.count = names.size();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto at =
        std::find_if(known.begin(), known.end(), [&](const KnownColumn& e) { return e.name == names[k]; });
    if (at == known.end()) {
      std::vector<std::string> words;
      for (const KnownColumn& e : known) words.push_back(e.name);
      throw RowProblem(0, fmt::format("unknown column \"{}\"; {}", names[k], suggestion(names[k], words)));
    }
    if (*at->place >= 0) throw RowProblem(0, fmt::format("column \"{}\" is there twice", names[k]));
    *at->place = static_cast<int>(k);
  }
  for (const KnownColumn& e : known)
    if (*e.place < 0 && e.required)
      throw RowProblem(0, fmt::format("column \"{}\" is missing; the header must name {} and may name {}",
                                      e.name, names_of(known, true), names_of(known, false)));
  if (std::min({c.spin[0], c.spin[1], c.spin[2]}) < 0 && std::max({c.spin[0], c.spin[1], c.spin[2]}) >= 0)
    throw RowProblem(0, "names some of the columns wx,wy,wz; it must name all or none");
  return c;
}

template <class T>
T number(std::string_view cell, std::int64_t line, std::string_view column, const char* what) {
  T value{};
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size())
    fail(line, fmt::format("{} is \"{}\"; it must be {}", column, cell, what));
  return value;
}

std::uint32_t group_of(const Scene& scene, std::string_view cell, std::int64_t line) {
  const int named = scene.group_index(std::string(cell));
  if (named >= 0) return static_cast<std::uint32_t>(named);
  if (!cell.empty() && cell.find_first_not_of("0123456789") == std::string_view::npos)
    return number<std::uint32_t>(cell, line, "group", "a group of the scene");
  std::vector<std::string> names;
  for (const Group& g : scene.groups) names.push_back(g.name);
  fail(line, fmt::format("group \"{}\" is not in the scene; {}", cell, suggestion(cell, names)));
}

void read_row(const Scene& scene, const Columns& c, std::string_view text, std::int64_t line,
              StartRows& rows) {
  const std::vector<std::string_view> cells = cells_of(text);
  if (text.find('\0') != std::string_view::npos) fail(line, "holds a byte of value 0; it must be plain text");
  if (cells.size() != c.count) fail(line, fmt::format("has {} values, the header {}", cells.size(), c.count));
  const auto cell = [&](int column) { return cells[static_cast<std::size_t>(column)]; };
  const auto real = [&](int column, std::string_view name) {
    return number<double>(cell(column), line, name, "a number");
  };
  rows.number.push_back(line);
  rows.id.push_back(number<std::uint64_t>(cell(c.id), line, "id", "a whole number from 0"));
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    rows.position.x.push_back(real(c.x[a], axis_names[a]));
    rows.v.push_back(real(c.v[a], std::string("v") + axis_names[a]));
    if (c.spin[a] >= 0) rows.grains.spin.push_back(real(c.spin[a], std::string("w") + axis_names[a]));
  }
  rows.group.push_back(group_of(scene, cell(c.group), line));
  if (c.rho >= 0) rows.matter.rho.push_back(real(c.rho, "rho"));
  if (c.gas >= 0) rows.matter.gas.push_back(real(c.gas, "m"));
  if (c.energy >= 0) rows.matter.energy.push_back(real(c.energy, "u"));
  if (c.temperature >= 0) rows.matter.temperature.push_back(real(c.temperature, "T"));
  if (c.radius >= 0) rows.grains.radius.push_back(real(c.radius, "radius"));
  if (c.mass >= 0) rows.matter.mass.push_back(real(c.mass, "mass"));
}

std::int64_t line_breaks(std::ifstream& in, std::uint64_t bytes) {
  std::int64_t lines = 0;
  std::vector<char> buffer(std::size_t{1} << 20);
  while (bytes > 0) {
    const auto n = std::min<std::uint64_t>(bytes, buffer.size());
    if (!in.read(buffer.data(), static_cast<std::streamsize>(n))) break;
    lines += std::count(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(n), '\n');
    bytes -= n;
  }
  return lines;
}

}  // namespace

std::int64_t count_csv_rows(const std::string& file) {
  constexpr std::uint64_t beginning = 1 << 20;
  const std::uint64_t size = fs::file_size(file), looked_at = std::min(size, beginning);
  std::ifstream in(file, std::ios::binary);
  const std::int64_t lines = std::max<std::int64_t>(line_breaks(in, looked_at), 1);
  return static_cast<std::int64_t>(static_cast<double>(lines) * static_cast<double>(size) /
                                   static_cast<double>(std::max<std::uint64_t>(looked_at, 1)));
}

StartRows read_csv_rows(const Scene& scene, const std::string& file, int rank, int ranks) {
  const fs::path path = file;
  const std::uint64_t size = fs::file_size(path);
  std::ifstream in(path, std::ios::binary);
  std::string line;
  std::int64_t header_line = 1;
  while (std::getline(in, line) && is_comment(line)) ++header_line;
  constexpr std::string_view mark = "\xef\xbb\xbf";  // of UTF-8, by some editors
  if (line.starts_with(mark)) line.erase(0, mark.size());
  if (line.find('\0') != std::string::npos)
    throw RowProblem(0, "is no plain text but binary, or UTF-16; save it as ASCII or UTF-8");
  // What is not the end of its line: those of a file with CR alone are one line to everyone else.
  if (line.find('\r') < line.size() - 1)
    throw RowProblem(0, "ends its lines with CR alone; save it with LF, or CR and LF, as line ends");
  if (!in && line.empty()) throw RowProblem(0, "is empty; it must begin with a header of column names");
  StartRows rows;
  rows.unit = "line";
  const Columns columns = columns_of(line, scene);
  const std::uint64_t body = in.eof() ? size : static_cast<std::uint64_t>(in.tellg());

  const auto share = [&](int r) {
    return body + (size - body) * static_cast<std::uint64_t>(r) / static_cast<std::uint64_t>(ranks);
  };
  const std::uint64_t first = share(rank), last = share(rank + 1);
  in.clear();
  in.seekg(static_cast<std::streamoff>(body));
  // A line belongs to the rank in whose part it begins: one that is cut by `first` is not ours.
  std::int64_t number = header_line;
  std::uint64_t at = first;
  if (first > body) {
    number += line_breaks(in, first - 1 - body);
    std::getline(in, line);
    at = first - 1 + line.size() + 1;
    ++number;
  }
  while (at < last && std::getline(in, line)) {
    at += line.size() + 1;
    ++number;
    if (!is_comment(line)) read_row(scene, columns, line, number, rows);
  }
  return rows;
}

}  // namespace sph
