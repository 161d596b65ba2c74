#include "keys/scene_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace sph {
namespace {

bool applies(const keys::KeyTable& table, const keys::Key& key, const Scene& scene, void* owner) {
  if (key.scenes.holds != nullptr && !key.scenes.holds(scene)) return false;
  return std::ranges::all_of(key.where, [&](const keys::Where& where) {
    if (where.key.empty()) return true;
    const keys::Key& selector = table[where.key];
    const auto& words = std::get<keys::Words>(selector.kind);
    std::string_view word = words.all().front().text;
    if (selector.member.in != nullptr) {
      const keys::Value value = selector.member.in(owner);
      const auto& at = std::get<keys::Enumerator>(value);
      word = words.text_of(at.get(at.at));
    }
    return where.holds(word);
  });
}

}  // namespace

void SceneWriter::header(const keys::KeyTable& table) { out_ += fmt::format("\n{}\n", keys::header(table)); }
void SceneWriter::raw(std::string_view key, std::string_view value) {
  out_ += fmt::format("{} = {}\n", key, value);
}

void SceneWriter::write(const keys::KeyTable& table, void* owner) {
  for (const keys::Key& key : table.keys)
    if (key.member.in != nullptr && applies(table, key, *scene_, owner)) put(key, key.member.in(owner));
}

void SceneWriter::put(const keys::Key& key, const keys::Value& value) {
  const auto one = [&]<class T>(const T& x) {
    if constexpr (std::is_same_v<T, double>) {
      if (std::get<keys::Number>(key.kind).range.holds(x)) number(key.name, x);
    } else if constexpr (std::is_same_v<T, Double3>) {
      vector(key.name, x);
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!x.empty() || !std::holds_alternative<keys::File>(key.kind)) text(key.name, x);
    } else if constexpr (std::is_same_v<T, std::array<int, 2>>) {
      raw(key.name, fmt::format("[{}, {}]", name_of(x[0]), name_of(x[1])));
    } else if constexpr (std::is_same_v<T, std::array<std::int64_t, 3>> ||
                         std::is_same_v<T, std::array<bool, 3>>) {
      const std::span axes(x.begin(), static_cast<std::size_t>(scene_->dim));
      raw(key.name, fmt::format("[{}]", fmt::join(axes, ", ")));
    } else {
      raw(key.name, fmt::format("{}", x));
    }
  };
  std::visit(
      [&]<class T>(const T& at) {
        if constexpr (std::is_same_v<T, keys::Enumerator>)
          text(key.name, std::get<keys::Words>(key.kind).text_of(at.get(at.at)));
        else if constexpr (std::is_same_v<T, keys::Named>)
          index(key, *at.index);
        else if constexpr (requires { at->has_value(); })
          at->has_value() ? one(**at) : void();
        else
          one(*at);
      },
      value);
}

void SceneWriter::index(const keys::Key& key, int k) {
  const auto& name = std::get<keys::NameOf>(key.kind);
  if (k < 0 && !name.or_none) return;
  if (name.what == "group")
    raw(key.name, name_of(k));
  else
    text(key.name, scene_->grains.names()[static_cast<std::size_t>(k)]);
}

void SceneWriter::vector(std::string_view key, const Double3& x) {
  std::string list;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a)
    list += (a == 0 ? "" : ", ") + real(x[a]);
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

std::string SceneWriter::name_of(int group) const {
  return quoted(group < 0 ? "none" : scene_->groups[static_cast<std::size_t>(group)].name);
}

}  // namespace sph
