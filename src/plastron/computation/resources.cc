#include <plastron/computation/resources.hpp>

#include <plastron/algebra/vector.hpp>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

namespace plastron::computation {

namespace {

/// Peak memory of this process [bytes].
double own_peak() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);  // Linux counts kilobytes
}

/// Resident memory of this process now [bytes].
double own_memory() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  return file >> all >> resident ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) : own_peak();
}

/// Memory that other processes do not use [bytes]; infinite if unknown.
double free_memory() {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("MemAvailable:")) return 1024 * std::stod(line.substr(13));
  return std::numeric_limits<double>::infinity();
}

/// Memory limit of the control group, as containers and batch systems set it [bytes]; infinite without one.
double group_limit() {
  for (const char* name : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::ifstream file(name);
    double limit = 0;
    if (file >> limit && limit > 0) return limit;  // version 2 says "max" where there is none
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

double peak_memory(MPI_Comm comm) { return algebra::sum_over_ranks(own_peak(), comm); }

MemoryUse memory_use(MPI_Comm comm) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MemoryUse use{.peak = algebra::sum_over_ranks(own_peak(), machine)};
  const double own = algebra::sum_over_ranks(own_memory(), machine);
  use.limit = algebra::min_over_ranks(std::min(free_memory() + own, group_limit()), machine);
  MPI_Comm_free(&machine);
  // The machine with the largest used part of its memory decides.
  const double part = algebra::max_over_ranks(use.peak / use.limit, comm);
  if (use.peak / use.limit < part) use = {};
  return {.peak = algebra::max_over_ranks(use.peak, comm), .limit = algebra::max_over_ranks(use.limit, comm)};
}

std::string memory_obstacle(const MemoryUse& use, double growth) {
  constexpr double exponent = 1.2;  // memory of factors in the unknowns (docs/performance.md)
  constexpr double usable = 0.9;
  const double next = use.peak * std::pow(std::max(growth, 1.0), exponent);
  if (!(growth > 1) || next <= usable * use.limit) return "";
  return fmt::format("the next mesh would take about {:.2g} GB of memory, and there are {:.2g} GB for it", next / 1e9,
                     use.limit / 1e9);
}

}  // namespace plastron::computation
