// From boxes of cells to boxes of cells: the halo of a grid, its even partition and that of the particles, coarse grids
// on few ranks, whole grids on every rank. All ranks know all boxes, so who sends what to whom is found without a
// message. The way back folds: what was put down in copies of a cell is added to the cell, as integers, so that no
// order counts.
//     exchange.begin(from, to);  ...what needs no copy...  exchange.end();
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "decomp/comm.hpp"
#include "decomp/types.hpp"

namespace decomp {

/// Values of the cells of a box, x fastest, `width` bytes a cell.
struct CellValues {
  std::byte* data;
  Box frame;
  std::size_t width;
};
/// `components` values of each cell of `frame`.
template <class T>
[[nodiscard]] CellValues cell_values(std::span<T> values, const Box& frame, std::size_t components = 1) {
  return {reinterpret_cast<std::byte*>(values.data()), frame, components * sizeof(T)};
}
[[nodiscard]] std::size_t cell_count(const Box& box);  ///< 0 of an empty one

/// Cells of an owner, which are at x + shift in the frame of who gets them.
struct BoxPart {
  Box cells;
  Int3 shift;
};
/// What one rank sends to another, which may be itself, and gets from it: by shift, the same order on both sides.
struct BoxPeer {
  Rank rank;
  std::vector<BoxPart> send, receive;
};
/// Peers of rank `me`, ascending, of an exchange between boxes of all ranks (BoxExchange). Looks at every rank.
[[nodiscard]] std::vector<BoxPeer> box_peers(Rank me, const Int3& cells, const std::array<bool, 3>& periodic,
                                             std::span<const Box> from, std::span<const Box> to);
[[nodiscard]] std::size_t cell_count(std::span<const BoxPart> parts);

class BoxExchange {
 public:
  /// Boxes of all ranks [cells]. Those of `from` lie in the grid and share no cell. Those of `to` may overlap, and reach
  /// over periodic faces by up to a period; what of them lies in no box of `from` is left as it is. Boxes may be empty.
  /// Throws std::logic_error where that is not so.
  BoxExchange(const Comm& comm, const Int3& cells, const std::array<bool, 3>& periodic,
              std::span<const Box> from, std::span<const Box> to);

  /// Copies the k-th of `from` to the k-th of `to`, for all k. Frames hold this rank's boxes; the two may be one array,
  /// whose cells outside of `from` are then its halo. Collective over those who share cells.
  void begin(std::span<const CellValues> from, std::span<const CellValues> to);
  void end();
  void copy(std::span<const CellValues> from, std::span<const CellValues> to) {
    begin(from, to);
    end();
  }
  /// The way back, of 64-bit integers: adds what the cells of `to` hold to their owners in `from` (modulo 2^64). Where
  /// the two are one array, what a rank has in its own cells is there already.
  void fold(std::span<const CellValues> to, std::span<const CellValues> from);

  [[nodiscard]] std::size_t cells_sent() const;  ///< to other ranks

 private:
  struct Peer : BoxPeer {
    std::vector<std::byte> out, in;
  };
  [[nodiscard]] bool is_self(const Peer& peer) const { return peer.rank == comm_->rank(); }
  void start(std::vector<BoxPart> BoxPeer::*in, std::size_t width, int tag);

  const Comm* comm_;
  std::vector<Peer> peers_;  ///< ascending rank
  std::vector<CellValues> to_;
  bool under_way_ = false;
  std::vector<MPI_Request> requests_;
};

}  // namespace decomp
