#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run/run_lock.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using namespace std::chrono_literals;

constexpr std::chrono::seconds longest_silence = 15min;

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown host";
}

std::string machine() {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  std::error_code none;
  return boot + " " + fs::read_symlink("/proc/self/ns/pid", none).string();
}

/// State and start time of a process: the 3rd and the 22nd word of /proc/PID/stat, whose 2nd may hold
/// anything in its parentheses. Empty if there is none to be seen.
struct ProcessState {
  std::string state, started;
};
ProcessState state_of(std::int64_t pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string text;
  std::getline(file, text, '\0');
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream words(text.substr(name_end + 1));
  ProcessState out;
  words >> out.state;
  for (int word = 4; word <= 22; ++word) words >> out.started;
  return words ? out : ProcessState{};
}

bool is_alive(std::int64_t pid, const std::string& started) {
  if (pid <= 0) return false;
  if (kill(static_cast<pid_t>(pid), 0) != 0 && errno != EPERM) return false;
  const ProcessState found = state_of(pid);
  if (found.state.empty()) return true;  // there, but hidden from other users
  return found.started == started && found.state != "Z" && found.state != "X";
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

LockOwner this_process() {
  LockOwner self{host_name(),
                 machine(),
                 getpid(),
                 state_of(getpid()).started,
                 {},
                 0,
                 fmt::format("{:%F %T} UTC", fmt::gmtime(std::time(nullptr)))};
  if (const std::string job = environment("SLURM_JOB_ID"); !job.empty())
    self.job = environment("SLURM_CLUSTER_NAME") + ":" + job;
  self.restart = std::atoll(environment("SLURM_RESTART_COUNT").c_str());
  return self;
}

std::string to_json(const LockOwner& o) {
  return Json{{"host", o.host},       {"pid", o.pid}, {"since", o.since},    {"machine", o.machine},
              {"started", o.started}, {"job", o.job}, {"restart", o.restart}}
             .dump(1) +
         "\n";
}

LockOwner owner_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    LockOwner o;
    o.host = json.at("host").get<std::string>();
    o.machine = json.at("machine").get<std::string>();
    o.pid = json.at("pid").get<std::int64_t>();
    o.started = json.at("started").get<std::string>();
    o.job = json.at("job").get<std::string>();
    o.restart = json.at("restart").get<std::int64_t>();
    o.since = json.at("since").get<std::string>();
    return o;
  } catch (const Json::exception&) {
    return {"unknown host", "", 0, "", "", 0, "an unknown time"};
  }
}

bool is_gone(const LockOwner& owner, const LockOwner& self, std::chrono::seconds quiet) {
  if (owner.machine == self.machine) return !is_alive(owner.pid, owner.started);
  // Slurm starts a job again when it has given up its nodes.
  if (!owner.job.empty() && owner.job == self.job && owner.restart < self.restart) return true;
  return quiet > longest_silence;
}

}  // namespace sph
