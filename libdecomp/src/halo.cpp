#include "decomp/halo.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "decomp/poison.hpp"
#include "halo_select.hpp"
#include "row_copy.hpp"
#include "transfer.hpp"

namespace decomp {
namespace {

constexpr int count_tag = 201;
constexpr int refresh_tag = 202;

Int3 negative(const Int3& s) { return {-s[0], -s[1], -s[2]}; }

/// First and one-past-last image of each peer in the list, which is ordered by rank.
std::vector<std::size_t> group_by_rank(std::span<const JaggedPartition::Image> images) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < images.size(); ++i)
    if (i == 0 || images[i].rank != images[i - 1].rank) first.push_back(i);
  first.push_back(images.size());
  return first;
}

bool contiguous(std::span<const std::uint32_t> ascending) {
  return ascending.empty() || ascending.back() - ascending.front() + 1 == ascending.size();
}

void grow(std::vector<std::byte>& buffer, std::size_t bytes) {
  if (buffer.size() < bytes) buffer.resize(bytes);
}

}  // namespace

HaloPlan::HaloPlan(const Comm& comm, const JaggedPartition& partition, std::int64_t reach, int dim,
                   int position, Table& table)
    : comm_(&comm), dim_(dim), position_(position), owned_(table.owned()) {
  if (table.column(position).width() != static_cast<std::size_t>(dim) * sizeof(std::int64_t))
    throw std::logic_error("column '" + table.column(position).name() + "' does not hold positions");
  const std::vector<JaggedPartition::Image> images = partition.neighbours(comm.rank(), reach);
  const RowSelector selector(table.as<std::int64_t>(position), owned_, dim, partition.quanta(comm.rank()),
                             reach);

  const std::vector<std::size_t> first = group_by_rank(images);
  std::vector<std::uint64_t> sent(images.size()), received(images.size());  // rows of each image
  for (std::size_t p = 0; p + 1 < first.size(); ++p) {
    Peer& peer = peers_.emplace_back();
    peer.rank = images[first[p]].rank;
    for (std::size_t i = first[p]; i < first[p + 1]; ++i) {
      const std::size_t before = peer.send.size();
      selector.select(partition.quanta(peer.rank), negative(images[i].shift), peer.send);
      sent[i] = peer.send.size() - before;
    }
    const auto mine = std::as_bytes(std::span(sent).subspan(first[p], first[p + 1] - first[p]));
    const auto theirs =
        std::as_writable_bytes(std::span(received).subspan(first[p], first[p + 1] - first[p]));
    if (is_self(peer)) {
      std::copy(mine.begin(), mine.end(), theirs.begin());
    } else {
      start_receive(comm, theirs, peer.rank, count_tag, requests_);
      start_send(comm, mine, peer.rank, count_tag, requests_);
    }
  }
  wait_all(requests_);

  // The peer with shift s in my list is me with shift -s in the peer's, so the two lists, both in ascending
  // shift, run through the common images in opposite directions. Messages use the sender's order.
  std::size_t row = owned_;
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    const std::size_t n = first[p + 1] - first[p];
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t begin = peers_[p].receive.size();
      const std::size_t rows = received[first[p] + i];
      peers_[p].segments.push_back({images[first[p + 1] - 1 - i].shift, begin, begin + rows});
      for (std::size_t k = 0; k < rows; ++k) peers_[p].receive.push_back(static_cast<std::uint32_t>(row++));
    }
  }
  if (row > std::numeric_limits<std::uint32_t>::max()) throw GuardError("more than 2^32 rows on one rank");
  halo_ = row - owned_;
  table.resize(owned_, 0);  // of the copies that were there nothing is left
  table.resize(owned_, halo_);
}

void HaloPlan::begin(Table& table, std::span<const int> columns) {
  if (!peers_.empty() && (table.owned() != owned_ || table.halo() != halo_))
    throw std::logic_error("halo plan used after the table's rows changed");
  std::vector<Rows> rows;
  for (const int c : columns)
    rows.push_back({table.column(c).data(), table.column(c).width(), c == position_});
  begin(rows);
}

void HaloPlan::begin(std::span<const Rows> of) {
  if (under_way_) throw std::logic_error("halo refresh begun before the last one ended");
  under_way_ = true;
  sent_.assign(of.begin(), of.end());
  if (poisons()) poison();

  std::size_t width = 0;
  for (const Rows& rows : sent_) width += rows.width;
  for (Peer& peer : peers_) {
    if (is_self(peer)) continue;
    grow(peer.in, peer.receive.size() * width);
    start_receive(*comm_, std::span(peer.in).first(peer.receive.size() * width), peer.rank, refresh_tag,
                  requests_);
  }
  for (Peer& peer : peers_) {
    if (is_self(peer)) continue;
    const std::size_t bytes = peer.send.size() * width;
    grow(peer.out, bytes);
    pack(peer);
    start_send(*comm_, std::span(peer.out).first(bytes), peer.rank, refresh_tag, requests_);
    bytes_sent_ += bytes;
  }
  for (Peer& peer : peers_)
    if (is_self(peer)) copy_to_self(peer);
}

