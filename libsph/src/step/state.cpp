#include "sph/step/state.hpp"

#include "sph/core/fingerprint.hpp"
#include "sph/plan/united.hpp"

namespace sph {

State::State(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale)
    : comm_(comm),
      scene_(scene),
      scale_(scale),
      wrap_(wrap_of(scene_, scale_)),
      parts_(comm_, scene_, scale_),
      distribution_(comm_, scene_, scale_) {
  for (const Parts::Set& set : parts_.sets)
    sets_.push_back({Particles(scene_.dim, set.fields),
                     set.stays,
                     {},
                     {},
                     HaloExchange(scene_.decomposition.overlap),
                     {},
                     set.owners});
}

const Particles& State::particles() const {
  if (sets_.size() == 1) return sets_.front().particles;
  if (!united_) united_.emplace(unite(sets_));
  return *united_;
}

std::int64_t State::particle_count() const {
  std::int64_t count = 0;
  for (const ParticleSet& set : sets_) count += set.census.count;
  return count;
}

decomp::Payload State::contacts() const {
  if (grains() == nullptr) return {};
  const std::size_t set = parts_.grains->set();
  return unite(grains()->pairs().pack(particles(set)), sets_, set);
}

std::string State::fingerprint() const {
  if (!has_history()) return sph::fingerprint(comm_, particles(), global_, scale_, wrap_);
  const decomp::Payload entries = contacts();
  return sph::fingerprint(comm_, particles(), global_, scale_, wrap_,
                          {&entries, grains()->pairs().lists().entry_bytes()});
}

}  // namespace sph
