// Contact lists of one rank: every pair of grains, or grain and wall, that may touch before the next rebuild,
// each pair once. Pairs sit in groups of eight, one SIMD lane each, those that touch before those that do not, both
// ordered by blocks of 64 rows: a pair of
// two owned rows belongs to the block of the smaller one, a pair with a halo row to that of the owned one.
// When a block's pairs and those of all earlier blocks are done, the sums of its rows are complete.
//
// The history of a contact lives in the list, beside its pair, oriented as the pair is. At a rebuild it
// travels with the grains: every owned grain carries an entry for each contact it has, keyed by the partner's
// id (or the wall's key), as the carrier sees it: forces and torques as they act on it (pairs/contact.hpp,
// Parity). It exists exactly while the
// pair touches: a step ends with grains where the next sweep will find them, so that a pair may have parted
// since its history was last looked at. Such a history is nobody's any more, near or far; until that sweep it
// is kept beside the lists, or the state would tell whether lists were rebuilt before it was written.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "decomp/comm.hpp"
#include "decomp/grid.hpp"
#include "decomp/memory.hpp"
#include "decomp/table.hpp"
#include "sph/core/particles.hpp"
#include "sph/pairs/contact.hpp"
#include "sph/pairs/neighbour_lists.hpp"
#include "sph/pairs/wall_places.hpp"

namespace sph {

/// Facets of one mesh beside one row: consecutive entries of the list of walls. Most cannot touch before the grain has moved on;
/// sweeps look at those that can (FacetContacts).
struct FacetRun {
  std::size_t first, last;  ///< entries
  std::uint32_t mesh;
  std::uint32_t near = 0;  ///< so many of them may touch ...
  Point3 at = {std::numeric_limits<double>::quiet_NaN(), 0,
               0};  ///< ... a grain near this place in the mesh's frame
};
struct FacetRuns {
  std::vector<FacetRun> runs;
  std::vector<std::uint32_t> near;  ///< which entries, of each run from its first on
};

/// Groups of eight pairs (i, j); j is a row, or of a wall its number (WallNumbers). Unused lanes hold i = j (rows), or a
/// wall that does not exist.
struct ContactGroups {
  static constexpr std::size_t lanes = 8;
  static constexpr std::uint32_t no_wall = ~std::uint32_t{0};
  decomp::LargeVector<std::uint32_t> i, j;  ///< [groups * lanes]
  std::vector<std::uint8_t> touching;       ///< [groups] bit l: lane l touched in the last step
  decomp::LargeVector<double> history;      ///< [those before `candidates`][components][lanes]
  std::size_t candidates = 0;               ///< the first of them
  /// Few candidates ever touch: those that have are in places here, in the order in which they did.
  static constexpr std::uint32_t no_place = ~std::uint32_t{0};
  std::vector<std::uint32_t> place;          ///< [candidates]
  decomp::LargeVector<double> late_history;  ///< [places][components][lanes]
  /// [groups] No pair of the group touches before grains have gone so far since the lists were made [m].
  std::vector<double> asleep;
  FacetRuns facets;  ///< of walls
  [[nodiscard]] std::size_t groups() const { return touching.size(); }
  /// Of a group that is no candidate, or has been one that touched.
  [[nodiscard]] const double* history_of(std::size_t group, std::size_t components) const {
    if (group < candidates) return history.data() + group * components * lanes;
    return late_history.data() + place[group - candidates] * components * lanes;
  }
  [[nodiscard]] bool remembers(std::size_t group) const {
    return group < candidates || place[group - candidates] != no_place;
  }
  /// Of any group, which has one from now on.
  [[nodiscard, gnu::always_inline]] double* remember(std::size_t group, std::size_t components) {
    if (group < candidates) return history.data() + group * components * lanes;
    std::uint32_t& at = place[group - candidates];
    if (at == no_place) at = add_place(components);
    return late_history.data() + at * components * lanes;
  }
  std::uint32_t add_place(std::size_t components);
  /// Lanes that touched.
  [[nodiscard]] std::int64_t contacts() const {
    std::int64_t n = 0;
    for (const std::uint8_t bits : touching) n += std::popcount(bits);
    return n;
  }
};

/// Consecutive rows of one class and the groups of pairs that belong to them.
struct ContactBlock {
  static constexpr std::size_t rows = 64;
  std::uint32_t first, last;
  struct Groups {
    std::size_t first, last;
  };
  Groups pairs;       ///< that touched when the lists were made
  Groups candidates;  ///< those that did not, by how far they were apart
  Groups walls;
  Groups facets;  ///< their runs
};

/// What must not change while contacts move between ranks, summed over all: both entries of a pair count,
/// since two ranks may need one each.
struct ContactCensus {
  std::uint64_t count = 0, keys = 0;
  std::uint64_t one_sided =
      0;  ///< pairs that parted, + from the one side, - from the other: 0 over all ranks
  friend bool operator==(const ContactCensus&, const ContactCensus&) = default;
};

class ContactLists {
 public:
  /// `parities`: of the doubles that a contact carries.
  explicit ContactLists(std::span<const Parity> parities)
      : parities_(parities.begin(), parities.end()), history_(parities.size()) {}

