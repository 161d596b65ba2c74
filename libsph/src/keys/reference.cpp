#include "keys/reference.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "keys/all_keys.hpp"
#include "keys/law_keys.hpp"

namespace sph::keys {
namespace {

constexpr std::string_view about =
    "Every key of a scene, its unit, its default and what it means. What a scene leaves out takes its "
    "default. A unit in brackets is that of a plain number; a text may have any other of the kind: 0.005 "
    "or \"5 mm\", 5e8 or \"500 MPa\", 2500 or \"2.5 g/cm3\", \"500 Pa s\", \"9.8 m/s2\", \"1 kN/m\", \"100 "
    "1/s\", \"1e-3 m/s/N\". Known are km m cm mm um, s ms us min h d Hz, kg g t, mN N kN MN, Pa mPa hPa "
    "kPa MPa GPa bar mbar kbar atm, J kJ MJ and %; a wrong unit is an error. Vectors have as many numbers "
    "as the scene has dimensions. Paths are relative to the folder of the scene, on the command line to "
    "the working folder.\n\n"
    "Any key can be set on the command line: --set time.until=5, --set group.magma.viscosity=\"1e3 Pa s\", "
    "--set start.region.1.radius=6, --set time.dt= (an empty value removes the key). Elements of "
    "[[tables]] go by name or by number from 0.";

/// Breaks `text` into lines of at most `width` characters, each after `indent`.
std::string wrapped(std::string_view text, std::string_view indent, std::size_t width = 100) {
  std::string out(indent);
  std::size_t column = indent.size();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const bool fresh = column == indent.size();
    if (!fresh && column + 1 + word.size() > width) {
      out += fmt::format("\n{}{}", indent, word);
      column = indent.size() + word.size();
    } else {
      out += fmt::format("{}{}", fresh ? "" : " ", word);
      column += word.size() + (fresh ? 0 : 1);
    }
    if (end < text.size() && text[end] == '\n') {
      out += fmt::format("\n{}", indent);
      column = indent.size();
    }
    at = end + 1;
  }
  return out + '\n';
}

std::string unit_of(Dimension dim) {
  return dim == dimension::none ? "" : fmt::format(" [{}]", si_unit(dim));
}

/// "number [m], positive"
std::string value_text(const Kind& kind) {
  if (const auto* number = std::get_if<Number>(&kind)) {
    const std::string range = text_of(number->range);
    return fmt::format("number{}{}{}", unit_of(number->dim), range.empty() ? "" : ", ", range);
  }
  if (const auto* vector = std::get_if<Vector>(&kind)) return "array of numbers" + unit_of(vector->dim);
  if (const auto* whole = std::get_if<Whole>(&kind)) {
    const bool bounded = whole->most <= 65536;
    return bounded ? fmt::format("whole number, {} to {}", whole->least, whole->most) : "whole number";
  }
  if (const auto* inner = std::get_if<Inner>(&kind)) return header(*inner->table);
  if (const auto* special = std::get_if<Special>(&kind)) return std::string(special->is);
  const std::string text = text_of(kind);
  for (const std::string_view article : {"a ", "an ", "the "})
    if (text.starts_with(article)) return text.substr(article.size());
  return text;
}

std::string facts(const Key& key) {
  const std::string place = place_of(key), otherwise = default_of(key);
  return fmt::format("{}{}{}{}", place.empty() ? "" : "of ", place, place.empty() ? "" : "; ",
                     otherwise.starts_with("required") ? otherwise : "default: " + otherwise);
}

/// A value that the key may have, its default if that is one.
std::string example(const Key& key) {
  if (const auto* vector = std::get_if<Vector>(&key.kind))
    return vector->dim == dimension::none ? "[1, 0]" : "[0, 0]";
  if (std::holds_alternative<Flags>(key.kind)) return "[false, false]";
  if (const std::string standard = standard_of(key); !standard.empty()) return standard;
  if (const auto* number = std::get_if<Number>(&key.kind)) {
    const Range& r = number->range;
    const double x = r.holds(1) ? 1 : std::isfinite(r.most) ? 0.5 * (r.least + r.most) : r.least + 1;
    return number->dim == dimension::none ? fmt::format("{}", x)
                                          : fmt::format("\"{} {}\"", x, si_unit(number->dim));
  }
  if (const auto* whole = std::get_if<Whole>(&key.kind)) return fmt::format("{}", whole->least);
  if (const auto* words = std::get_if<Words>(&key.kind))
    return fmt::format("\"{}\"", words->all().front().text);
  if (const auto* special = std::get_if<Special>(&key.kind)) return std::string(special->example);
  if (std::holds_alternative<TwoGroups>(key.kind)) return R"(["melt", "gas"])";
  if (std::holds_alternative<Copies>(key.kind)) return "[4, 4, 1]";
  return std::holds_alternative<Flag>(key.kind) ? "false" : fmt::format("\"{}\"", key.name);
}

/// A bar would end the cell of a table.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

}  // namespace

std::string reference_text() {
  std::string out = wrapped(about, "");
  for (const KeyTable* table : all) {
    out += '\n' +
           wrapped(fmt::format("{}  {}", table->name.empty() ? "Top level" : header(*table), table->sentence),
                   "");
    for (const Key& key : keys_of(*table)) {
      out += fmt::format("  {}: {}; {}\n", key.name, value_text(key.kind), facts(key));
      if (!key.sentence.empty()) out += wrapped(key.sentence, "      ");
    }
  }
  return out;
}

std::string reference_markdown() {
  std::string out =
      fmt::format("# Keys of a scene\n\nMade by `peperite keys --markdown`; a test compares.\n\n{}\n", about);
  for (const KeyTable* table : all) {
    out +=
        fmt::format("\n## {}\n\n{}\n\n| key | value | of | default | meaning |\n|---|---|---|---|---|\n",
                    table->name.empty() ? "Top level" : fmt::format("`{}`", header(*table)), table->sentence);
    for (const Key& key : keys_of(*table))
      out += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, cell(value_text(key.kind)),
                         cell(place_of(key)), cell(default_of(key)), cell(key.sentence));
  }
  return out;
}

std::string reference_toml() {
  std::string out = wrapped(about, "# ");
  for (const KeyTable* table : all) {
    out += '\n' + wrapped(table->sentence, "# ");
    if (!table->name.empty()) out += header(*table) + '\n';
    for (const Key& key : keys_of(*table))
      if (!std::holds_alternative<Inner>(key.kind))
        out += wrapped(fmt::format("{}{}({}; {})", key.sentence, key.sentence.empty() ? "" : " ",
                                   value_text(key.kind), facts(key)),
                       "# ") +
               fmt::format("#{} = {}\n", key.name, example(key));
  }
  return out;
}

}  // namespace sph::keys
