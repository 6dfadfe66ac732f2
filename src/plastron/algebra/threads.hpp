// Threads follow the work. Threads of the BLAS and of OpenMP spin while they wait, which costs others their time and, on
// a machine with other work, costs us ours: there is one, but for factorisations so large that more of them pay.
#pragma once

namespace plastron::algebra {

/// Operations of a factorisation from which on a second thread of the BLAS pays. Two threads gain nothing at 103 045 unknowns
/// (2e10 to 3e10 at degree 2 and 4) and halve the time at 410 885 (1.2e11 to 1.8e11); docs/performance.md.
inline constexpr double many_operations = 6e10;

/// Cores on which this process may run.
int usable_cores();

/// Stops all threads of BLAS and OpenMP but the calling one, and notes how many a large factorisation may have: `threads`, or
/// with 0 two where there are as many cores, and one if several ranks share the machine. Called once, by Session.
void restrict_threads(int threads, int ranks);

/// How many threads there may be at a time: 1 before restrict_threads().
int most_threads();

/// For a factorisation of so many operations.
int threads_for(double operations);

/// The same, less those for which other programs leave no core at the moment: of threads that wait for each other the one without a core stops
/// all. Where restrict_threads() was given a number it is that.
int threads_now_for(double operations);

/// So many threads in the BLAS while this lives, then one again. A BLAS without such a switch is left alone.
class BlasThreads {
 public:
  explicit BlasThreads(int threads);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  int threads_;
};

}  // namespace plastron::algebra
