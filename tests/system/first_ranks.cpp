#include "first_ranks.hpp"

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace equivalence {

namespace fs = std::filesystem;

void sleep_until_all_are_here(MPI_Comm world) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(world, &request);
  int done = 0;
  for (unsigned nap = 100; MPI_Test(&request, &done, MPI_STATUS_IGNORE), done == 0;
       nap = std::min(nap * 2, 3200U))
    usleep(nap);
}

SubComms::SubComms(const decomp::Comm& world) {
  for (int k = 1; k <= most_ranks; ++k) {
    MPI_Comm part = MPI_COMM_NULL;
    MPI_Comm_split(world.get(), world.rank() < k ? 0 : MPI_UNDEFINED, world.rank(), &part);
    if (part == MPI_COMM_NULL) continue;
    comms_[static_cast<std::size_t>(k)] = std::make_unique<decomp::Comm>(part);
    MPI_Comm_free(&part);
  }
}

Scratch::Scratch(const decomp::Comm& world, const std::string& name) : mine_(world.rank() == 0) {
  std::string path = (fs::temp_directory_path() / (name + "_XXXXXX")).string();
  if (mine_ && mkdtemp(path.data()) == nullptr) throw std::runtime_error("cannot make " + path);
  path_ = world.broadcast(path, 0);
}

Scratch::~Scratch() {
  std::error_code ignored;
  if (mine_) fs::remove_all(path_, ignored);
}

}  // namespace equivalence
