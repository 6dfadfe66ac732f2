// Reads STEP and BREP files by Open CASCADE. Names of faces come from the map between the entities of the file and the
// shapes made of them: Open CASCADE's own documents of names would need its libraries of windows.
#include "part.hpp"

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Quantity_Color.hxx>
#include <STEPConstruct_Styles.hxx>
#include <STEPControl_Reader.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepVisual_Colour.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <gp_Trsf.hxx>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace plastron::cad {

namespace {

using Labels = std::map<const Standard_Transient*, FaceLabel>;  // by the shape that all copies of a face share

const Standard_Transient* shared_shape(const TopoDS_Shape& shape) { return shape.TShape().get(); }

TopoDS_Shape result_of(const Handle(Transfer_TransientProcess) & process, const Handle(Standard_Transient) & entity) {
  const Handle(Transfer_Binder) binder = process->Find(entity);
  return binder.IsNull() ? TopoDS_Shape() : TransferBRep::ShapeResult(binder);
}

/// A name as messages and mesh files can hold it: CAD programs write them in many encodings.
std::string printable(std::string name) {
  constexpr std::size_t longest = 120;
  for (char& c : name)
    if (c < ' ' || c > '~') c = '_';
  return name.substr(0, longest);
}

void add_names(const STEPControl_Reader& reader, Labels& labels) {
  const auto process = reader.WS()->TransferReader()->TransientProcess();
  const auto model = reader.WS()->Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model->Value(i));
    if (face.IsNull() || face->Name().IsNull() || face->Name()->IsEmpty()) continue;
    const TopoDS_Shape shape = result_of(process, face);
    if (!shape.IsNull()) labels[shared_shape(shape)].name = printable(face->Name()->ToCString());
  }
}

void add_colours(const STEPControl_Reader& reader, Labels& labels) {
  STEPConstruct_Styles styles(reader.WS());
  if (!styles.LoadStyles()) return;
  const auto process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= styles.NbStyles(); ++i) {
    const auto style = styles.Style(i);
    if (style.IsNull() || style->Item().IsNull()) continue;
    Handle(StepVisual_Colour) surface, border, curve, rendered;
    double transparency = 0;
    bool is_component = false;
    if (!styles.GetColors(style, surface, border, curve, rendered, transparency, is_component)) continue;
    Quantity_Color colour;
    const auto& seen = surface.IsNull() ? rendered : surface;
    if (seen.IsNull() || !STEPConstruct_Styles::DecodeColor(seen, colour)) continue;
    const TopoDS_Shape shape = result_of(process, style->Item());
    if (shape.IsNull()) continue;
    const auto part = [](double of_one) { return static_cast<int>(std::lround(255 * of_one)); };
    Standard_Real red = 0, green = 0, blue = 0;
    colour.Values(red, green, blue, Quantity_TOC_sRGB);
    const std::string text = fmt::format("#{:02x}{:02x}{:02x}", part(red), part(green), part(blue));
    // The colour of a body is that of its faces, unless they have their own.
    const bool is_face = shape.ShapeType() == TopAbs_FACE;
    for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
      std::string& known = labels[shared_shape(face.Current())].colour;
      if (is_face || known.empty()) known = text;
    }
  }
}

void add_faces(const TopoDS_Shape& shape, const Labels& labels, PartFile& part) {
  TopTools_IndexedMapOfShape faces, solids;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_SOLID, solids);
  for (int i = 1; i <= solids.Extent(); ++i) part.solids.push_back(solids(i));
  for (int i = 1; i <= faces.Extent(); ++i) {
    LabelledFace face{.face = TopoDS::Face(faces(i)), .number = i};
    if (const auto found = labels.find(shared_shape(faces(i))); found != labels.end()) face.label = found->second;
    part.faces.push_back(std::move(face));
  }
}

/// Multiplies all lengths. Faces and solids keep their order.
void scale_by(double factor, const TopoDS_Shape& shape, PartFile& part) {
  gp_Trsf scale;
  scale.SetScaleFactor(factor);
  PartFile scaled;
  add_faces(BRepBuilderAPI_Transform(shape, scale, true).Shape(), {}, scaled);
  for (std::size_t i = 0; i < part.faces.size(); ++i) part.faces[i].face = scaled.faces[i].face;
  part.solids = std::move(scaled.solids);
}

