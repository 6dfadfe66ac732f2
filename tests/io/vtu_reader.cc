#include <io/vtu_reader.hpp>

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace plastron::io {

namespace {

using Bytes = std::vector<unsigned char>;

/// Decodes from `at` and moves it past the last character used; `count` bytes, padding included in the text.
Bytes base64(const std::string& text, std::size_t& at, std::size_t count) {
  static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  Bytes bytes;
  for (; bytes.size() < count; at += 4) {
    std::uint32_t quad = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const char c = text.at(at + i);
      const auto digit = c == '=' ? 0 : letters.find(c);
      if (digit == std::string::npos) throw std::runtime_error("no base64 text");
      quad = quad << 6 | static_cast<std::uint32_t>(digit);
    }
    for (int shift = 16; shift >= 0; shift -= 8) bytes.push_back(static_cast<unsigned char>(quad >> shift & 255));
  }
  bytes.resize(count);
  return bytes;
}

/// One block, as io/vtu_piece.cc writes it: (blocks, block size, last block size, compressed size), then the block.
Bytes decompress(const std::string& text) {
  std::size_t at = text.find_first_not_of(" \n");
  if (at == std::string::npos) throw std::runtime_error("an array is empty");
  std::uint64_t header[4];
  std::memcpy(header, base64(text, at, sizeof header).data(), sizeof header);
  const Bytes packed = base64(text, at, header[3]);
  Bytes plain(header[1]);
  uLongf size = plain.size();
  if (uncompress(plain.data(), &size, packed.data(), packed.size()) != Z_OK || size != plain.size())
    throw std::runtime_error("an array cannot be decompressed");
  return plain;
}

template <class Stored, class Value>
std::vector<Value> numbers(const Bytes& bytes) {
  std::vector<Stored> stored(bytes.size() / sizeof(Stored));
  std::memcpy(stored.data(), bytes.data(), stored.size() * sizeof(Stored));
  return {stored.begin(), stored.end()};
}

template <class Value>
std::vector<Value> values(const std::string& type, const Bytes& bytes) {
  if (type == "Float32") return numbers<float, Value>(bytes);
  if (type == "Float64") return numbers<double, Value>(bytes);
  if (type == "Int32") return numbers<std::int32_t, Value>(bytes);
  if (type == "Int64") return numbers<std::int64_t, Value>(bytes);
  if (type == "UInt8") return numbers<std::uint8_t, Value>(bytes);
  throw std::runtime_error("unknown type " + type);
}

/// The value of an attribute of a tag, "" if there is none.
std::string attribute(const std::string& tag, const std::string& name) {
  const std::size_t at = tag.find(" " + name + "=\"");
  if (at == std::string::npos) return "";
  const std::size_t from = at + name.size() + 3;
  return tag.substr(from, tag.find('"', from) - from);
}

template <class Value>
void append(std::vector<Value>& all, const std::vector<Value>& more, Value shift) {
  for (const Value value : more) all.push_back(value + shift);
}

void add_array(const std::string& tag, const std::string& content, std::size_t first_point, std::size_t first_entry,
               VtuFile& file) {
  const std::string name = attribute(tag, "Name"), type = attribute(tag, "type");
  const Bytes bytes = decompress(content);
  if (name == "connectivity") return append(file.connectivity, values<int>(type, bytes), static_cast<int>(first_point));
  if (name == "offsets") return append(file.offsets, values<int>(type, bytes), static_cast<int>(first_entry));
  if (name == "types") return append(file.types, values<int>(type, bytes), 0);
  VtuArray& array = file.arrays[name.empty() ? "points" : name];
  const std::string components = attribute(tag, "NumberOfComponents");
  array.components = components.empty() ? 1 : std::stoi(components);
  array.unit = attribute(tag, "units");
  append(array.values, values<double>(type, bytes), 0.0);
}

void add_piece(const std::string& piece, VtuFile& file) {
  const std::size_t first_point = file.points, first_entry = file.connectivity.size();
  const std::string tag = piece.substr(0, piece.find('>'));
  file.points += std::stoul(attribute(tag, "NumberOfPoints"));
  file.cells += std::stoul(attribute(tag, "NumberOfCells"));
  file.pieces += 1;
  for (std::size_t at = piece.find("<DataArray"); at != std::string::npos; at = piece.find("<DataArray", at + 1)) {
    const std::size_t from = piece.find('>', at) + 1;
    add_array(piece.substr(at, from - at), piece.substr(from, piece.find('<', from) - from), first_point, first_entry,
              file);
  }
}

}  // namespace

VtuFile read_vtu(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!text.ends_with("</VTKFile>\n")) throw std::runtime_error("not a complete .vtu file");
  VtuFile file;
  for (std::size_t at = text.find("<Piece "); at != std::string::npos; at = text.find("<Piece ", at + 1))
    add_piece(text.substr(at, text.find("</Piece>", at) - at), file);
  return file;
}

}  // namespace plastron::io
