#include "sph/run.hpp"

namespace sph {
int check_case(const RunOptions&, const decomp::Comm&) { return exit_done; }
}  // namespace sph
