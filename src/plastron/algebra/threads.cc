#include <plastron/algebra/threads.hpp>

#include <dlfcn.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <thread>

namespace plastron::algebra {
namespace {

/// Larger numbers have not been measured.
constexpr int most_by_default = 2;

int limit = 1;
bool is_limit_given = false;

// Finds the function by name, since another BLAS or OpenMP does not have it.
void call_if_there(const char* name, int value) {
  using Setter = void (*)(int);
  if (const auto set = reinterpret_cast<Setter>(dlsym(RTLD_DEFAULT, name))) set(value);
}
int ask_if_there(const char* name, int otherwise) {
  using Getter = int (*)();
  const auto get = reinterpret_cast<Getter>(dlsym(RTLD_DEFAULT, name));
  return get ? get() : otherwise;
}

/// Returns the number of threads that run or wait for a core on the whole machine, including this one. It is the least
/// of a few readings, since many threads exist for an instant only. 0 if the system does not show it.
int running_threads() {
  constexpr int looks = 5;
  int least = std::numeric_limits<int>::max();
  for (int look = 0; look < looks; ++look) {
    if (look > 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::ifstream loads("/proc/loadavg");
    double last = 0;
    int running = 0;
    if (!(loads >> last >> last >> last >> running)) return 0;
    least = std::min(least, running);
  }
  return least;
}

void set_blas_threads(int threads) { call_if_there("openblas_set_num_threads", threads); }

}  // namespace

int usable_cores() {
  cpu_set_t cores;
  return sched_getaffinity(0, sizeof cores, &cores) == 0 ? std::max(1, CPU_COUNT(&cores)) : 1;
}

// CHOLMOD requests four threads for any OMP_NUM_THREADS; without active levels it gets one. MUMPS uses the default.
void restrict_openmp() {
  call_if_there("omp_set_num_threads", 1);
  call_if_there("omp_set_max_active_levels", 0);
}

// OpenBLAS starts with OPENBLAS_NUM_THREADS or all cores: this number is respected as a limit.
void restrict_threads(int threads, int ranks) {
  const int by_default =
      ranks > 1 ? 1 : std::min({most_by_default, usable_cores(), ask_if_there("openblas_get_num_threads", 1)});
  is_limit_given = threads > 0;
  limit = is_limit_given ? threads : by_default;
  set_blas_threads(1);
  restrict_openmp();
}

int most_threads() { return limit; }

int threads_for(double operations) { return operations < many_operations ? 1 : limit; }

int threads_now_for(double operations) {
  const int threads = threads_for(operations);
  if (threads == 1 || is_limit_given) return threads;
  const int idle = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)) - running_threads();
  return std::clamp(1 + idle, 1, threads);
}

BlasThreads::BlasThreads(int threads) : threads_(threads) {
  if (threads_ > 1) set_blas_threads(threads_);
}

BlasThreads::~BlasThreads() {
  if (threads_ > 1) set_blas_threads(1);
}

}  // namespace plastron::algebra
