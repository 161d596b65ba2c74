#include "decomp/box_exchange.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "transfer.hpp"

namespace decomp {
namespace {

constexpr int copy_tag = 211;
constexpr int fold_tag = 212;

Box intersection(const Box& a, const Box& b) {
  Box out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.lo[k] = std::max(a.lo[k], b.lo[k]);
    out.hi[k] = std::min(a.hi[k], b.hi[k]);
  }
  return out;
}

Box moved(const Box& box, const Int3& shift) {
  Box out = box;
  for (std::size_t k = 0; k < 3; ++k) out.lo[k] += shift[k], out.hi[k] += shift[k];
  return out;
}

bool holds(const Box& outer, const Box& inner) { return intersection(outer, inner) == inner; }

/// work(first byte, bytes) for each line of cells along x.
template <class Work>
void for_lines(const CellValues& values, const Box& cells, Work&& work) {
  const Box& f = values.frame;
  const std::int64_t nx = f.hi[0] - f.lo[0], ny = f.hi[1] - f.lo[1];
  const std::size_t bytes = static_cast<std::size_t>(cells.hi[0] - cells.lo[0]) * values.width;
  for (std::int64_t z = cells.lo[2]; z < cells.hi[2]; ++z)
    for (std::int64_t y = cells.lo[1]; y < cells.hi[1]; ++y) {
      const std::int64_t at = ((z - f.lo[2]) * ny + (y - f.lo[1])) * nx + (cells.lo[0] - f.lo[0]);
      work(values.data + static_cast<std::size_t>(at) * values.width, bytes);
    }
}

void add_integers(std::byte* to, const std::byte* from, std::size_t bytes) {
  for (std::size_t k = 0; k < bytes; k += sizeof(std::uint64_t)) {
    std::uint64_t a = 0, b = 0;
    std::memcpy(&a, to + k, sizeof a);
    std::memcpy(&b, from + k, sizeof b);
    a += b;
    std::memcpy(to + k, &a, sizeof a);
  }
}

}  // namespace

std::size_t cell_count(const Box& box) {
  if (box.empty()) return 0;
  std::size_t n = 1;
  for (std::size_t k = 0; k < 3; ++k) n *= static_cast<std::size_t>(box.hi[k] - box.lo[k]);
  return n;
}

std::size_t cell_count(std::span<const BoxPart> parts) {
  std::size_t n = 0;
  for (const BoxPart& part : parts) n += cell_count(part.cells);
  return n;
}

std::vector<BoxPeer> box_peers(Rank rank, const Int3& cells, const std::array<bool, 3>& periodic,
                               std::span<const Box> from, std::span<const Box> to) {
  const std::size_t size = from.size();
  const auto me = static_cast<std::size_t>(rank);
  Box most{{}, cells};
  for (std::size_t r = 0; r < size; ++r)
    if (!from[r].empty() && !holds(most, from[r])) throw std::logic_error("an owner's box leaves the grid");
  std::vector<Int3> shifts{{}};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!periodic[k]) continue;
    most.lo[k] -= cells[k];
    most.hi[k] += cells[k];
    std::vector<Int3> more;
    for (const Int3& s : shifts)
      for (int n = -1; n <= 1; ++n) {
        more.push_back(s);
        more.back()[k] = n * cells[k];
      }
    shifts = std::move(more);
  }
  const auto overlaps = [&](const Box& owned, const Box& wanted) {
    std::vector<BoxPart> parts;
    for (const Int3& s : shifts) {
      const Box common = intersection(moved(owned, s), wanted);
      if (!common.empty()) parts.push_back({moved(common, {-s[0], -s[1], -s[2]}), s});
    }
    return parts;
  };
  for (std::size_t k = 0; k < 3; ++k)
    if (!periodic[k]) most.lo[k] = INT64_MIN, most.hi[k] = INT64_MAX;
  std::vector<BoxPeer> peers;
  for (std::size_t r = 0; r < size; ++r) {
    if (!to[r].empty() && !holds(most, to[r])) throw std::logic_error("a box reaches over a whole period");
    if (r != me && !intersection(from[r], from[me]).empty()) throw std::logic_error("a cell has two owners");
    BoxPeer peer{static_cast<Rank>(r), overlaps(from[me], to[r]), overlaps(from[r], to[me])};
    if (!peer.send.empty() || !peer.receive.empty()) peers.push_back(std::move(peer));
  }
  return peers;
}