/// Value of a unit of length that a STEP file names [mm].
std::optional<double> unit_of_file(STEPControl_Reader& reader, std::string& name) {
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  if (lengths.IsEmpty()) return {};
  name = lengths.First().ToCString();
  const std::map<std::string, std::pair<const char*, double>> known{
      {"millimetre", {"mm", 1}},    {"metre", {"m", 1e3}},          {"centimetre", {"cm", 10}},
      {"micrometre", {"um", 1e-3}}, {"kilometre", {"km", 1e6}},     {"INCH", {"in", 25.4}},
      {"inch", {"in", 25.4}},       {"FOOT", {"ft", 304.8}},        {"foot", {"ft", 304.8}},
      {"MIL", {"mil", 0.0254}},     {"MICROINCH", {"uin", 2.54e-5}}};
  const auto found = known.find(name);
  if (found == known.end()) return {};
  name = found->second.first;
  return found->second.second;
}

void refuse_what_is_no_step(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string start(4096, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  if (start.find("ISO-10303-21") == std::string::npos)
    throw PartError(
        "it is no STEP file: it does not begin with ISO-10303-21; export the part as STEP (AP203, AP214 or "
        "AP242)");
}

PartFile read_step(const Job& job) {
  refuse_what_is_no_step(job.part);
  STEPControl_Reader reader;
  if (reader.ReadFile(job.part.c_str()) != IFSelect_RetDone)
    throw PartError("Open CASCADE cannot read it: the STEP file is damaged or incomplete; export it again");
  PartFile part;
  const auto file_unit = unit_of_file(reader, part.unit);
  const double stated = job.file_unit ? *job.file_unit : file_unit ? 0 : job.default_unit.value_or(0);
  if (!file_unit && stated == 0)
    throw PartError(
        part.unit.empty()
            ? "the file does not say in which unit its lengths are; state it: unit = \"mm\""
            : fmt::format("the unit of its lengths, \"{}\", is not known; state it: unit = \"mm\"", part.unit));
  reader.TransferRoots();
  const TopoDS_Shape shape = reader.OneShape();
  if (shape.IsNull()) throw PartError("it has no shape that Open CASCADE can make of it; export the part again");
  Labels labels;
  add_names(reader, labels);
  add_colours(reader, labels);
  // Open CASCADE has converted the file's unit to mm, or taken mm where it knew none.
  const double factor = stated > 0 ? stated * 1e3 / file_unit.value_or(1) : 1;
  add_faces(shape, labels, part);
  if (factor != 1) scale_by(factor, shape, part);
  return part;
}

PartFile read_brep(const Job& job) {
  TopoDS_Shape shape;
  if (!BRepTools::Read(shape, job.part.c_str(), BRep_Builder()) || shape.IsNull())
    throw PartError("Open CASCADE cannot read it: it is no BREP file, or it is damaged");
  const double stated = job.file_unit.value_or(job.default_unit.value_or(0));
  if (stated == 0) throw PartError("a BREP file does not say in which unit its lengths are; state it: unit = \"mm\"");
  PartFile part;
  add_faces(shape, {}, part);
  if (stated != 1e-3) scale_by(stated * 1e3, shape, part);
  return part;
}

}  // namespace

double area_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties);
  return properties.Mass();
}

double precise_area_of(const TopoDS_Shape& shape) {
  constexpr double digits = 1e-11;
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties, digits);
  return properties.Mass();
}

double length_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::LinearProperties(shape, properties);
  return properties.Mass();
}

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

double diagonal_of(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, false, false);
  if (box.IsVoid()) throw PartError("its faces have no extent");
  return std::sqrt(box.SquareExtent());
}

PartFile read_part(const Job& job) {
  std::string end = std::filesystem::path(job.part).extension().string();
  std::ranges::transform(end, end.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  PartFile part = end == ".brep" ? read_brep(job) : read_step(job);
  if (part.faces.empty())
    throw PartError("it has no surfaces, only curves or points: a shell needs the faces of the part; export them, too");
  return part;
}

}  // namespace plastron::cad
