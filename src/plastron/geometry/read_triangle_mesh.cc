// Readers of STL, OBJ and PLY files.
#include <plastron/geometry/text_file.hpp>
#include <plastron/geometry/triangle_mesh.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string_view>

namespace plastron::geometry {

namespace {

constexpr double largest_coordinate = 1e50;  // squares of lengths stay finite

static_assert(std::endian::native == std::endian::little, "binary files are read as they are in memory");

/// Joins equal points and cuts polygons into triangles.
class Builder {
 public:
  explicit Builder(std::string path) : path_(std::move(path)) {}

  int add_point(const Vector3d& p) {
    if (!(p.cwiseAbs().maxCoeff() <= largest_coordinate)) throw FileError(path_ + ": a coordinate is not finite");
    const auto [found, is_new] =
        number_.try_emplace({p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}, static_cast<int>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(p);
    return found->second;
  }
  /// The polygons that follow belong to the group. Without a name they belong to none.
  void begin_group(std::string_view name) {
    const auto found = std::ranges::find(mesh_.groups, name);
    group_ = name.empty() ? -1 : static_cast<int>(found - mesh_.groups.begin());
    if (!name.empty() && found == mesh_.groups.end()) mesh_.groups.emplace_back(name);
  }
  void add_polygon(const std::vector<int>& corners) {
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const int a = corners[0], b = corners[k - 1], c = corners[k];
      if (a == b || b == c || c == a) continue;
      if (mesh_.triangles.size() == most_triangles)
        throw FileError(fmt::format("{}: more than {} triangles; make the surface coarser", path_, most_triangles));
      mesh_.triangles.push_back({a, b, c});
      mesh_.group_of.push_back(group_);
    }
  }
  TriangleMesh take() {
    if (mesh_.triangles.empty()) throw FileError(path_ + ": the file has no triangles");
    if (mesh_.groups.empty()) mesh_.group_of.clear();
    return std::move(mesh_);
  }

 private:
  std::string path_;
  TriangleMesh mesh_;
  std::map<std::array<double, 3>, int> number_;
  int group_ = -1;
};

Vector3d vector(TextFile& file) {
  Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = file.real("a coordinate", largest_coordinate);
  return v;
}

void expect(TextFile& file, const char* word) {
  if (!file.take(word)) file.refuse(fmt::format("\"{}\" should stand here", word));
}

void read_facet(TextFile& file, Builder& builder) {
  expect(file, "facet");
  expect(file, "normal");
  // The normal is computed from the corners.
  for (int i = 0; i < 3; ++i) file.word("a normal");
  expect(file, "outer");
  expect(file, "loop");
  std::vector<int> corners;
  for (int k = 0; k < 3; ++k) {
    expect(file, "vertex");
    corners.push_back(builder.add_point(vector(file)));
  }
  expect(file, "endloop");
  expect(file, "endfacet");
  builder.add_polygon(corners);
}

/// Reads the solids one after the other.
void read_ascii_stl(TextFile& file, Builder& builder) {
  do {
    expect(file, "solid");
    builder.begin_group(file.take_rest_of_line());
    while (!file.take("endsolid")) read_facet(file, builder);
    file.take_rest_of_line();
  } while (!file.at_end());
}

/// Numbers as bytes, each checked to be within the text.
class Bytes {
 public:
  Bytes(std::string path, const std::string& text, std::size_t at, bool swapped = false)
      : path_(std::move(path)), text_(text), at_(at), swapped_(swapped) {}

  template <class Number>
  Number take() {
    if (text_.size() - at_ < sizeof(Number)) throw FileError(path_ + ": the file ends too early");
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), text_.data() + at_, sizeof(Number));
    if (swapped_) std::ranges::reverse(raw);
    at_ += sizeof(Number);
    return std::bit_cast<Number>(raw);
  }
  void skip(std::size_t count) { at_ = std::min(at_ + count, text_.size()); }

 private:
  std::string path_;
  const std::string& text_;
  std::size_t at_;
  bool swapped_;
};

constexpr std::size_t stl_head = 84, stl_triangle = 50;

bool is_binary_stl(const std::string& text) {
  if (text.size() < stl_head) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, text.data() + 80, sizeof(count));
  return text.size() == stl_head + stl_triangle * static_cast<std::size_t>(count);
}

void read_stl(TextFile& file, Builder& builder) {
  if (!is_binary_stl(file.text())) {
    if (file.at_end() || file.peek() != "solid")
      throw FileError(file.path() +
                      ": this is no STL file: it neither begins with \"solid\" nor has the length "
                      "that a binary one states; it may have been cut off");
    return read_ascii_stl(file, builder);
  }
  Bytes bytes(file.path(), file.text(), 80);
  const auto count = bytes.take<std::uint32_t>();
  for (std::uint32_t t = 0; t < count; ++t) {
    bytes.skip(3 * sizeof(float));
    std::vector<int> corners;
    for (int k = 0; k < 3; ++k) {
      const double x = bytes.take<float>(), y = bytes.take<float>(), z = bytes.take<float>();
      corners.push_back(builder.add_point({x, y, z}));
    }
    bytes.skip(2);
    builder.add_polygon(corners);
  }
}

/// Reads the corners of a line "f 1 2 3" or "f 1/4 2/5 3/6". Negative numbers count from the last point backwards.
std::vector<int> obj_face(TextFile& file, const std::vector<int>& points) {
  std::vector<int> corners;
  while (file.has_word()) {
    const std::string_view corner = file.word("a corner");
    long given = 0;
    if (!parse(corner.substr(0, corner.find('/')), given))
      file.refuse(fmt::format("found \"{}\" where the number of a point should stand", shown(corner)));
    const long count = static_cast<long>(points.size()), index = given < 0 ? count + given : given - 1;
    if (index < 0 || index >= count) file.refuse(fmt::format("there is no point {} yet", given));
    corners.push_back(points[index]);
  }
  if (corners.size() < 3) file.refuse("a face has fewer than three corners");
  return corners;
}

