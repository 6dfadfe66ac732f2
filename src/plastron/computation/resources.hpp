// Time and memory of a computation.
#pragma once
#include <mpi.h>

#include <chrono>
#include <string>

namespace plastron::computation {

/// A stopwatch of wall time with laps.
class Stopwatch {
 public:
  /// Seconds since the last lap, or since construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

  /// Seconds since the last lap, without starting a new one.
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count(); }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Peak resident memory of all ranks together [bytes] (collective).
double peak_memory(MPI_Comm comm);

/// Peak resident memory of the ranks on one machine, and the memory that they may use there. The limit is the free
/// memory plus their own, at most the limit of their control group. Data of the machine with the largest ratio
/// (collective).
struct MemoryUse {
  double peak = 0;   ///< [bytes]
  double limit = 0;  ///< [bytes]
};
MemoryUse memory_use(MPI_Comm comm);

/// Returns the reason why a mesh with `growth` times the unknowns of the largest one so far does not fit into memory;
/// empty if it fits.
std::string memory_obstacle(const MemoryUse& use, double growth);

}  // namespace plastron::computation
