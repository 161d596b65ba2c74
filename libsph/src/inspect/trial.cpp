#include "inspect/trial.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <exception>

namespace sph {
namespace {

[[noreturn]] void be_the_copy(const std::function<void()>& work, int seconds) {
  for (int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGTERM})
    std::signal(number, SIG_DFL);  // MPI's print where they happened
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0}, cpu{static_cast<rlim_t>(seconds), static_cast<rlim_t>(seconds + 1)};
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_CPU, &cpu);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (int fd : {STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, fd);
  try {
    work();
  } catch (const std::exception&) {
  }
  _exit(0);
}

}  // namespace

std::string fate_in_a_copy(const std::function<void()>& work, int seconds) {
  const pid_t copy = fork();
  if (copy == 0) be_the_copy(work, seconds);
  if (copy < 0) return {};  // no room for two: then without a trial
  int status = 0;
  pid_t ended = 0;
  do ended = waitpid(copy, &status, 0);
  while (ended < 0 && errno == EINTR);
  if (ended != copy || !WIFSIGNALED(status)) return {};
  const int number = WTERMSIG(status);
  if (number == SIGXCPU || number == SIGKILL) return "HDF5 does not come to an end with it";
  return "HDF5 crashes on it, signal " + std::to_string(number);
}

}  // namespace sph
