// Writes a scene as TOML, key by key. Numbers are the shortest texts that read back to the same bits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "scene/scene_resolve.hpp"

namespace sph {

template <class E>
std::string_view word(const Choices<E>& words, E value) {
  for (const auto& [name, v] : words)
    if (v == value) return name;
  return {};
}

class SceneWriter {
 public:
  explicit SceneWriter(int dim) : dim_(dim) {}
  void header(std::string_view text);
  void raw(std::string_view key, std::string_view value);
  void text(std::string_view key, std::string_view value) { raw(key, quoted(value)); }
  void number(std::string_view key, double x) { raw(key, real(x)); }
  void whole(std::string_view key, std::int64_t n) { raw(key, std::to_string(n)); }
  void whole(std::string_view key, std::uint64_t n) { raw(key, std::to_string(n)); }
  void whole(std::string_view key, int n) { raw(key, std::to_string(n)); }
  void flag(std::string_view key, bool on) { raw(key, on ? "true" : "false"); }
  void vector(std::string_view key, const Double3& x);
  [[nodiscard]] std::string take() { return std::move(out_); }

  [[nodiscard]] static std::string quoted(std::string_view text);
  /// Always a TOML float: an integer "-0" would lose its sign.
  [[nodiscard]] static std::string real(double x);

 private:
  int dim_;
  std::string out_;
};

/// [contact], [[group]], [[wall]] and [[stage]] of a scene of grains.
void write_grains(SceneWriter& out, const Scene& scene);

}  // namespace sph
