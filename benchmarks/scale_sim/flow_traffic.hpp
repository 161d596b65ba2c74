// What a flow of melts sends, from the partition of its grid and those of the coarser ones alone.
#pragma once

#include <vector>

#include "model.hpp"
#include "stokes/partition.hpp"

namespace scale_sim {

/// Of one rank in one exchange, of one byte a cell.
struct Traffic {
  double messages = 0;  ///< it sends or, if these are more, gets
  double cells = 0;     ///< likewise
  double sent = 0, cells_sent = 0;
};
/// One exchange as often as a flow has it.
struct Exchanged {
  double times = 0;        ///< so many messages to each peer
  double bytes = 0;        ///< a cell, all times together
  std::size_t level = 0;   ///< its cells' grid, 0 the finest
  bool to_all = false;     ///< everyone gets the whole grid
  Traffic largest, total;  ///< of the ranks looked at
};
struct Reduced {
  double times = 0, bytes = 0;  ///< of a flow; bytes of all times
};
struct FlowTraffic {
  std::vector<Exchanged> exchanges;
  Reduced reduced;
  std::vector<double> cells;  ///< by level, of the rank with most
  double search = 0;          ///< seconds in which a rank finds its peers in all exchanges
  [[nodiscard]] double messages() const;
  [[nodiscard]] double bytes() const;
};

/// Of viscosities and `iterations` from one start of the Krylov method, with no slip or free slip at walls. `looked_at`:
/// ranks at most, the first ones, who have coarse grids, among them.
[[nodiscard]] FlowTraffic flow_traffic(const stokes::Grid& grid, int ranks, int iterations, int looked_at);

}  // namespace scale_sim
