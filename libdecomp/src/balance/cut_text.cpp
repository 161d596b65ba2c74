// Cuts as one line of text: "rows 0 5 11 | 0 4 9 | 0 3 9" is two rows of two columns on 11 x 9 cells.
#include <charconv>
#include <sstream>

#include "decomp/cut_policy.hpp"

namespace decomp {

namespace {

[[noreturn]] void refuse(const std::string& line, const std::string& why) {
  throw InputError("cuts \"" + line + "\": " + why);
}

void check_line(const std::string& line, const std::vector<std::int64_t>& cut, const std::string& what) {
  if (cut.size() < 2) refuse(line, what + " need at least a start and an end");
  if (cut.front() != 0) refuse(line, what + " start at " + std::to_string(cut.front()) + " instead of 0");
  for (std::size_t i = 1; i < cut.size(); ++i)
    if (cut[i] <= cut[i - 1])
      refuse(line,
             what + " do not increase from " + std::to_string(cut[i - 1]) + " to " + std::to_string(cut[i]));
}

}  // namespace

std::string to_text(const Cuts& cuts) {
  std::ostringstream text;
  text << "rows";
  for (const std::int64_t c : cuts.row) text << ' ' << c;
  for (const auto& column : cuts.column) {
    text << " |";
    for (const std::int64_t c : column) text << ' ' << c;
  }
  return text.str();
}

Cuts cuts_from_text(const std::string& line) {
  std::istringstream words(line);
  std::string word;
  if (!(words >> word) || word != "rows") refuse(line, "the line must begin with \"rows\"");
  Cuts cuts;
  std::vector<std::int64_t>* target = &cuts.row;
  while (words >> word) {
    if (word == "|") {
      target = &cuts.column.emplace_back();
      continue;
    }
    std::int64_t value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc{} || stop != end) refuse(line, "\"" + word + "\" is not a cell number");
    target->push_back(value);
  }
  check_line(line, cuts.row, "row cuts");
  if (cuts.column.size() + 1 != cuts.row.size())
    refuse(line, std::to_string(cuts.row.size() - 1) + " rows, but column cuts for " +
                     std::to_string(cuts.column.size()));
  for (std::size_t row = 0; row < cuts.column.size(); ++row) {
    const std::string what = "column cuts of row " + std::to_string(row + 1);
    check_line(line, cuts.column[row], what);
    if (cuts.column[row].back() != cuts.column[0].back())
      refuse(line, what + " end at " + std::to_string(cuts.column[row].back()) + ", those of row 1 at " +
                       std::to_string(cuts.column[0].back()));
  }
  return cuts;
}

}  // namespace decomp
