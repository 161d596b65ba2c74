#include "sph/output/series.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <span>
#include <system_error>

#include "files/content_hash.hpp"
#include "sph/core/error.hpp"

namespace sph {
namespace {

std::string reason() { return errno == 0 ? "the stream failed" : std::generic_category().message(errno); }

std::uint64_t hash_after(const std::string& line, std::uint64_t before) {
  return content_hash(std::as_bytes(std::span(line)), before);
}

void open(std::ofstream& out, const std::filesystem::path& path, std::ios::openmode mode) {
  errno = 0;
  out.open(path, mode | std::ios::binary);
  if (!out) throw OutputError("cannot open " + path.string() + " for writing: " + reason());
}

}  // namespace

Series::Series(const std::filesystem::path& path, const std::vector<std::string>& names,
               const std::vector<std::string>& units)
    : path_(path) {
  open(out_, path_, std::ios::out | std::ios::trunc);
  std::string header = "step,t [s]";
  for (std::size_t k = 0; k < names.size(); ++k)
    header += units[k].empty() ? "," + names[k] : fmt::format(",{} [{}]", names[k], units[k]);
  header += '\n';
  write(header);
}

Series::Series(const std::filesystem::path& path, std::uint64_t bytes, std::optional<std::uint64_t> hash)
    : path_(path) {
  std::error_code error;
  const std::uintmax_t length = std::filesystem::file_size(path_, error);
  if (error) throw InputError("cannot go on with " + path_.string() + ": " + error.message());
  if (length < bytes)
    throw InputError(fmt::format("cannot go on with {}: it has {} bytes, the checkpoint was written after {}",
                                 path_.string(), length, bytes));
  look_at(bytes);
  if (hash && *hash != hash_)
    throw InputError(
        fmt::format("cannot go on with {}: its first {} bytes are not those of when the checkpoint "
                    "was written; put the file of this run back",
                    path_.string(), bytes));
  std::filesystem::resize_file(path_, bytes, error);
  if (error) throw OutputError("cannot shorten " + path_.string() + ": " + error.message());
  open(out_, path_, std::ios::out | std::ios::app);
}

void Series::add(std::int64_t step, double time, const std::vector<double>& values) {
  std::string line = fmt::format("{},{}", step, time);
  for (double value : values) line += fmt::format(",{}", value);
  line += '\n';
  write(line);
}

void Series::write(const std::string& line) {
  errno = 0;
  out_.write(line.data(), static_cast<std::streamsize>(line.size()));
  out_.flush();
  if (!out_) throw OutputError("cannot write " + path_.string() + ": " + reason());
  bytes_ += line.size();
  hash_ = hash_after(line, hash_);
}

// What was kept ends with a line.
void Series::look_at(std::uint64_t bytes) {
  errno = 0;
  std::ifstream in(path_, std::ios::binary);
  for (std::string line; bytes_ < bytes && std::getline(in, line);) {
    line += '\n';
    bytes_ += line.size();
    hash_ = hash_after(line, hash_);
  }
  if (!in.is_open() || in.bad()) throw InputError("cannot go on with " + path_.string() + ": " + reason());
  if (bytes_ != bytes) hash_ = ~hash_;
  bytes_ = bytes;
}

}  // namespace sph
