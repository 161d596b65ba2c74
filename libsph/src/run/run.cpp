#include "sph/run/run.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "files/agree.hpp"
#include "models/stability.hpp"
#include "output/output_schedule.hpp"
#include "run/run_control.hpp"
#include "run/run_files.hpp"
#include "run/run_start.hpp"
#include "run/screen.hpp"
#include "sph/run/report.hpp"

namespace sph {
namespace {

class Run {
 public:
  Run(RunStart start, const RunOptions& options, WallClock::time_point begin, Failure& failure)
      : simulation_(*start.simulation),
        files_(start.memory ? RunFiles(simulation_, start.dir, start.old_scene, *start.memory,
                                       simulation_.global().step + (finished() ? 0 : 1))
                            : RunFiles(simulation_, start.dir, start.old_scene, start.followed)),
        control_(simulation_.comm().rank(), begin, simulation_.scene().output, start.dir / "stop",
                 options.max_seconds),
        screen_(simulation_, begin),
        failure_(failure),
        start_(std::move(start)) {
    if (start_.memory) {
      series_.done(simulation_.global().time);
      snapshots_.done(simulation_.global().time);
      checkpoint_ = simulation_.global().step;
      if (!files_.snapshots().empty()) last_snapshot_ = files_.snapshots().back().step;
    }
  }

  int go() {
    try {
      return advance();
    } catch (const OutputError& error) {
      const std::string resume = "peperite resume " + files_.dir().string();
      throw OutputError(error.what() +
                        (checkpoint_
                             ? fmt::format("; the checkpoint of step {} is intact, go on from it with: {}",
                                           *checkpoint_, resume)
                             : "; there is no checkpoint yet, begin anew with: " + resume));
    }
  }

 private:
  int advance() {
    screen_.banner();
    if (!start_.memory) write_due_output();
    while (!finished()) {
      const auto wish = static_cast<Wish>(step());
      write_due_output();
      if (wish == Wish::give_up) give_up();
      if (wish == Wish::status) screen_.status();
      // At the end the last snapshot goes first.
      if (wish >= Wish::checkpoint && !finished()) checkpoint();
      control_.granted(wish);
      if (wish == Wish::stop && !finished()) return stopped();
    }
    return done();
  }

  [[nodiscard]] bool finished() const { return is_finished(simulation_.scene(), simulation_.global()); }

  std::int64_t step() {
    if (lost_.empty()) lost_ = attempt([&] { start_.lock->touch(); });
    const auto wish = static_cast<std::int64_t>(control_.wish(files_.failed() || !lost_.empty()));
    try {
      return simulation_.step(wish);
    } catch (const GuardError& error) {
      const std::string kept = attempt_to_keep_state();
      throw GuardError(std::string(error.what()) + kept);
    }
  }

  /// What one rank found is told by all.
  void give_up() const {
    files_.check(simulation_);
    if (const std::string lost = agree(simulation_.comm(), lost_); !lost.empty()) throw OutputError(lost);
  }

  std::string attempt_to_keep_state() {
    try {
      return "; the state is kept in " +
             files_.keep_crashed_state(simulation_, failure_.everywhere()).string();
    } catch (const std::exception& error) {
      return std::string("; the state could not be kept: ") + error.what();
    }
  }

  void write_due_output() {
    const auto timing = simulation_.timers().time(decomp::Region::output);
    const double t = simulation_.global().time;
    if (simulation_.scene().output.series_interval == 0 || series_.due(t)) {
      files_.add_series_row(simulation_);
      series_.done(t);
    }
    if (snapshots_.due(t)) {
      simulation_.make_room();
      files_.add_snapshot(simulation_, true);
      snapshots_.done(t);
      last_snapshot_ = simulation_.global().step;
    }
  }

  void checkpoint() {
    const auto timing = simulation_.timers().time(decomp::Region::output);
    const auto begin = WallClock::now();
    simulation_.make_room();
    files_.write_checkpoint(simulation_);
    checkpoint_ = simulation_.global().step;
    control_.checkpoint_took(seconds_since(begin));
  }

  int done() {
    if (last_snapshot_ != simulation_.global().step) {
      const auto timing = simulation_.timers().time(decomp::Region::output);
      simulation_.make_room();
      files_.add_snapshot(simulation_, false);
    }
    if (checkpoint_ != simulation_.global().step) checkpoint();
    screen_.final_report(files_.dir());
    return exit_done;
  }

  int stopped() {
    screen_.final_report(files_.dir());
    if (simulation_.comm().rank() == 0)
      fmt::print(stderr, "peperite: stopped at step {} with a checkpoint; go on with: peperite resume {}\n",
                 simulation_.global().step, files_.dir().string());
    return exit_resume;
  }

  Simulation& simulation_;
  RunFiles files_;
  RunControl control_;
  Screen screen_;
  Failure& failure_;
  RunStart start_;
  OutputSchedule series_{simulation_.scene().output.series_interval};
  OutputSchedule snapshots_{simulation_.scene().output.snapshot_interval};
  std::int64_t last_snapshot_ = -1;
  std::optional<std::int64_t> checkpoint_;  ///< step of the newest one
  std::string lost_;                        ///< why the directory is no longer this run's
};

}  // namespace

int run_case(const RunOptions& options, const decomp::Comm& comm, Failure& failure) {
  const auto begin = WallClock::now();
  RunStart start = options.resume.empty()   ? start_new(options, comm)
                   : options.branch.empty() ? start_again(options, comm)
                                            : start_branch(options, comm);
  const Simulation& simulation = *start.simulation;
  if (start.memory && is_finished(simulation.scene(), simulation.global()) &&
      is_complete(simulation, start.dir)) {
    print_fingerprint(simulation);
    return exit_done;
  }
  return Run(std::move(start), options, begin, failure).go();
}

}  // namespace sph
