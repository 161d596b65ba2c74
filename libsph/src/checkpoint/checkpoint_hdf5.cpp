// Writing a checkpoint. Nothing that exists is touched until the new one is complete and on disk.
#include <algorithm>
#include <cstring>
#include <sstream>

#include "checkpoint/checkpoint_files.hpp"
#include "files/content_hash.hpp"
#include "files/fill_file.hpp"
#include "sph/files/provenance.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;

constexpr int ranks_per_file = 512;
/// Rows that share a hash: many ranks can check what one has written.
constexpr std::uint64_t block_rows = std::uint64_t{1} << 16;

/// The ranks that write one part: a contiguous group, so that the parts follow each other in rank order.
class PartComm {
 public:
  PartComm(const decomp::Comm& all, int part) {
    decomp::check_mpi(MPI_Comm_split(all.get(), part, all.rank(), &comm_), "MPI_Comm_split");
  }
  ~PartComm() { MPI_Comm_free(&comm_); }
  PartComm(const PartComm&) = delete;
  PartComm& operator=(const PartComm&) = delete;
  [[nodiscard]] MPI_Comm get() const { return comm_; }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

/// One data set: its place in the part file, and this rank's rows of it.
struct Column {
  DataSet set;
  std::uint64_t first = 0;
  std::uint64_t rows = 0;
  const std::byte* data = nullptr;
};

/// This rank's rows as they go into the file.
class Rows {
 public:
  Rows(const decomp::Comm& part, const Particles& particles, const Wrap& wrap, const decomp::Payload* history)
      : rows_(particles.owned()),
        first_(part_offset(part, rows_)),
        all_rows_(part_sum(part, rows_)),
        dim_(particles.dim()) {
    for (Field f : kept_of(particles.fields()).list()) add_field(particles, f, wrap);
    if (history != nullptr) add_history(part, *history);
    make_blocks();
    const std::uint64_t blocks = blocks_.size() / block_width();
    columns_.push_back({{"blocks", Element::u64, part_sum(part, blocks), static_cast<int>(block_width()), "",
                         "per block: first row, rows, XXH3 of its bytes in each data set"},
                        part_offset(part, blocks),
                        blocks,
                        reinterpret_cast<const std::byte*>(blocks_.data())});
  }
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  [[nodiscard]] std::uint64_t all_rows() const { return all_rows_; }
  [[nodiscard]] std::span<const std::byte> block_table() const { return std::as_bytes(std::span(blocks_)); }

 private:
  static std::uint64_t part_offset(const decomp::Comm& part, std::uint64_t n) {
    return static_cast<std::uint64_t>(part.exclusive_sum(static_cast<std::int64_t>(n)));
  }
  static std::uint64_t part_sum(const decomp::Comm& part, std::uint64_t n) {
    return static_cast<std::uint64_t>(part.sum(static_cast<std::int64_t>(n)));
  }
  [[nodiscard]] std::size_t hashed_sets() const { return row_bytes_.size() + (has_history_ ? 2 : 0); }
  [[nodiscard]] std::size_t block_width() const { return 2 + hashed_sets(); }

  void add_field(const Particles& particles, Field f, const Wrap& wrap) {
    const FieldInfo& i = info(f);
    const decomp::Column& from = particles.table().column(particles.column(f));
    const std::byte* data = from.data();
    if (f == Field::position) {
      const auto d = static_cast<std::size_t>(dim_);
      position_.resize(rows_ * d);
      const std::int64_t* x = particles.data<Field::position>();
      for (std::size_t k = 0; k < position_.size(); ++k) position_[k] = wrap(static_cast<int>(k % d), x[k]);
      data = reinterpret_cast<const std::byte*>(position_.data());
    }
    columns_.push_back({{std::string(i.name), element_of(i.type), all_rows_, components(i.shape, dim_),
                         std::string(i.unit), std::string(i.meaning)},
                        first_,
                        rows_,
                        data});
    row_bytes_.push_back(from.width());
  }

  void add_history(const decomp::Comm& part, const decomp::Payload& history) {
    has_history_ = true;
    const std::uint64_t start = history.offset.front();
    const std::uint64_t bytes = history.offset.back() - start;
    const std::uint64_t base = part_offset(part, bytes);
    for (std::size_t row = 0; row < rows_; ++row)
      history_end_.push_back(base + history.offset[row + 1] - start);
    history_base_ = base;
    columns_.push_back({{"history_end", Element::u64, all_rows_, 1, "byte",
                         "where a row's contact history ends; it begins where the row before ends"},
                        first_,
                        rows_,
                        reinterpret_cast<const std::byte*>(history_end_.data())});
    columns_.push_back({{"history", Element::u8, part_sum(part, bytes), 1, "", "contact history"},
                        base,
                        bytes,
                        history.bytes.data() + start});
  }

