#include "decomp/timer.hpp"

#include <time.h>

#include <numeric>
#include <utility>

namespace decomp {

namespace {

double in_seconds(std::chrono::nanoseconds d) { return std::chrono::duration<double>(d).count(); }

std::chrono::nanoseconds thread_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return std::chrono::seconds(t.tv_sec) + std::chrono::nanoseconds(t.tv_nsec);
}

constexpr std::size_t index_of(Region r) { return static_cast<std::size_t>(r); }

}  // namespace

double thread_seconds() { return in_seconds(thread_time()); }

std::string_view name_of(Region r) {
  static constexpr std::array<std::string_view, region_count> names{
      "pairs",     "update",  "contacts", "lists",  "order", "pack",
      "halo wait", "migrate", "reduce",   "output", "grid",  "other"};
  return names[index_of(r)];
}

bool is_computation(Region r) {
  switch (r) {
    case Region::pairs:
    case Region::update:
    case Region::contacts:
    case Region::lists:
    case Region::order:
    case Region::pack:
      return true;
    default:
      return false;
  }
}

Timers::Durations Timers::elapsed() const {
  Durations d = elapsed_;
  d[index_of(current_)] += Clock::now() - started_;
  return d;
}

void Timers::switch_to(Region r) {
  // A system call, so only where computation begins or ends.
  if (is_computation(r) != is_computation(current_)) {
    const std::chrono::nanoseconds cpu = thread_time();
    if (is_computation(current_)) cpu_ += cpu - cpu_started_;
    cpu_started_ = cpu;
  }
  const Clock::time_point now = Clock::now();
  elapsed_[index_of(current_)] += now - started_;
  started_ = now;
  current_ = r;
}

double Timers::seconds(Region r) const { return in_seconds(elapsed()[index_of(r)]); }

std::int64_t Timers::calls(Region r) const { return calls_[index_of(r)]; }

double Timers::total() const {
  const Durations d = elapsed();
  return in_seconds(std::accumulate(d.begin(), d.end(), std::chrono::nanoseconds{}));
}

double Timers::cost() const {
  return in_seconds(is_computation(current_) ? cpu_ + thread_time() - cpu_started_ : cpu_);
}

double Timers::take_cost() {
  const double now = cost();
  return now - std::exchange(cost_taken_, now);
}

std::vector<Timers::Row> Timers::summary(const Comm& comm) const {
  const Durations d = elapsed();
  std::array<std::int64_t, 2 * region_count> extremes{};  // largest, and largest of the negative
  std::array<std::int64_t, region_count> sums{};
  for (std::size_t i = 0; i < d.size(); ++i) {
    sums[i] = extremes[i] = d[i].count();
    extremes[region_count + i] = -extremes[i];
  }
  comm.max(std::span<std::int64_t>(extremes));
  comm.sum(std::span<std::int64_t>(sums));
  const auto from_count = [](std::int64_t count) { return in_seconds(std::chrono::nanoseconds(count)); };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < d.size(); ++i)
    rows.push_back({static_cast<Region>(i), from_count(-extremes[region_count + i]),
                    from_count(sums[i]) / comm.size(), from_count(extremes[i]), calls_[i]});
  return rows;
}

}  // namespace decomp
