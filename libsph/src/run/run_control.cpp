#include "run/run_control.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <limits>

#include "sph/run/run.hpp"

namespace sph {
namespace {

// A handler can reach nothing but objects of static storage.
volatile std::sig_atomic_t stop_signal = 0;
volatile std::sig_atomic_t checkpoint_signal = 0;
volatile std::sig_atomic_t told_to_end = 0;  ///< [s] of the monotonic clock, when SIGTERM came first

extern "C" void on_signal(int number) {
  if (number == SIGUSR2) {
    checkpoint_signal = 1;
    return;
  }
  stop_signal = 1;
  if (number != SIGTERM) return;
  // Who insists gets the end at once; Slurm says it twice within milliseconds and means one checkpoint.
  constexpr int insistence = 3;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const auto seconds = static_cast<std::sig_atomic_t>(now.tv_sec) + 1;
  if (told_to_end == 0) told_to_end = seconds;
  if (seconds - told_to_end >= insistence) _exit(128 + SIGTERM);
}

constexpr double seconds_between_looks = 0.25;  // a metadata call may be slow on a shared disk

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;  // a signal must not fail a write under way
  sigemptyset(&action.sa_mask);
  // A limit on the size of files is then an error of the write, like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  for (int number : {SIGUSR1, SIGUSR2, SIGTERM}) sigaction(number, &action, nullptr);
}

void restore_signal_handlers() {
  for (int number : {SIGUSR1, SIGUSR2, SIGTERM}) std::signal(number, SIG_DFL);
  if (told_to_end != 0) std::raise(SIGTERM);
}

void TimeLimit::step_begins() {
  if (last_step_) longest_step_ = std::max(longest_step_, seconds_since(*last_step_));
  last_step_ = WallClock::now();
}

bool TimeLimit::reached() const {
  const double needed = 2 * longest_step_ + 2 * checkpoint_seconds_;
  return max_seconds_ && seconds_since(begin_) + needed >= *max_seconds_;
}

RunControl::RunControl(int rank, WallClock::time_point begin, const OutputControl& output,
                       std::filesystem::path stop_file, std::optional<double> max_seconds)
    : rank_(rank),
      status_(output.status_interval),
      checkpoint_(output.checkpoint_interval > 0 ? output.checkpoint_interval
                                                 : std::numeric_limits<double>::infinity()),
      limit_(begin, max_seconds),
      stop_file_(std::move(stop_file)),
      look_(seconds_between_looks) {}

bool RunControl::stop_file_found() {
  if (!look_.due()) return false;
  look_.reset();
  std::error_code none;
  return std::filesystem::is_regular_file(stop_file_, none);
}

Wish RunControl::wish(bool failed) {
  if (failed) return Wish::give_up;
  limit_.step_begins();
  if (rank_ == 0) stopping_ = stopping_ || limit_.reached() || stop_file_found();
  if (stopping_ || stop_signal != 0) return Wish::stop;
  if (checkpoint_signal != 0) return Wish::checkpoint;
  if (rank_ != 0) return Wish::none;
  if (checkpoint_.due()) return Wish::checkpoint;
  if (status_.due()) return Wish::status;
  return Wish::none;
}

void RunControl::granted(Wish wish) {
  switch (wish) {
    case Wish::none:
    case Wish::give_up:
      return;
    case Wish::status:
      status_.reset();
      return;
    case Wish::stop: {
      // Else it would stop the resumed run.
      if (std::error_code error; rank_ == 0 && !std::filesystem::remove(stop_file_, error) && error)
        fmt::print(stderr, "peperite: warning: {} cannot be removed and will stop the resumed run: {}\n",
                   stop_file_.string(), error.message());
      [[fallthrough]];
    }
    case Wish::checkpoint:
      checkpoint_signal = 0;
      checkpoint_.reset();
  }
}

}  // namespace sph
