// The binary files of the program: how bytes are written and read.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace plastron::io {

inline void append_bytes(std::string& text, const void* data, std::size_t bytes) {
  text.append(static_cast<const char*>(data), bytes);
}

/// All functions throw UnusableResults with the path and the reason.
class BinaryFile {
 public:
  /// Opens a regular file.
  explicit BinaryFile(std::filesystem::path path);

  std::uintmax_t size() const { return size_; }
  void read(void* to, std::size_t bytes);
  void skip(std::size_t bytes) { file_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur); }
  /// Refuses a file of another size.
  void require_size(std::uintmax_t bytes) const;
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::filesystem::path path_;
  std::uintmax_t size_ = 0;
  std::ifstream file_{};
};

}  // namespace plastron::io
