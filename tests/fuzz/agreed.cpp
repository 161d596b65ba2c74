#include "agreed.hpp"

#include <mpi.h>

#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "sph/core/error.hpp"

namespace fuzz {
namespace {

Report report_of(const std::exception& error) {
  const std::string text = error.what();
  if (dynamic_cast<const sph::InputError*>(&error) != nullptr) return {sph::exit_input, text};
  if (dynamic_cast<const sph::OutputError*>(&error) != nullptr) return {sph::exit_output, text};
  if (dynamic_cast<const sph::GuardError*>(&error) != nullptr) return {sph::exit_guard, text};
  return {sph::exit_guard, "internal error: " + text};
}

bool all_are_here(const decomp::Comm& comm) {
  using namespace std::chrono_literals;
  constexpr auto patience = 2s;
  const auto start = std::chrono::steady_clock::now();
  MPI_Request request = MPI_REQUEST_NULL;
  int done = 0;
  MPI_Ibarrier(comm.get(), &request);
  while (MPI_Test(&request, &done, MPI_STATUS_IGNORE), done == 0) {
    if (std::chrono::steady_clock::now() - start > patience) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

}  // namespace

Report agreed(const decomp::Comm& comm, const std::string& name, const std::function<void()>& work) {
  const decomp::Comm quiet(comm.get());  // carries no message but those about failure
  Report mine;
  try {
    work();
    return {};
  } catch (const std::exception& error) {
    mine = report_of(error);
  }
  if (!all_are_here(quiet)) {
    const nlohmann::json said{
        {"alone", name}, {"rank", quiet.rank()}, {"code", mine.code}, {"text", mine.text}};
    std::cout << said.dump() + '\n' << std::flush;
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  // The longest text is taken, the lowest rank's of several.
  const std::int64_t ranks = quiet.size(), length = static_cast<std::int64_t>(mine.text.size());
  const std::int64_t best = quiet.max(length * ranks + (ranks - 1 - quiet.rank()));
  const auto speaker = static_cast<decomp::Rank>(ranks - 1 - best % ranks);
  const std::string text = quiet.broadcast(std::to_string(mine.code) + mine.text, speaker);
  return {text[0] - '0', text.substr(1)};
}

}  // namespace fuzz
