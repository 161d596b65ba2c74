#include "sph/core/fingerprint.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace sph {
namespace {

/// Integer modulo 2^128: a sum of these does not depend on the order.
struct Sum128 {
  std::uint64_t low = 0;
  std::uint64_t high = 0;

  void add(XXH128_hash_t h) {
    low += h.low64;
    high += h.high64 + (low < h.low64 ? 1 : 0);
  }

  /// Half words have room for the carries of 2^32 ranks, which a sum of whole words would lose.
  void all_reduce(const decomp::Comm& comm) {
    constexpr std::uint64_t half = 0xffffffffU;
    std::array<std::uint64_t, 4> word{low & half, low >> 32, high & half, high >> 32};
    comm.sum(std::span<std::uint64_t>(word));
    for (std::size_t i = 1; i < word.size(); ++i) word[i] += word[i - 1] >> 32;
    low = (word[0] & half) | (word[1] << 32);
    high = (word[2] & half) | (word[3] << 32);
  }
};

/// A particle's state as one run of bytes: its state fields in the order of the field table.
class Record {
 public:
  explicit Record(const Particles& particles) : particles_(particles) {
    std::size_t length = 0;
    for (Field f : state_of(particles.fields()).without(output_averages).list()) {
      const decomp::Column& column = particles.table().column(particles.column(f));
      parts_.push_back({f, column.data(), column.width()});
      length += column.width();
    }
    bytes_.resize(length);
  }

  [[nodiscard]] std::span<const std::byte> of(std::size_t row, const Wrap& wrap) {
    std::byte* to = bytes_.data();
    for (const Part& part : parts_) {
      std::memcpy(to, part.data + row * part.width, part.width);
      if (part.field == Field::position) wrap_in_place(to, wrap);
      to += part.width;
    }
    return bytes_;
  }

 private:
  struct Part {
    Field field;
    const std::byte* data;
    std::size_t width;
  };

  void wrap_in_place(std::byte* to, const Wrap& wrap) const {
    std::array<std::int64_t, 3> x{};
    const std::size_t width = sizeof(std::int64_t) * static_cast<std::size_t>(particles_.dim());
    std::memcpy(x.data(), to, width);
    for (int a = 0; a < particles_.dim(); ++a)
      x[static_cast<std::size_t>(a)] = wrap(a, x[static_cast<std::size_t>(a)]);
    std::memcpy(to, x.data(), width);
  }

  const Particles& particles_;
  std::vector<Part> parts_;
  std::vector<std::byte> bytes_;
};

/// A contact counts from both of its sides, which must agree.
void add_contacts(const Particles& particles, const ContactEntries& contacts, Sum128& sum) {
  const decomp::Payload& p = *contacts.payload;
  const std::uint64_t* id = particles.data<Field::id>();
  for (std::size_t row = 0; row < p.rows(); ++row)
    for (std::uint64_t at = p.offset[row]; at < p.offset[row + 1]; at += contacts.width)
      sum.add(XXH3_128bits_withSeed(p.bytes.data() + at, contacts.width, ~id[row]));
}

XXH128_hash_t hash_of(const GlobalState& global, const PositionScale& scale) {
  const std::array<std::uint64_t, 6> record{std::bit_cast<std::uint64_t>(global.step),
                                            std::bit_cast<std::uint64_t>(global.time),
                                            std::bit_cast<std::uint64_t>(global.dt),
                                            std::bit_cast<std::uint64_t>(global.max_speed),
                                            std::bit_cast<std::uint64_t>(global.max_acceleration),
                                            std::bit_cast<std::uint64_t>(scale.quantum)};
  std::vector<std::uint64_t> words(record.begin(), record.end());
  if (global.fluid_volume != FluidVolume{}) {
    words.push_back(static_cast<std::uint64_t>(global.fluid_volume.start));
    words.push_back(static_cast<std::uint64_t>(global.fluid_volume.now));
  }
  if (global.motion != CommonMotion{}) {
    for (const double v : global.motion.velocity) words.push_back(std::bit_cast<std::uint64_t>(v));
    words.push_back(std::bit_cast<std::uint64_t>(global.motion.unlike));
    words.push_back(std::bit_cast<std::uint64_t>(global.motion.largest));
  }
  if (global.flow.interval != 0) {
    words.push_back(std::bit_cast<std::uint64_t>(global.flow.interval));
    words.push_back(static_cast<std::uint64_t>(global.flow.left));
  }
  if (!global.throughput.passages.empty()) words.push_back(global.throughput.id_stride);
  for (const Passage& passage : global.throughput.passages) {
    words.push_back(static_cast<std::uint64_t>(passage.count));
    for (const double x : passage.amounts) words.push_back(std::bit_cast<std::uint64_t>(x));
    for (const double x : passage.momentum) words.push_back(std::bit_cast<std::uint64_t>(x));
    words.push_back(std::bit_cast<std::uint64_t>(passage.kinetic_energy));
    words.push_back(std::bit_cast<std::uint64_t>(passage.beside));
  }
  for (const Inflow& inflow : global.inflows) {
    words.push_back(static_cast<std::uint64_t>(inflow.receivers));
    words.push_back(std::bit_cast<std::uint64_t>(inflow.due));
  }
  for (const WallState& wall : global.walls)
    for (std::size_t a = 0; a < 3; ++a) {
      words.push_back(std::bit_cast<std::uint64_t>(wall.offset[a]));
      words.push_back(std::bit_cast<std::uint64_t>(wall.velocity[a]));
      words.push_back(std::bit_cast<std::uint64_t>(wall.force[a]));
    }
  for (const BodyState& body : global.bodies)
    for_each_number(body, [&](const char*, std::size_t, const auto& number) {
      words.push_back(std::bit_cast<std::uint64_t>(number));
    });
  return XXH3_128bits(words.data(), words.size() * sizeof words[0]);
}

}  // namespace

std::string fingerprint(const decomp::Comm& comm, const Particles& particles, const GlobalState& global,
                        const PositionScale& scale, const Wrap& wrap, const ContactEntries& contacts) {
  Sum128 sum;
  Record record(particles);
  const std::uint64_t* id = particles.data<Field::id>();
  for (std::size_t row = 0; row < particles.owned(); ++row) {
    const std::span<const std::byte> bytes = record.of(row, wrap);
    sum.add(XXH3_128bits_withSeed(bytes.data(), bytes.size(), id[row]));
  }
  if (contacts.payload != nullptr) add_contacts(particles, contacts, sum);
  sum.all_reduce(comm);
  sum.add(hash_of(global, scale));
  return fmt::format("{:016x}{:016x}", sum.high, sum.low);
}

}  // namespace sph
