// Made-up states for the tests of files and fingerprints: every bit follows from the id, so any cut of the
// particles can be compared with any other, and awkward values (-0, NaN with a payload, subnormals) occur.
#pragma once

#include <mpi.h>
#include <stdlib.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "decomp/comm.hpp"
#include "decomp/splitmix.hpp"
#include "decomp/table.hpp"
#include "sph/core/particles.hpp"

namespace sph::test {

/// A directory that all ranks share, removed at the end.
class ScratchDirectory {
 public:
  explicit ScratchDirectory(const decomp::Comm& comm) : comm_(comm) {
    std::string name = (std::filesystem::temp_directory_path() / "peperite_test_XXXXXX").string();
    if (comm.rank() == 0 && mkdtemp(name.data()) == nullptr) name.clear();
    path_ = comm.broadcast(name, 0);
  }
  ~ScratchDirectory() {
    comm_.barrier();
    std::error_code ignored;
    if (comm_.rank() == 0) std::filesystem::remove_all(path_, ignored);
    comm_.barrier();
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  const decomp::Comm& comm_;
  std::filesystem::path path_;
};

/// Runs `work(comm)` on the first `ranks` ranks, as if the program had been started on so many.
inline void on_ranks(const decomp::Comm& world, int ranks,
                     const std::function<void(const decomp::Comm&)>& work) {
  MPI_Comm part = MPI_COMM_NULL;
  MPI_Comm_split(world.get(), world.rank() < ranks ? 0 : MPI_UNDEFINED, world.rank(), &part);
  if (part != MPI_COMM_NULL) {
    {
      const decomp::Comm comm(part);
      work(comm);
    }
    MPI_Comm_free(&part);
  }
  world.barrier();
}

inline const FieldSet fluid_fields{Field::id,     Field::position, Field::velocity, Field::density,
                                   Field::mass,   Field::group,    Field::stress,   Field::pressure,
                                   Field::volume, Field::force};

inline double awkward(std::uint64_t key) {
  switch (decomp::splitmix(key) % 16) {
    case 0:
      return -0.0;
    case 1:
      return std::bit_cast<double>(0x7ff8000000000000U | (decomp::splitmix(key + 1) >> 16));
    case 2:
      return std::numeric_limits<double>::denorm_min();
    default:
      return static_cast<double>(static_cast<std::int64_t>(decomp::splitmix(key + 2))) * 0x1p-50;
  }
}

/// Ids are spread out, as they are when particles have come and gone.
inline std::uint64_t nth_id(std::uint64_t n) { return 3 * n * n + 7; }

inline void fill_row(Particles& particles, std::size_t row, std::uint64_t id) {
  for (Field f : particles.fields().list()) {
    decomp::Column& column = particles.table().column(particles.column(f));
    std::byte* to = column.data() + row * column.width();
    const std::size_t size = bytes(info(f).type);
    for (std::size_t c = 0; c * size < column.width(); ++c, to += size) {
      const std::uint64_t key = decomp::splitmix(id) + 64 * static_cast<std::uint64_t>(f) + c;
      std::uint64_t value = decomp::splitmix(key);
      if (f == Field::id) value = id;
      if (f == Field::group) value %= 3;
      if (f == Field::position) value %= 1000;
      if (info(f).type == Type::f64) value = std::bit_cast<std::uint64_t>(awkward(key));
      if (size == 4) {
        const auto narrow = static_cast<std::uint32_t>(value);
        std::memcpy(to, &narrow, size);
      } else {
        std::memcpy(to, &value, size);
      }
    }
  }
}

using Cut = std::function<int(std::uint64_t n, int ranks)>;  ///< rank that owns the n-th particle
inline int round_robin(std::uint64_t n, int ranks) {
  return static_cast<int>(n % static_cast<std::uint64_t>(ranks));
}
inline int scattered(std::uint64_t n, int ranks) { return round_robin(decomp::splitmix(n), ranks); }
inline int all_on_last(std::uint64_t, int ranks) { return ranks - 1; }

/// This rank's part of `count` particles in two or three dimensions, in descending order, with halo rows of
/// rubbish behind.
inline Particles make_state(const decomp::Comm& comm, std::uint64_t count, const Cut& cut, int dim = 2,
                            FieldSet fields = fluid_fields) {
  Particles particles(dim, fields);
  std::vector<std::uint64_t> mine;
  for (std::uint64_t n = count; n-- > 0;)
    if (cut(n, comm.size()) == comm.rank()) mine.push_back(nth_id(n));
  constexpr std::size_t halo = 5;
  particles.table().resize(mine.size(), halo);
  for (std::size_t row = 0; row < mine.size(); ++row) fill_row(particles, row, mine[row]);
  for (std::size_t row = 0; row < halo; ++row)
    fill_row(particles, mine.size() + row, 1000000 + static_cast<std::uint64_t>(comm.rank()));
  return particles;
}

/// Contact history of id: decomp::splitmix(id) % 4 entries of 8 bytes.
inline decomp::Payload make_history(const Particles& particles) {
  decomp::Payload history;
  for (std::size_t row = 0; row < particles.owned(); ++row) {
    const std::uint64_t id = particles.data<Field::id>()[row];
    for (std::uint64_t k = 0; k < decomp::splitmix(id) % 4; ++k) {
      const std::uint64_t entry = decomp::splitmix(id + k);
      const std::span<const std::byte> bytes = std::as_bytes(std::span(&entry, 1));
      history.bytes.insert(history.bytes.end(), bytes.begin(), bytes.end());
    }
    history.offset.push_back(history.bytes.size());
  }
  return history;
}

inline GlobalState make_global() {
  return {1200,
          0.1,
          1.0 / 3,
          2.5,
          9.81,
          {},
          {},
          {},
          {0.4, 7, 12, 1.0 / 7},
          {},
          {{{3, {0.1, 0.2, 1.0 / 3, 0, 0, 5}, {1, -1, 0.7}, 0.3, -1.0 / 9}, {}}, 4096}};
}
inline PositionScale make_scale() { return {0x1p-20, {-100, -200, 0}}; }
inline Wrap make_wrap() { return {{-100, -200, 0}, {400, 0, 0}}; }

}  // namespace sph::test