void HaloPlan::progress() {
  int done = 0;
  check_mpi(MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &done, MPI_STATUSES_IGNORE),
            "MPI_Testall");
  if (done != 0) requests_.clear();
}

void HaloPlan::wait() { wait_all(requests_); }

void HaloPlan::end() {
  if (!under_way_) throw std::logic_error("halo refresh ended but not begun");
  wait();
  for (Peer& peer : peers_)
    if (!is_self(peer)) unpack(peer);
  under_way_ = false;
}

void HaloPlan::poison() {
  for (const Rows& rows : sent_)
    for (const Peer& peer : peers_)
      for (const std::uint32_t r : peer.receive) decomp::poison(rows.data + r * rows.width, rows.width);
}

void HaloPlan::copy_to_self(Peer& peer) {
  for (const Rows& rows : sent_) {
    copy_rows(rows.data, peer.receive, peer.send, rows.width);
    if (rows.positions) shift_positions(peer, rows);
  }
}

void HaloPlan::pack(Peer& peer) {
  std::byte* to = peer.out.data();
  for (const Rows& rows : sent_) {
    gather_rows(to, rows.data, peer.send, rows.width);
    to += peer.send.size() * rows.width;
  }
}

void HaloPlan::unpack(Peer& peer) {
  if (peer.receive.empty()) return;
  const std::byte* from = peer.in.data();
  for (const Rows& rows : sent_) {
    const std::size_t bytes = peer.receive.size() * rows.width;
    if (contiguous(peer.receive))
      std::memcpy(rows.data + peer.receive.front() * rows.width, from, bytes);
    else
      scatter_rows(rows.data, from, peer.receive, rows.width);
    if (rows.positions) shift_positions(peer, rows);
    from += bytes;
  }
}

void HaloPlan::shift_positions(const Peer& peer, const Rows& rows) const {
  for (const Segment& s : peer.segments) {
    if (s.shift == Int3{}) continue;
    for (std::size_t k = s.begin; k < s.end; ++k) {
      auto* x = reinterpret_cast<std::int64_t*>(rows.data + peer.receive[k] * rows.width);
      for (std::size_t a = 0; a < static_cast<std::size_t>(dim_); ++a) x[a] += s.shift[a];
    }
  }
}

HaloPlan HaloPlan::subset(std::span<const std::uint8_t> keep) const {
  if (!peers_.empty() && keep.size() != owned_ + halo_)
    throw std::logic_error("halo subset needs one flag for each owned and halo row");
  HaloPlan plan;
  plan.comm_ = comm_;
  plan.dim_ = dim_;
  plan.position_ = position_;
  plan.owned_ = owned_;
  plan.halo_ = halo_;
  for (const Peer& whole : peers_) {
    Peer& part = plan.peers_.emplace_back();
    part.rank = whole.rank;
    for (const std::uint32_t r : whole.send)
      if (keep[r] != 0) part.send.push_back(r);
    for (const Segment& s : whole.segments) {
      const std::size_t begin = part.receive.size();
      for (std::size_t k = s.begin; k < s.end; ++k)
        if (keep[whole.receive[k]] != 0) part.receive.push_back(whole.receive[k]);
      part.segments.push_back({s.shift, begin, part.receive.size()});
    }
  }
  return plan;
}

std::vector<std::uint8_t> HaloPlan::boundary(std::size_t owned) const {
  std::vector<std::uint8_t> sent(owned, 0);
  for (const Peer& peer : peers_)
    for (const std::uint32_t r : peer.send) sent[r] = 1;
  return sent;
}

std::size_t HaloPlan::count(bool self, std::vector<std::uint32_t> Peer::*rows) const {
  std::size_t sum = 0;
  for (const Peer& peer : peers_)
    if (is_self(peer) == self) sum += (peer.*rows).size();
  return sum;
}

std::size_t HaloPlan::rows_sent() const { return count(false, &Peer::send); }
std::size_t HaloPlan::rows_received() const { return count(false, &Peer::receive); }
std::size_t HaloPlan::rows_copied() const { return count(true, &Peer::receive); }

}  // namespace decomp