BoxExchange::BoxExchange(const Comm& comm, const Int3& cells, const std::array<bool, 3>& periodic,
                         std::span<const Box> from, std::span<const Box> to)
    : comm_(&comm) {
  const auto size = static_cast<std::size_t>(comm.size());
  if (from.size() != size || to.size() != size) throw std::logic_error("boxes of all ranks are needed");
  for (BoxPeer& peer : box_peers(comm.rank(), cells, periodic, from, to))
    peers_.push_back({std::move(peer), {}, {}});
}

namespace {

/// Cells of a part in the frame of their owner, or of who gets them.
struct AtOwner {
  Box operator()(const BoxPart& part) const { return part.cells; }
};
struct AtCopy {
  Box operator()(const BoxPart& part) const { return moved(part.cells, part.shift); }
};

template <class Place>
void pack(std::span<const CellValues> values, const std::vector<BoxPart>& parts, Place place,
          std::vector<std::byte>& out) {
  out.clear();
  for (const CellValues& v : values)
    for (const BoxPart& part : parts)
      for_lines(v, place(part),
                [&](const std::byte* line, std::size_t bytes) { out.insert(out.end(), line, line + bytes); });
}

/// put(line of cells, its part of the message, bytes).
template <class Place, class Put>
void unpack(std::span<const CellValues> values, const std::vector<BoxPart>& parts, Place place,
            std::span<const std::byte> in, Put put) {
  const std::byte* at = in.data();
  for (const CellValues& v : values)
    for (const BoxPart& part : parts)
      for_lines(v, place(part), [&](std::byte* line, std::size_t bytes) {
        put(line, at, bytes);
        at += bytes;
      });
}

/// Where both are one array its owner's cells are not copied onto themselves.
std::vector<BoxPart> without_own(std::vector<BoxPart> parts, std::span<const CellValues> a,
                                 std::span<const CellValues> b) {
  if (!a.empty() && a.front().data == b.front().data)
    std::erase_if(parts, [](const BoxPart& part) { return part.shift == Int3{}; });
  return parts;
}

}  // namespace

std::size_t BoxExchange::cells_sent() const {
  std::size_t n = 0;
  for (const Peer& peer : peers_)
    if (!is_self(peer)) n += cell_count(peer.send);
  return n;
}

void BoxExchange::start(std::vector<BoxPart> BoxPeer::*in, std::size_t width, int tag) {
  for (Peer& peer : peers_) {
    if (is_self(peer)) continue;
    peer.in.resize(cell_count(peer.*in) * width);
    start_receive(*comm_, peer.in, peer.rank, tag, requests_);
  }
  for (Peer& peer : peers_)
    if (!is_self(peer)) start_send(*comm_, peer.out, peer.rank, tag, requests_);
}

void BoxExchange::begin(std::span<const CellValues> from, std::span<const CellValues> to) {
  if (under_way_) throw std::logic_error("an exchange begun before the last one ended");
  under_way_ = true;
  to_.assign(to.begin(), to.end());
  std::size_t width = 0;
  for (const CellValues& v : from) width += v.width;
  for (Peer& peer : peers_) {
    const std::vector<BoxPart> parts = is_self(peer) ? without_own(peer.send, from, to) : peer.send;
    pack(from, parts, AtOwner{}, peer.out);
    if (is_self(peer))
      unpack(to, parts, AtCopy{}, peer.out,
             [](std::byte* line, const std::byte* in, std::size_t bytes) { std::memcpy(line, in, bytes); });
  }
  start(&BoxPeer::receive, width, copy_tag);
}

void BoxExchange::end() {
  if (!under_way_) throw std::logic_error("an exchange ended but not begun");
  wait_all(requests_);
  for (Peer& peer : peers_)
    if (!is_self(peer))
      unpack(to_, peer.receive, AtCopy{}, peer.in,
             [](std::byte* line, const std::byte* in, std::size_t bytes) { std::memcpy(line, in, bytes); });
  under_way_ = false;
}

void BoxExchange::fold(std::span<const CellValues> to, std::span<const CellValues> from) {
  if (under_way_) throw std::logic_error("an exchange begun before the last one ended");
  std::size_t width = 0;
  for (const CellValues& v : to) {
    if (v.width % sizeof(std::int64_t) != 0) throw std::logic_error("cells that fold hold 64-bit integers");
    width += v.width;
  }
  for (Peer& peer : peers_)
    pack(to, is_self(peer) ? without_own(peer.receive, to, from) : peer.receive, AtCopy{}, peer.out);
  start(&BoxPeer::send, width, fold_tag);
  wait_all(requests_);
  for (Peer& peer : peers_)
    if (is_self(peer))
      unpack(from, without_own(peer.send, to, from), AtOwner{}, peer.out, add_integers);
    else
      unpack(from, peer.send, AtOwner{}, peer.in, add_integers);
}

}  // namespace decomp
