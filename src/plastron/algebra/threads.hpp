// Number of threads by amount of work. Threads of the BLAS and of OpenMP spin while they wait. This costs others their
// time and, on a machine with other work, costs us ours. Therefore one thread is used, except for factorisations large
// enough for more.
#pragma once

namespace plastron::algebra {

/// Number of operations of a factorisation from which a second thread of the BLAS is useful. Two threads gain nothing
/// at 103 045 unknowns (2e10 to 3e10 at degree 2 and 4) and halve the time at 410 885 (1.2e11 to 1.8e11);
/// docs/performance.md.
inline constexpr double many_operations = 6e10;

/// Number of cores on which this process may run.
int usable_cores();

/// Stops all threads of BLAS and OpenMP except the calling one, and stores the limit for a large factorisation:
/// `threads`. If `threads` is 0, the limit is two where there are as many cores, and one if several ranks share the
/// machine. Called once, by Session.
void restrict_threads(int threads, int ranks);

/// Gives the calling thread one thread of OpenMP, because OpenMP keeps these settings for each thread. A process must not start others
/// before fork(): GNU's OpenMP would wait in the child for threads that the child does not have.
void restrict_openmp();

/// Largest number of threads at a time: 1 before restrict_threads().
int most_threads();

/// Number of threads for a factorisation with this number of operations.
int threads_for(double operations);

/// The same number, reduced by the threads for which other programs leave no core at the moment. Among threads that
/// wait for each other, one without a core stops all. If restrict_threads() was given a number, it is this number.
int threads_now_for(double operations);

/// Sets the number of BLAS threads while this object exists, then one again. A BLAS without such a switch is unchanged.
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
