#include "output/nearest_particle.hpp"

#include <array>
#include <limits>

#include "output/particle_values.hpp"

namespace sph {
namespace {

__extension__ typedef unsigned __int128 Square;  // coordinates have 61 bits

/// Squared distance and id as words whose lexicographic order is the order of nearness.
using Key = std::array<std::uint64_t, 3>;
constexpr Key farthest{~std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{0}};

Key key_of(const Simulation& s, const ParticleValues& of, const Wrap& wrap, const decomp::Int3& point,
           std::size_t row) {
  Square sum = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(s.scene().dim); ++a) {
    std::int64_t r = of.quanta(row, a) - point[a];
    r = r < 0 ? -r : r;
    if (wrap.period[a] > 0 && r > wrap.period[a] - r) r = wrap.period[a] - r;
    sum += static_cast<Square>(r) * static_cast<Square>(r);
  }
  return {static_cast<std::uint64_t>(sum >> 64), static_cast<std::uint64_t>(sum),
          s.particles().data<Field::id>()[row]};
}

/// The least key of all ranks, word by word.
Key least(const decomp::Comm& comm, const Key& mine) {
  Key out{};
  bool candidate = true;
  for (std::size_t k = 0; k < out.size(); ++k) {
    // The reduction knows signed maxima: flipping every bit but the first reverses and shifts the order.
    constexpr auto flip = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    const std::uint64_t word = candidate ? mine[k] : ~std::uint64_t{0};
    out[k] = static_cast<std::uint64_t>(comm.max(static_cast<std::int64_t>(word ^ flip))) ^ flip;
    candidate = candidate && mine[k] == out[k];
  }
  return out;
}

}  // namespace

std::uint64_t nearest_particle(const Simulation& s, const Double3& at) {
  const ParticleValues of(s);
  const Wrap wrap = s.wrap();
  decomp::Int3 point{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(s.scene().dim); ++a)
    point[a] = wrap(static_cast<int>(a), s.scale().quanta(at[a]));
  Key mine = farthest;
  for (std::size_t row = 0; row < s.particles().owned(); ++row)
    if (const Key key = key_of(s, of, wrap, point, row); key < mine) mine = key;
  return least(s.comm(), mine)[2];
}

}  // namespace sph
