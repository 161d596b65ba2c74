#include "sph/run/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <new>
#include <string>
#include <thread>

#include "sph/core/error.hpp"

namespace sph {
namespace {

struct Report {
  std::string text;
  int code;
};

Report report_of(const std::exception& error) {
  const std::string text = error.what();
  if (dynamic_cast<const InputError*>(&error) != nullptr) return {"error: " + text, exit_input};
  if (dynamic_cast<const OutputError*>(&error) != nullptr) return {"error: " + text, exit_output};
  if (dynamic_cast<const GuardError*>(&error) != nullptr) return {"stopped: " + text, exit_guard};
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
    return {"stopped: out of memory; use more machines or fewer particles", exit_guard};
  return {"internal error: " + text, exit_guard};
}

void print(std::string text) {
  const auto breaks_line = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), breaks_line, ' ');
  fmt::print(stderr, "peperite: {}\n", text);
  std::fflush(stderr);
}

}  // namespace

bool Failure::everywhere() {
  if (everywhere_) return *everywhere_;
  // Ranks that failed on their own give up one after the other, so that the first speaks for all.
  using namespace std::chrono_literals;
  const auto patience = 3s + 250ms * std::min(quiet_.rank(), 20);
  const auto start = std::chrono::steady_clock::now();
  MPI_Request request = MPI_REQUEST_NULL;
  int done = 0;
  if (MPI_Ibarrier(quiet_.get(), &request) != MPI_SUCCESS) return *(everywhere_ = false);
  do {
    if (MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS) done = 0;
    if (done == 0) std::this_thread::sleep_for(1ms);
  } while (done == 0 && std::chrono::steady_clock::now() - start < patience);
  everywhere_ = done != 0;
  return *everywhere_;
}

int Failure::report(const std::exception& error) {
  const Report mine = report_of(error);
  if (!everywhere()) {
    print(mine.text);
    MPI_Abort(quiet_.get(), mine.code);
  }
  // The rank that owns the particle in question knows most about it: the longest text is taken.
  const std::int64_t ranks = quiet_.size();
  const std::int64_t length = std::min<std::int64_t>(static_cast<std::int64_t>(mine.text.size()), 1 << 20);
  const std::int64_t best = quiet_.max(length * ranks + (ranks - 1 - quiet_.rank()));
  const auto speaker = static_cast<decomp::Rank>(ranks - 1 - best % ranks);
  int code = mine.code;
  quiet_.broadcast(std::as_writable_bytes(std::span(&code, 1)), speaker);
  if (quiet_.rank() == speaker) print(mine.text);
  return code;
}

int Failure::guard(const std::function<int()>& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    return report(error);
  }
}

}  // namespace sph
