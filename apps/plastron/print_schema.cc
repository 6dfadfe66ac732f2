// plastron schema: the JSON Schema of the case file or of results.json.
#include "inquiries.hpp"
#include "terminal.hpp"

#include <plastron/config/schema.hpp>
#include <plastron/io/results_schema.hpp>

#include <nlohmann/json.hpp>

namespace plastron::app {

ExitCode print_schema(const std::string& of) {
  const auto schema = of == "results" ? io::results_schema() : config::case_schema();
  if (is_first_rank()) print_raw(stdout, schema.dump(2) + "\n");
  return solved;
}

}  // namespace plastron::app