/// Reads points (v), faces (f) and names of groups and objects (g, o); skips all others.
void read_obj(TextFile& file, Builder& builder) {
  std::vector<int> points;
  while (!file.at_end()) {
    const std::string key(file.word("a word"));
    if (key == "v") {
      points.push_back(builder.add_point(vector(file)));
      file.skip_rest_of_line();
    } else if (key == "f") {
      builder.add_polygon(obj_face(file, points));
    } else if (key == "g" || key == "o") {
      builder.begin_group(file.take_rest_of_line());
    } else {
      file.skip_rest_of_line();
    }
  }
}

struct Property {
  std::string name, type, count_type{};  ///< type of the count, for a list
};
struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties{};
};

/// The next number of a PLY file, as text or as bytes of the type.
class PlyNumbers {
 public:
  PlyNumbers(TextFile& file, const std::string& format, std::size_t body)
      : file_(file),
        is_text_(format == "ascii"),
        bytes_(file.path(), file.text(), body, format == "binary_big_endian") {}

  double take(const std::string& type) {
    if (is_text_) return file_.real("a number", largest_coordinate);
    if (type == "char" || type == "int8") return bytes_.take<std::int8_t>();
    if (type == "uchar" || type == "uint8") return bytes_.take<std::uint8_t>();
    if (type == "short" || type == "int16") return bytes_.take<std::int16_t>();
    if (type == "ushort" || type == "uint16") return bytes_.take<std::uint16_t>();
    if (type == "int" || type == "int32") return bytes_.take<std::int32_t>();
    if (type == "uint" || type == "uint32") return bytes_.take<std::uint32_t>();
    if (type == "float" || type == "float32") return bytes_.take<float>();
    if (type == "double" || type == "float64") return bytes_.take<double>();
    throw FileError(file_.path() + ": a property has a type that PLY does not know");
  }

 private:
  TextFile& file_;
  bool is_text_;
  Bytes bytes_;
};

void read_ply_element(TextFile& file, const Element& element, PlyNumbers& numbers, std::vector<int>& points,
                      Builder& builder) {
  for (std::size_t i = 0; i < element.count; ++i) {
    Vector3d at = Vector3d::Zero();
    std::vector<int> corners;
    for (const Property& property : element.properties) {
      const double count = property.count_type.empty() ? 1 : numbers.take(property.count_type);
      constexpr double most_corners = 1000;
      if (!(count >= 0 && count <= most_corners)) throw FileError(file.path() + ": a list is too long");
      for (int k = 0; k < static_cast<int>(count); ++k) {
        const double value = numbers.take(property.type);
        for (int a = 0; a < 3; ++a)
          if (property.name == std::string(1, "xyz"[a])) at[a] = value;
        if (element.name != "face" || property.count_type.empty() || property.name.find("ind") == std::string::npos)
          continue;
        if (!(value >= 0 && value < static_cast<double>(points.size())))
          throw FileError(
              fmt::format("{}: face {} names the point {}, which does not exist", file.path(), i + 1, value));
        corners.push_back(points[static_cast<std::size_t>(value)]);
      }
    }
    if (element.name == "vertex") points.push_back(builder.add_point(at));
    if (element.name == "face") builder.add_polygon(corners);
  }
}

void read_ply(TextFile& file, Builder& builder) {
  expect(file, "ply");
  std::string format;
  std::vector<Element> elements;
  std::size_t body = 0;
  for (;;) {
    const std::string key(file.word("a line of the header"));
    if (key == "end_header") break;
    if (key == "format") {
      format = file.word("the format");
    } else if (key == "element") {
      const std::string name(file.word("the name of an element"));
      const std::int64_t count = file.integer("a count");
      if (count < 0) file.refuse("a count is negative");
      elements.push_back({name, static_cast<std::size_t>(count)});
    } else if (key == "property") {
      if (elements.empty()) file.refuse("a property belongs to no element");
      Property property;
      if (file.take("list")) property.count_type = file.word("a type");
      property.type = file.word("a type");
      property.name = file.word("the name of a property");
      elements.back().properties.push_back(property);
      continue;
    }
    file.skip_rest_of_line();
  }
  body = file.text().find('\n', file.text().find("end_header")) + 1;
  if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
    throw FileError(file.path() + ": the PLY file names no format of ascii, binary_little_endian, binary_big_endian");
  PlyNumbers numbers(file, format, body);
  std::vector<int> points;
  for (const Element& element : elements)
    if (!element.properties.empty()) read_ply_element(file, element, numbers, points, builder);
}

/// The end of a file's name in small letters.
std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

bool is_triangle_file(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".stl" || ending == ".obj" || ending == ".ply";
}

TriangleMesh read_triangle_mesh(const std::string& path) {
  if (!is_triangle_file(path)) throw FileError(path + ": the file's name must end in .stl, .obj or .ply");
  const std::string ending = ending_of(path);
  Builder builder(path);
  TextFile file(path, "file", Lines::run_on);
  if (ending == ".stl") read_stl(file, builder);
  if (ending == ".obj") read_obj(file, builder);
  if (ending == ".ply") read_ply(file, builder);
  TriangleMesh mesh = builder.take();
  join_near_points(mesh);
  return mesh;
}

}  // namespace plastron::geometry