  /// Finds all pairs closer than r_i + r_j + skin, and grains closer than r_i + skin to a plane or facet. Rows of
  /// `fixed` groups do not touch each other or walls.
  void build(const Particles& particles, const decomp::CellGrid& grid, const decomp::Box& own_cells,
             std::int64_t reach, double skin, double quantum, const RowRanges& ranges,
             const std::vector<bool>& fixed, const WallsNow& walls);

  /// Histories of the contacts of owned rows, as entries { partner key, history as it acts on the row }.
  [[nodiscard]] decomp::Payload pack(const Particles& particles) const;
  /// What pack() has packed; build() must follow.
  void forget_histories();
  /// Puts the entries back after build(); those of owned row r are in row order[r] of `payload`. Those whose
  /// pair has parted stay beside the lists. Returns what has found its place in either.
  ContactCensus unpack(const Particles& particles, const decomp::Payload& payload,
                       std::span<const std::uint32_t> order, double quantum, const WallsNow& walls);
  /// An entry whose pair does not touch where it is now.
  struct Parted {
    std::uint32_t row;
    std::uint64_t key;  ///< of the partner
    bool listed;        ///< near enough for the lists, and looked at
  };
  [[nodiscard]] std::span<const Parted> parted() const { return parted_; }
  /// When the sweep begins that would have ended them; returns how many contacts they were of.
  std::int64_t forget_parted(const std::uint64_t* id);
  [[nodiscard]] std::int64_t carried() const { return carried_; }  ///< entries that unpack() put back
  /// What was packed on all ranks, and must be put back on all.
  [[nodiscard]] static ContactCensus census(const Particles& particles, const decomp::Payload& payload,
                                            int history);

  [[nodiscard]] std::span<const Parity> parities() const { return parities_; }
  [[nodiscard]] int history() const { return static_cast<int>(history_); }
  [[nodiscard]] std::size_t entry_bytes() const { return 8 * (1 + history_); }
  /// Blocks without halo partners come first.
  [[nodiscard]] std::span<const ContactBlock> interior() const {
    return std::span(blocks_).first(interior_blocks_);
  }
  [[nodiscard]] std::span<const ContactBlock> boundary() const {
    return std::span(blocks_).subspan(interior_blocks_);
  }
  [[nodiscard]] ContactGroups& pairs() { return pairs_; }
  [[nodiscard]] ContactGroups& walls() { return walls_; }
  [[nodiscard]] const ContactGroups& pairs() const { return pairs_; }
  [[nodiscard]] const ContactGroups& walls() const { return walls_; }
  [[nodiscard]] const WallNumbers& numbers() const { return numbers_; }  ///< of walls
  [[nodiscard]] std::size_t listed() const { return listed_; }  ///< pairs of grains, padding not counted

 private:
  std::vector<Parity> parities_;
  std::size_t history_;
  std::vector<ContactBlock> blocks_;
  std::size_t interior_blocks_ = 0;
  ContactGroups pairs_, walls_;
  WallNumbers numbers_;
  std::size_t listed_ = 0;
  std::int64_t carried_ = 0;
  std::vector<Parted> parted_;
  std::vector<std::byte> parted_entries_;
};

/// Takes out of what lists packed the contacts of grains `gone` on any rank, by their ids ascending; returns how many these
/// are, each counted by one rank. `id` of the rows, `history` as ContactLists has it.
std::int64_t forget_contacts(decomp::Payload& packed, const std::uint64_t* id,
                             std::span<const std::uint64_t> gone, int history);

}  // namespace sph
