#include "files/durable_file.hpp"

#include <fcntl.h>

#include <system_error>

#include "files/descriptor.hpp"

namespace sph {

void sync_to_disk(const std::filesystem::path& path) {
  Descriptor file(path, O_RDONLY);
  file.sync();
  file.close();
}

Descriptor create_anew(const std::filesystem::path& path) {
  // Not over the old one: a rank of a run that is being killed may still have that open.
  std::filesystem::remove(path);
  return Descriptor(path, O_WRONLY | O_CREAT | O_EXCL);
}

void write_atomically(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  try {
    Descriptor file = create_anew(temporary);
    file.write(std::as_bytes(std::span(text)));
    file.sync();
    file.close();
    rename_durably(temporary, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::rename(from, to);
  sync_to_disk(to.has_parent_path() ? to.parent_path() : std::filesystem::path("."));
}

void read_bytes(const std::filesystem::path& path, std::uint64_t offset, std::span<std::byte> to) {
  Descriptor(path, O_RDONLY).read_at(offset, to);
}

std::string read_text(const std::filesystem::path& path) {
  std::string text(std::filesystem::file_size(path), '\0');
  read_bytes(path, 0, std::as_writable_bytes(std::span(text)));
  return text;
}

}  // namespace sph
