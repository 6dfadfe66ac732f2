// The job of plastron-cad: the part, and the mesh to make of it. Lengths of the job are in the case's unit; the program
// computes in millimetres, as Open CASCADE does.
#pragma once
#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plastron::cad {

/// An error in a part, as a sentence for the user.
struct PartError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A name of the case for faces or edges.
struct Selection {
  std::string name;
  nlohmann::json selector;            ///< a name, a list of names, or conditions that all must hold
  std::optional<double> thickness{};  ///< of a region of the shell, if it is one number, in the case's unit
};

struct Job {
  std::string part;                      ///< path of the CAD file
  double unit = 1;                       ///< the case's unit of length [m]
  std::optional<double> file_unit{};     ///< unit of the numbers in the file, if the case states it [m]
  std::optional<double> default_unit{};  ///< the same where the file names none
  std::optional<double> size{};          ///< sides of the cells, in the case's unit
  std::optional<double> tolerance{};     ///< edges nearer than this are one edge, in the case's unit
  std::optional<double> thickness{};     ///< of the shell, if it is one number, in the case's unit
  std::map<std::string, std::optional<double>> thicknesses{};  ///< the same of regions, by name
  double offset = 0;                                           ///< of the case, as a part of the thickness
  bool takes_skins = false;  ///< whether the faces of thin solids are the shell, and not the middle between them
  nlohmann::json faces{};    ///< which faces are the shell; null: all
  std::vector<Selection> regions{}, boundaries{};
  std::vector<std::pair<std::string, double>> constants{};  ///< names in conditions

  double mm() const { return unit * 1e3; }  ///< the case's unit of length [mm]
};

/// Reads a job. The program that starts this one writes it, so a mistake in it is no mistake of the user.
Job read_job(const std::string& part, const std::string& text);

}  // namespace plastron::cad
