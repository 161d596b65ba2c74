// Halo plan: which owned rows are copied to which rank, built once a rebuild and knowing no fields. The
// columns to refresh are named at the call, in two halves so that work overlaps the messages:
//     halo.begin(table, columns);  ...interior particles...  halo.end();
// Halo rows follow the owned rows, grouped by image; the copy of a position is the owner's plus that
// image's shift, an exact integer addition done once, by the receiver.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decomp/comm.hpp"
#include "decomp/partition.hpp"
#include "decomp/table.hpp"

namespace decomp {

class HaloPlan {
 public:
  /// A plan without peers.
  HaloPlan() = default;
  HaloPlan(HaloPlan&&) = default;
  HaloPlan& operator=(HaloPlan&&) = default;

  /// Finds the owned rows within `reach` quanta of each neighbouring box (an image of this rank's own box
  /// included) and exchanges how many there are; resizes the table's halo to fit. `position` is the column
  /// of Int3-like coordinates: dim int64 a row. Collective over neighbours only. No column is refreshed.
  /// Throws GuardError if an owned row lies outside this rank's box: its partners would be missed.
  HaloPlan(const Comm& comm, const JaggedPartition& partition, std::int64_t reach, int dim, int position,
           Table& table);

  /// Sends the named columns of the rows in the plan. Position columns get the image shift on arrival.
  /// Between begin and end the halo rows of these columns are undefined (poison.hpp);
  /// their owned rows may change as soon as begin returns.
  void begin(Table& table, std::span<const int> columns);
  /// The same of rows that are kept elsewhere.
  struct Rows {
    std::byte* data;    ///< of row 0, halo rows after the owned ones
    std::size_t width;  ///< bytes a row
    bool positions;     ///< a row begins with a position
  };
  void begin(std::span<const Rows> of);
  void progress();  ///< cheap; lets messages move while the caller computes between begin and end
  void wait();      ///< the waiting part of end, for callers that time it apart from unpacking
  void end();
  void refresh(Table& table, std::span<const int> columns) {
    begin(table, columns);
    end();
  }

  /// The same plan restricted to rows whose value in the 1-byte-per-row `keep` (owned + halo) is not 0.
  /// Owner and copies must agree on it. No communication.
  [[nodiscard]] HaloPlan subset(std::span<const std::uint8_t> keep) const;

  /// 1 for each owned row that is sent to anyone (the boundary), else 0. The converse holds too: only
  /// boundary rows can have a partner in the halo.
  [[nodiscard]] std::vector<std::uint8_t> boundary(std::size_t owned) const;

  [[nodiscard]] std::size_t rows_sent() const;      ///< to other ranks; times the widths: bytes a refresh
  [[nodiscard]] std::size_t rows_received() const;  ///< from other ranks
  [[nodiscard]] std::size_t rows_copied() const;    ///< to periodic images of this rank, without messages
  [[nodiscard]] std::size_t bytes_sent() const { return bytes_sent_; }  ///< since the plan was built

 private:
  /// Part of Peer::receive that belongs to one image.
  struct Segment {
    Int3 shift;  ///< added to positions on arrival
    std::size_t begin, end;
  };
  /// Everything shared with one rank (maybe this one): row receive[k] here is a copy of row send[k] there,
  /// and the other way round. One message each way a refresh: column after column, rows in this order.
  struct Peer {
    Rank rank = 0;
    std::vector<std::uint32_t> send;     ///< owned rows, by image; a row may be there for several
    std::vector<std::uint32_t> receive;  ///< halo rows, absolute, ascending
    std::vector<Segment> segments;
    std::vector<std::byte> out, in;
  };
  [[nodiscard]] bool is_self(const Peer& p) const { return p.rank == comm_->rank(); }
  [[nodiscard]] std::size_t count(bool self, std::vector<std::uint32_t> Peer::*rows) const;
  void poison();
  void copy_to_self(Peer& peer);
  void pack(Peer& peer);
  void unpack(Peer& peer);
  void shift_positions(const Peer& peer, const Rows& rows) const;

  const Comm* comm_ = nullptr;
  int dim_ = 0, position_ = -1;
  std::size_t owned_ = 0, halo_ = 0;  ///< of the table the plan was built for
  std::vector<Peer> peers_;           ///< ascending rank
  std::size_t bytes_sent_ = 0;
  // Of the refresh under way; memory is kept from one to the next.
  bool under_way_ = false;
  std::vector<Rows> sent_;
  std::vector<MPI_Request> requests_;
};

}  // namespace decomp
