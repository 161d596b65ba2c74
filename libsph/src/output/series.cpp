#include "sph/output/series.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

#include "sph/core/error.hpp"

namespace sph {
namespace {

std::string reason() { return errno == 0 ? "the stream failed" : std::generic_category().message(errno); }

void write(std::ofstream& out, const std::filesystem::path& path, const std::string& line) {
  errno = 0;
  out.write(line.data(), static_cast<std::streamsize>(line.size()));
  out.flush();
  if (!out) throw OutputError("cannot write " + path.string() + ": " + reason());
}

void open(std::ofstream& out, const std::filesystem::path& path, std::ios::openmode mode) {
  errno = 0;
  out.open(path, mode | std::ios::binary);
  if (!out) throw OutputError("cannot open " + path.string() + " for writing: " + reason());
}

}  // namespace

Series::Series(const std::filesystem::path& path, const std::vector<std::string>& names) : path_(path) {
  open(out_, path_, std::ios::out | std::ios::trunc);
  std::string header = "step,t";
  for (const std::string& name : names) header += "," + name;
  header += '\n';
  write(out_, path_, header);
  bytes_ = header.size();
}

Series::Series(const std::filesystem::path& path, std::uint64_t bytes) : path_(path), bytes_(bytes) {
  std::error_code error;
  const std::uintmax_t length = std::filesystem::file_size(path_, error);
  if (error) throw InputError("cannot go on with " + path_.string() + ": " + error.message());
  if (length < bytes)
    throw InputError(fmt::format("cannot go on with {}: it has {} bytes, the checkpoint was written after {}",
                                 path_.string(), length, bytes));
  std::filesystem::resize_file(path_, bytes, error);
  if (error) throw OutputError("cannot shorten " + path_.string() + ": " + error.message());
  open(out_, path_, std::ios::out | std::ios::app);
}

void Series::add(std::int64_t step, double time, const std::vector<double>& values) {
  std::string line = fmt::format("{},{}", step, time);
  for (double value : values) line += fmt::format(",{}", value);
  line += '\n';
  write(out_, path_, line);
  bytes_ += line.size();
}

}  // namespace sph
