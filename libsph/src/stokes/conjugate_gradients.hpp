// A u = f by conjugate gradients, preconditioned by one V-cycle, which is symmetric: for viscosities whose stiff blobs the
// coarse grids do not see. Each of their rigid motions is an eigenvalue of its own, and costs an iteration. Dot products
// are exact: the same bits on any number of ranks.
#pragma once

#include "stokes/multigrid.hpp"

namespace stokes {

/// Until r . M r has fallen to the square of `share`, or `most` V-cycles are spent; returns their number. Collective.
int conjugate_gradients(const decomp::Comm& comm, Multigrid& multigrid, const Velocity& f, double share,
                        int most, Velocity& u);

}  // namespace stokes
