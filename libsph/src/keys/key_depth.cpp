#include "keys/key_depth.hpp"

#include <algorithm>

namespace sph::toml_tree {
namespace {

/// Where the text in quotes that begins at `at` ends: one behind its last quote, or at the end of the line or
/// the document where that is missing.
std::size_t behind_text(std::string_view toml, std::size_t at) {
  const char quote = toml[at];
  const std::string_view three = toml.substr(at, 3);
  const bool lines = three.size() == 3 && three[1] == quote && three[2] == quote;
  for (std::size_t k = at + (lines ? 3 : 1); k < toml.size(); ++k) {
    if (toml[k] == '\\' && quote == '"')
      ++k;
    else if (lines && toml.substr(k, 3) == three)
      return std::min({toml.find_first_not_of(quote, k), k + 5, toml.size()});  // its last two may be quotes
    else if (!lines && (toml[k] == quote || toml[k] == '\n'))
      return toml[k] == quote ? k + 1 : k;
  }
  return toml.size();
}

/// What may stand between the first and the last dot of one key, besides texts in quotes.
bool within_key(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || c == '_' || c == '-' || c == ' ' || c == '\t' || static_cast<unsigned char>(c) >= 0x80;
}

TextPlace place_of(std::string_view toml, std::size_t at) {
  const std::string_view before = toml.substr(0, at);
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  return {1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')), at - line_begin + 1};
}

}  // namespace

std::optional<TextPlace> deep_key(std::string_view toml) {
  std::size_t parts = 1;
  for (std::size_t at = 0; at < toml.size();) {
    const char c = toml[at];
    if (c == '"' || c == '\'') {
      at = behind_text(toml, at);
      continue;
    }
    if (c == '#') {
      at = std::min(toml.find('\n', at), toml.size());
      continue;
    }
    if (c == '.' && ++parts > most_key_parts) return place_of(toml, at);
    if (c != '.' && !within_key(c)) parts = 1;
    ++at;
  }
  return std::nullopt;
}

}  // namespace sph::toml_tree
