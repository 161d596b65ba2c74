#include "scene/scene_writer.hpp"

#include <fmt/format.h>

namespace sph {

void SceneWriter::header(std::string_view text) { out_ += fmt::format("\n{}\n", text); }
void SceneWriter::raw(std::string_view key, std::string_view value) {
  out_ += fmt::format("{} = {}\n", key, value);
}

void SceneWriter::vector(std::string_view key, const Double3& x) {
  std::string list;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dim_); ++a) list += (a == 0 ? "" : ", ") + real(x[a]);
  raw(key, fmt::format("[{}]", list));
}

std::string SceneWriter::quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (code < 0x20 || code == 0x7f)
      out += fmt::format("\\u{:04X}", code);
    else
      out += c;
  }
  return out + '"';
}

std::string SceneWriter::real(double x) {
  std::string text = fmt::format("{}", x);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace sph
