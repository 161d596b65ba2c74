// series.csv: one row per output time, one column per monitored quantity, written by rank 0, flushed each
// row. A resumed run cuts it back to the checkpoint, so that it ends identical to an uninterrupted run's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace sph {

class Series {
 public:
  /// Opens for a new run (truncates) and writes the header "step,t [s],<name> [<unit>],..", a number's without a unit. Throws
  /// OutputError.
  Series(const std::filesystem::path& path, const std::vector<std::string>& names,
         const std::vector<std::string>& units);
  /// Opens to go on: keeps the first `bytes` bytes. Throws InputError if the file is shorter, missing, or they
  /// do not have this hash.
  Series(const std::filesystem::path& path, std::uint64_t bytes, std::optional<std::uint64_t> hash);
  /// Values are printed in the shortest form that reads back to the same double.
  void add(std::int64_t step, double time, const std::vector<double>& values);
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }  ///< length on disk after the last row
  [[nodiscard]] std::uint64_t hash() const { return hash_; }    ///< of these, line by line

 private:
  void write(const std::string& line);
  void look_at(std::uint64_t bytes);  ///< of an older file

  std::filesystem::path path_;
  std::ofstream out_;
  std::uint64_t bytes_ = 0, hash_ = 0;
};

}  // namespace sph
