#include <plastron/io/vtu_piece.hpp>

#include <plastron/algebra/threads.hpp>
#include <plastron/io/bytes.hpp>

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <future>
#include <stdexcept>

namespace plastron::io {

namespace {

/// Whether another thread is useful.
bool has_many_values(const GridArray& array) {
  constexpr std::size_t many_values = 10000;
  return array.values.size() >= many_values;
}

/// Returns one compressed block after VTK's header: number of blocks, bytes of a block, bytes of the last one if that
/// is smaller (else 0), and bytes of the compressed block.
template <class T>
std::string compressed(const std::vector<T>& values) {
  const std::size_t size = values.size() * sizeof(T);
  uLongf packed_size = compressBound(size);
  std::vector<std::byte> packed(packed_size);
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &packed_size, reinterpret_cast<const Bytef*>(values.data()),
                size, Z_BEST_SPEED) != Z_OK)
    throw std::runtime_error("zlib could not compress an array of a .vtu file");
  packed.resize(packed_size);
  const std::array<std::uint64_t, 4> header{1, size, 0, packed_size};
  return base64(std::as_bytes(std::span(header))) + base64(packed);
}

template <class T>
std::string data_array(const std::string& attributes, const std::vector<T>& values) {
  return fmt::format("        <DataArray {} format=\"binary\">\n{}\n        </DataArray>\n", attributes,
                     compressed(values));
}

/// ParaView shows no units, but they are beside the name for readers of the file.
std::string attributes_of(const GridArray& array) {
  std::string text = fmt::format("Name=\"{}\" NumberOfComponents=\"{}\"", array.name, array.components);
  if (!array.unit.empty()) text += fmt::format(" units=\"{}\"", array.unit);
  // ParaView's names of the components of a symmetric tensor.
  constexpr std::array tensor{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  for (std::size_t c = 0; array.components == 6 && c < tensor.size(); ++c)
    text += fmt::format(" ComponentName{}=\"{}\"", c, tensor[c]);
  return text;
}

template <class T>
std::string array_as(const std::string& attributes, const std::vector<double>& values) {
  std::vector<T> rounded;
  rounded.reserve(values.size());
  for (const double value : values) rounded.push_back(static_cast<T>(value));
  return data_array(attributes, rounded);
}

std::string real_array(const std::string& attributes, const std::vector<double>& values, bool is_double) {
  if (is_double) return data_array("type=\"Float64\" " + attributes, values);
  return array_as<float>("type=\"Float32\" " + attributes, values);
}

std::string cells_text(const GridPiece& piece) {
  const std::size_t cells = piece.connectivity.size() / piece.points_per_cell;
  std::vector<std::int64_t> ends;
  ends.reserve(cells);
  for (std::size_t cell = 1; cell <= cells; ++cell)
    ends.push_back(static_cast<std::int64_t>(cell * piece.points_per_cell));
  const std::vector<std::uint8_t> types(cells, static_cast<std::uint8_t>(piece.type));
  return "      <Cells>\n" + data_array(R"(type="Int64" Name="connectivity")", piece.connectivity) +
         data_array(R"(type="Int64" Name="offsets")", ends) + data_array(R"(type="UInt8" Name="types")", types) +
         "      </Cells>\n";
}

constexpr std::string_view vtu_header =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <UnstructuredGrid>\n";
constexpr std::string_view vtu_footer = "  </UnstructuredGrid>\n</VTKFile>\n";

/// Compresses with as many threads as allowed, because compression is most of the work of writing fields.
std::vector<std::string> arrays_text(const std::vector<GridArray>& arrays, bool is_double) {
  std::vector<std::string> texts(arrays.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t k = next++; k < texts.size(); k = next++)
      texts[k] = arrays[k].are_integers
                     ? array_as<std::int32_t>("type=\"Int32\" " + attributes_of(arrays[k]), arrays[k].values)
                     : real_array(attributes_of(arrays[k]), arrays[k].values, is_double);
  };
  std::vector<std::future<void>> others;
  for (int thread = 1; thread < algebra::most_threads() && std::ranges::any_of(arrays, has_many_values); ++thread)
    others.push_back(std::async(std::launch::async, work));
  work();
  for (auto& other : others) other.get();
  return texts;
}

std::string piece_text(const GridPiece& piece, bool is_double) {
  if (piece.connectivity.empty()) return "";
  std::string text = fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", piece.points.size() / 3,
                                 piece.connectivity.size() / piece.points_per_cell);
  text += "      <Points>\n" + real_array("NumberOfComponents=\"3\"", piece.points, is_double) + "      </Points>\n";
  text += cells_text(piece) + "      <PointData>\n";
  for (const std::string& array : arrays_text(piece.point_arrays, is_double)) text += array;
  text += "      </PointData>\n";
  if (!piece.cell_arrays.empty()) {
    text += "      <CellData>\n";
    for (const std::string& array : arrays_text(piece.cell_arrays, is_double)) text += array;
    text += "      </CellData>\n";
  }
  return text + "    </Piece>\n";
}

}  // namespace

void add_grid(const std::filesystem::path& path, const std::function<GridPiece()>& own_piece, bool is_double,
              AtomicFiles& files) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(files.comm(), &rank);
  MPI_Comm_size(files.comm(), &ranks);
  files.add(path, [&] {
    std::string text(rank == 0 ? vtu_header : std::string_view());
    text += piece_text(own_piece(), is_double);
    if (rank == ranks - 1) text += vtu_footer;
    return text;
  });
}

}  // namespace plastron::io
