// Input files of Abaqus and CalculiX that tests write, and the reader's answer to a text.
#pragma once
#include <plastron/domain/mesh_data.hpp>

#include "domain/written_mesh.hpp"

namespace plastron::domain::written {

inline MeshData deck(const std::string& text) {
  const TemporaryPath path(".inp");
  std::ofstream(path.path) << text;
  return read_inp_file(path.path.string());
}

inline std::string deck_refusal(const std::string& text) {
  try {
    deck(text);
  } catch (const mesh::DomainError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

/// A strip of two squares: nodes 1 to 3 below, 4 to 6 above.
///   4---5---6
///   | 1 | 2 |
///   1---2---3
inline const std::string strip_nodes = "*NODE\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n";
inline const std::string strip = strip_nodes + "*ELEMENT, TYPE=S4\n1, 1,2,5,4\n2, 2,3,6,5\n";

/// One element of 8 nodes with the chart (s + t^2 / 4, t, s t), and sets, surfaces and normals of all kinds.
inline const std::string curved_deck =
    "*Heading\n a curved quadrilateral, * no keyword\n** comment\n"
    "*Node, nset=Nall\n"
    "1, 0., 0., 0., 0., 0., 1.\n 2, 1., 0, 0\n3, 1.25, 1., 1.\n4, .25, 1.0D0, 0.\n"
    "5, 5e-1, , 0.\n6, 1.0625, .5, .5\n7, .75, 1., 5.0d-1\n8, 0.0625, 0.5, 0\n"
    "*Element, type=S8R, elset=panel\n 7, 1, 2, 3, 4,\n 5, 6, 7, 8\n"
    "*Nset, nset=south\n1, 2, 5\n*Nset, nset=\"long side\", generate\n 1, 4, 3\n 8, 8\n"
    "*Nset, nset=both\n south, \"long side\"\n*Nset, nset=corner\n3,\n"
    "*Elset, elset=all\npanel\n*Surface, name=top, type=ELEMENT\nall, SPOS\n*Surface, name=east\n7, E2\n"
    "*Normal\n all, 3, 0., 0., 2.\n*Shell Section, elset=panel, material=steel\n0.01, 5\n"
    "*Material, name=steel\n*Elastic\n2.1e11, 0.3\n*Boundary\nsouth, 1, 6\n*Step\n*Static\n*End Step\n";

/// Abaqus/CAE's form, with a part, an instance and sets of both.
inline const std::string cae_deck =
    "*Part, name=Panel\n" + strip +
    "*Nset, nset=Set-1, generate\n 1, 6, 1\n*Elset, elset=Set-1, generate\n 1, 2, 1\n"
    "*Shell Section, elset=Set-1, material=M\n1., 5\n*End Part\n"
    "*Assembly, name=Assembly\n*Instance, name=Panel-1, part=Panel\n*End Instance\n"
    "*Node\n 1, 5., 5., 5.\n*Nset, nset=RP\n1,\n*Element, type=MASS, elset=M\n1, 1\n"
    "*Nset, nset=Set-1, instance=Panel-1\n 1, 4\n*Nset, nset=right\nPanel-1.3, Panel-1.6\n"
    "*Elset, elset=_Rim_E1, internal, instance=Panel-1, generate\n 1, 2\n"
    "*Surface, type=ELEMENT, name=Rim\n_Rim_E1, E1\n*End Assembly\n*Step\n*End Step\n";

}  // namespace plastron::domain::written