  void make_blocks() {
    for (std::uint64_t begin = 0; begin < rows_; begin += block_rows) {
      const std::uint64_t n = std::min(block_rows, rows_ - begin);
      blocks_.push_back(first_ + begin);
      blocks_.push_back(n);
      for (std::size_t set = 0; set < row_bytes_.size(); ++set)
        blocks_.push_back(content_hash({columns_[set].data + begin * row_bytes_[set], n * row_bytes_[set]}));
      if (!has_history_) continue;
      const std::span<const std::uint64_t> ends = std::span(history_end_).subspan(begin, n);
      const std::uint64_t from = (begin == 0 ? history_base_ : history_end_[begin - 1]) - history_base_;
      const std::uint64_t to = ends.back() - history_base_;
      blocks_.push_back(content_hash(std::as_bytes(ends)));
      blocks_.push_back(content_hash({columns_.back().data + from, to - from}));
    }
  }

  std::uint64_t rows_, first_, all_rows_;
  int dim_;
  bool has_history_ = false;
  std::uint64_t history_base_ = 0;
  std::vector<std::int64_t> position_;
  std::vector<std::uint64_t> history_end_, blocks_;
  std::vector<std::size_t> row_bytes_;  ///< of the fields
  std::vector<Column> columns_;
};

/// Writes one part on the ranks of `writers`; returns its description on rank 0 of these.
Part write_part(const decomp::Comm& everyone, const decomp::Comm& writers, const fs::path& file,
                const Rows& rows, const std::string& what) {
  Part part;
  std::vector<DataSet> sets;
  for (const Column& column : rows.columns()) sets.push_back(column.set);
  all_or_none(everyone, what, [&] {
    if (writers.rank() == 0)
      part.extents = lay_out(file, {{"format", std::string("peperite checkpoint part 1")}}, sets);
  });
  fill_in(everyone, writers, file, sets, part.extents, what, [&](RowSink& out) {
    std::size_t set = 0;
    for (const Column& column : rows.columns()) out.write(set++, column.first, column.rows, column.data);
  });
  const std::vector<std::byte> table = writers.gather(rows.block_table(), 0);
  all_or_none(everyone, what, [&] {
    if (writers.rank() != 0) return;
    part.file = file.filename().string();
    part.bytes = fs::file_size(file);
    part.rows = rows.all_rows();
    part.frame_hash = frame_hash(file, part.bytes, part.extents);
    part.table_hash = content_hash(table);
  });
  return part;
}

/// The descriptions of all parts in order, on rank 0.
std::vector<Part> gather_parts(const decomp::Comm& comm, const decomp::Comm& writers, const Part& part) {
  const std::string mine = writers.rank() == 0 ? to_text(part) : std::string();
  const std::vector<std::byte> all = comm.gather(std::as_bytes(std::span(mine)), 0);
  std::istringstream lines(std::string(reinterpret_cast<const char*>(all.data()), all.size()));
  std::vector<Part> parts;
  for (std::string line; std::getline(lines, line);) parts.push_back(part_from_text(line));
  return parts;
}

Manifest manifest_of(const Particles& particles, const decomp::Payload* history, const RunRecord& record,
                     const Provenance& provenance, std::vector<Part> parts) {
  const BuildInfo& build = build_info();
  return {record,
          particles.dim(),
          kept_of(particles.fields()).list(),
          history != nullptr,
          provenance,
          build.version,
          build.git,
          build.compiler,
          build.flags,
          std::move(parts)};
}

}  // namespace

FieldSet kept_of(FieldSet fields) {
  FieldSet out;
  for (Field f : fields.list())
    if (info(f).state || info(f).snapshot) out |= FieldSet{f};
  return out;
}

void write_checkpoint(const decomp::Comm& comm, const fs::path& run_dir, const Particles& particles,
                      const decomp::Payload* history, const RunRecord& record, const Wrap& wrap,
                      const Provenance& provenance, int files) {
  const std::string what = "cannot write the checkpoint of step " + std::to_string(record.global.step) +
                           " in " + checkpoint_root(run_dir).string();
  if (files <= 0) files = (comm.size() + ranks_per_file - 1) / ranks_per_file;
  files = std::min(files, comm.size());
  const auto index = static_cast<int>(std::int64_t{comm.rank()} * files / comm.size());
  const PartComm split(comm, index);
  const decomp::Comm writers(split.get());

  std::string name;
  all_or_none(comm, what, [&] {
    if (comm.rank() == 0)
      name = make_checkpoint_directory(checkpoint_root(run_dir), record.global.step).string();
  });
  const fs::path dir = comm.broadcast(name, 0);
  try {
    const Rows rows(writers, particles, wrap, history);
    const fs::path file = dir / ("part_" + std::to_string(index) + ".h5");
    const Part part = write_part(comm, writers, file, rows, what);
    const std::vector<Part> parts = gather_parts(comm, writers, part);
    all_or_none(comm, what, [&] {
      if (comm.rank() != 0) return;
      sync_to_disk(dir);
      write_atomically(manifest_path(dir),
                       to_text(manifest_of(particles, history, record, provenance, parts)));
    });
  } catch (const OutputError&) {
    if (comm.rank() == 0) remove_checkpoint(dir);
    throw;
  }
  // Where the old ones cannot be deleted, they stay: the next checkpoint tries again.
  if (comm.rank() == 0) (void)attempt([&] { remove_superseded(dir); });
  comm.barrier();
}

}  // namespace sph
