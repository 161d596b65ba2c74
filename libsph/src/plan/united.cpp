#include "sph/plan/united.hpp"

#include <cstring>

namespace sph {
namespace {

/// Copies the values of some rows to the first ones.
void copy_rows(const decomp::Column& from, std::span<const std::uint32_t> rows, decomp::Column& to) {
  const std::size_t width = from.width();
  for (std::size_t k = 0; k < rows.size(); ++k)
    std::memcpy(to.data() + k * width, from.data() + rows[k] * width, width);
}

}  // namespace

FieldSet fields_of(std::span<const ParticleSet> sets) {
  FieldSet fields;
  for (const ParticleSet& set : sets) fields |= set.particles.fields();
  return fields;
}

Particles unite(std::span<const ParticleSet> sets) {
  Particles all(sets.front().particles.dim(), fields_of(sets));
  std::size_t rows = 0;
  for (const ParticleSet& set : sets) rows += set.particles.owned();
  all.table().resize(rows, 0);
  for (const Field f : all.fields().list()) {
    decomp::Column& to = all.table().column(all.column(f));
    std::byte* at = to.data();
    for (const ParticleSet& set : sets) {
      const std::size_t bytes = set.particles.owned() * to.width();
      if (bytes == 0) continue;
      if (set.particles.has(f))
        std::memcpy(at, set.particles.table().column(set.particles.column(f)).data(), bytes);
      else
        std::memset(at, 0, bytes);
      at += bytes;
    }
  }
  return all;
}

decomp::Payload unite(decomp::Payload of_set, std::span<const ParticleSet> sets, std::size_t set) {
  std::size_t before = 0, after = 0;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    if (k < set) before += sets[k].particles.owned();
    if (k > set) after += sets[k].particles.owned();
  }
  const std::uint64_t first = of_set.offset.front(), last = of_set.offset.back();
  of_set.offset.insert(of_set.offset.begin(), before, first);
  of_set.offset.insert(of_set.offset.end(), after, last);
  return of_set;
}

void divide(const Particles& all, const Scene& scene, std::span<ParticleSet> sets, decomp::Payload& carried,
            std::size_t carrier) {
  const auto* group = all.data<Field::group>();
  for (std::size_t k = 0; k < sets.size(); ++k) {
    Particles& set = sets[k].particles;
    std::vector<std::uint32_t> rows;
    for (std::uint32_t i = 0; i < all.owned(); ++i)
      if ((scene.groups[group[i]].kind == GroupKind::grain) == set.has(Field::radius)) rows.push_back(i);
    set.table().resize(rows.size(), 0);
    for (const Field f : (set.fields() & all.fields()).list())
      copy_rows(all.table().column(all.column(f)), rows, set.table().column(set.column(f)));
    if (k != carrier || carried.rows() == 0) continue;
    std::vector<std::uint64_t> offset{carried.offset.front()};
    for (const std::uint32_t i : rows)
      offset.push_back(offset.back() + carried.offset[i + 1] - carried.offset[i]);
    carried.offset.assign(offset.begin(), offset.end());
  }
}

}  // namespace sph
