// Writes a scene as TOML. Numbers are the shortest texts that read back to the same bits.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "keys/all_keys.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class SceneWriter {
 public:
  explicit SceneWriter(const Scene& scene) : scene_(&scene) {}

  /// All keys with a member that have a meaning in this scene. A number that its key does not allow, 0 for "no
  /// servo", is left out, as are empty paths and values that are not given.
  template <class Owner>
  void keys(const keys::Table<Owner>& table, Owner owner) {
    write(table, &owner);
  }
  /// The same below the header of the table.
  template <class Owner>
  void table(const keys::Table<Owner>& table, const Owner& owner) {
    header(table);
    keys(table, owner);
  }
  void header(const keys::KeyTable& table);
  void raw(std::string_view key, std::string_view value);
  void text(std::string_view key, std::string_view value) { raw(key, quoted(value)); }
  void number(std::string_view key, double x) { raw(key, real(x)); }
  void vector(std::string_view key, const Double3& x);
  [[nodiscard]] std::string take() { return std::move(out_); }

  [[nodiscard]] static std::string quoted(std::string_view text);
  /// Always a TOML float: an integer "-0" would lose its sign.
  [[nodiscard]] static std::string real(double x);
  /// The name of a group, quoted; "none" for -1.
  [[nodiscard]] std::string name_of(int group) const;

 private:
  void write(const keys::KeyTable& table, void* owner);
  void put(const keys::Key& key, const keys::Value& value);
  void index(const keys::Key& key, int k);

  const Scene* scene_;
  std::string out_;
};

/// [contact] and its pairs.
void write_contacts(SceneWriter& out, const Scene& scene);
void write_drag(SceneWriter& out, const Scene& scene);
/// A [[group]] of grains.
void write_material(SceneWriter& out, const Group& group, const ContactLaw& law);
/// domain.leaves; [[inlet]] and [[outlet]]
void write_leaves(SceneWriter& out, const Domain& domain);
void write_openings(SceneWriter& out, const Domain& domain);
/// [[wall]] and [[stage]]
void write_walls(SceneWriter& out, const Scene& scene);
void write_meshes(SceneWriter& out, const Scene& scene);

}  // namespace sph
