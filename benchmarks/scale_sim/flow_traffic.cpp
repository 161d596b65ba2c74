#include "flow_traffic.hpp"

#include <algorithm>
#include <chrono>

#include "decomp/box_exchange.hpp"
#include "stokes/multigrid.hpp"

namespace scale_sim {
namespace {

using decomp::Box;

// As in libsph/src/stokes: level.cpp (power iteration), solver.cpp, exact_sum.hpp.
constexpr double power_steps = 12, number = 8, exact_sum = 69 * 8;

std::vector<int> some_of(int ranks, int most) {
  std::vector<int> out;
  if (ranks <= most)
    for (int r = 0; r < ranks; ++r) out.push_back(r);
  else
    for (int k = 0; k < most; ++k)
      out.push_back(2 * k < most ? k : static_cast<int>(static_cast<std::int64_t>(k) * ranks / most));
  return out;
}

Traffic of_rank(int rank, const stokes::Grid& grid, const std::vector<Box>& from,
                const std::vector<Box>& to) {
  Traffic sent, got;
  for (const decomp::BoxPeer& peer : decomp::box_peers(rank, grid.cells, grid.periodic_axes(), from, to)) {
    if (peer.rank == rank) continue;
    const auto add = [](Traffic& t, const std::vector<decomp::BoxPart>& parts) {
      if (parts.empty()) return;
      ++t.messages;
      t.cells += static_cast<double>(decomp::cell_count(parts));
    };
    add(sent, peer.send);
    add(got, peer.receive);
  }
  return {std::max(sent.messages, got.messages), std::max(sent.cells, got.cells), sent.messages, sent.cells};
}

class Counter {
 public:
  Counter(int ranks, int looked_at) : ranks_(some_of(ranks, looked_at)) {}

  Exchanged exchange(const stokes::Grid& grid, const std::vector<Box>& from, const std::vector<Box>& to,
                     std::size_t level) {
    Exchanged out;
    out.level = level;
    const auto start = std::chrono::steady_clock::now();
    for (const int r : ranks_) {
      const Traffic t = of_rank(r, grid, from, to);
      out.largest.messages = std::max(out.largest.messages, t.messages);
      out.largest.cells = std::max(out.largest.cells, t.cells);
      out.total.sent += t.sent;
      out.total.cells_sent += t.cells_sent;
    }
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() /
               static_cast<double>(ranks_.size());
    return out;
  }
  double seconds = 0;

 private:
  std::vector<int> ranks_;
};

void add_times(Exchanged& e, double times, double bytes) {
  e.times += times;
  e.bytes += times * bytes;
}

}  // namespace

double FlowTraffic::messages() const {
  double sum = 0;
  for (const Exchanged& e : exchanges) sum += e.times * e.total.sent;
  return sum;
}
double FlowTraffic::bytes() const {
  double sum = 0;
  for (const Exchanged& e : exchanges) sum += e.bytes * e.total.cells_sent;
  return sum;
}

FlowTraffic flow_traffic(const stokes::Grid& grid, int ranks, int iterations, int looked_at) {
  FlowTraffic out;
  Counter count(ranks, looked_at);
  const double n = iterations, velocity = grid.dim * number;
  const std::vector<Box> boxes = stokes::even_boxes(grid, ranks);
  const std::vector<stokes::CoarseGrid> coarse = stokes::coarse_grids(grid, boxes);
  const auto largest = [](const std::vector<Box>& all) {
    double most = 0;
    for (const Box& b : all) most = std::max(most, static_cast<double>(decomp::cell_count(b)));
    return most;
  };
  bool everywhere = false;
  for (std::size_t k = 0; k <= coarse.size(); ++k) {
    const std::vector<Box>& own = k == 0 ? boxes : coarse[k - 1].boxes;
    const stokes::Grid& g = k == 0 ? grid : coarse[k - 1].grid;
    out.cells.push_back(largest(own));
    if (everywhere) continue;  // nobody else is asked
    Exchanged halo = count.exchange(g, own, stokes::frames_of(g, own), k);
    add_times(halo, 1, number);              // viscosities
    add_times(halo, power_steps, velocity);  // the largest eigenvalue
    out.reduced.times += power_steps;
    out.reduced.bytes += power_steps * number;
    if (k < coarse.size())
      add_times(halo, n * (2 * stokes::smoothing_degree(k) - 1 + 2),
                velocity);  // two of them for the residual
    if (k == 0) {
      add_times(halo, n + 2, velocity);  // the operator, at the begin and the end too
      add_times(halo, 2 * n + 2, number);
    }
    out.exchanges.push_back(halo);
    if (k == coarse.size()) continue;
    const stokes::CoarseGrid& next = coarse[k];
    Exchanged down = count.exchange(next.grid, next.halves, next.boxes, k + 1);
    down.to_all = next.everywhere;
    add_times(down, 1, number);
    add_times(down, n, velocity);
    out.exchanges.push_back(down);
    everywhere = next.everywhere;
    if (everywhere) continue;
    Exchanged up = count.exchange(next.grid, next.boxes, stokes::frames_of(next.grid, next.halves), k + 1);
    add_times(up, n, velocity);
    out.exchanges.push_back(up);
  }
  // The stiffest cell; norms of the force and of two residuals, the mean pressure; of an iteration the products with the
  // vectors so far at once, and a norm.
  out.reduced.times += 1 + 4 + 2 * n;
  out.reduced.bytes += number + exact_sum * (4 + n * (n + 1) / 2 + n);
  out.search = count.seconds;
  return out;
}

}  // namespace scale_sim
