#include <plastron/io/binary_file.hpp>
#include <plastron/io/results.hpp>

#include <fmt/format.h>

#include <utility>

namespace plastron::io {

BinaryFile::BinaryFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  // A pipe is refused before it is opened, which would wait for a writer.
  if (!std::filesystem::is_regular_file(path_, error)) refuse("there is no such file");
  size_ = std::filesystem::file_size(path_, error);
  if (error) refuse(error.message());
  file_.open(path_, std::ios::binary);
  if (!file_) refuse("the file cannot be read");
}

void BinaryFile::read(void* to, std::size_t bytes) {
  if (!file_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes))) refuse("the file cannot be read");
}

void BinaryFile::require_size(std::uintmax_t bytes) const {
  if (size_ != bytes)
    refuse(fmt::format("the file has {} bytes, its header requires {}: it is incomplete or damaged", size_, bytes));
}

void BinaryFile::refuse(const std::string& what) const {
  throw UnusableResults(fmt::format("{}: {}", path_.string(), what));
}

}  // namespace plastron::io
