// What manifest.json says: everything of a checkpoint but the rows, and where in the part files these lie.
// Readers trust it because its last line is the hash of all that stands before, and trust the parts because
// every byte of theirs is covered by a hash that follows from here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "files/durable_file.hpp"
#include "sph/checkpoint/checkpoint.hpp"

namespace sph {

/// One part file. Its data sets are, in this order: the state fields, history_end and history if there is a
/// history, and the block table.
struct Part {
  std::string file;
  std::uint64_t bytes = 0;       ///< length of the file
  std::uint64_t rows = 0;        ///< of particles
  std::uint64_t frame_hash = 0;  ///< of all bytes outside the extents
  std::uint64_t table_hash = 0;  ///< of the block table
  std::vector<Extent> extents;   ///< one per data set
};

struct Manifest {
  RunRecord record;
  int dim = 0;
  std::vector<Field> fields;  ///< state, in the order of the field table
  bool history = false;
  Provenance provenance;  ///< its scene is the record's
  std::string version, git, compiler, flags;
  std::vector<Part> parts;

  [[nodiscard]] std::uint64_t rows() const;
  /// Data sets that have rows of their own in the block table's hashes: all but the table itself.
  [[nodiscard]] std::size_t hashed_sets() const { return fields.size() + (history ? 2 : 0); }
  [[nodiscard]] const Extent& table(const Part& part) const { return part.extents[hashed_sets()]; }
  [[nodiscard]] std::size_t history_end_set() const { return fields.size(); }
  [[nodiscard]] std::size_t history_set() const { return fields.size() + 1; }
};

[[nodiscard]] std::string to_text(const Part& part);  ///< one line of JSON
[[nodiscard]] Part part_from_text(const std::string& text);
[[nodiscard]] std::string to_text(const Manifest& manifest);
[[nodiscard]] Manifest manifest_from_text(const std::string& text);  ///< throws saying what is wrong

}  // namespace sph
