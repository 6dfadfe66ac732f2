// Threads follow the amount of work: small systems use one, and results do not depend on how threads interleave.
#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/threads.hpp>

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>
#include <vector>

#include "algebra/chain.hpp"

namespace plastron::test {
namespace {

using algebra::BlasThreads;
using algebra::Factorisation;
using algebra::threads_for;

constexpr double many = 100 * algebra::many_operations;
constexpr int block = 3;

/// The environment of the test programs (test_main.cc).
class Threads : public testing::Test {
 protected:
  ~Threads() override { algebra::restrict_threads(1, ranks()); }
};

/// A full matrix of 600 unknowns: one supernode, on which a BLAS with several threads would use all of them.
Matrix full_matrix() {
  constexpr GlobalIndex nodes = 200;
  constexpr std::size_t size = nodes * block;
  Elements elements(1);
  for (GlobalIndex i = 0; i < nodes; ++i) elements[0].push_back(i);
  const auto layout = layout_for(nodes, elements);
  Matrix A(layout, block, connectivity(*layout, elements));
  std::vector<double> values(size * size);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j)
      values[i * size + j] =
          i == j ? 400 : std::cos(static_cast<double>(i + j) + 0.1 * static_cast<double>(i * j % 97));
  if (layout->owns(0)) A.add(local_nodes(*layout, elements[0]), values);
  A.finish();
  return A;
}

double seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::vector<double> solution(Factorisation& F, const Matrix& A) {
  const std::vector<char> fixed(static_cast<std::size_t>(A.layout()->owned) * block, 0);
  EXPECT_TRUE(F.factorise(fixed));
  const auto b = vector_of(A.layout(), block, [](GlobalIndex i) { return std::sin(static_cast<double>(i)); });
  Vector x(A.layout(), block);
  F.solve(b, x);
  return {x.owned().begin(), x.owned().end()};
}

TEST_F(Threads, AreAddedForLargeFactorisationsOnly) {
  algebra::restrict_threads(3, 1);
  EXPECT_EQ(threads_for(0.9 * algebra::many_operations), 1);
  EXPECT_EQ(threads_for(many), 3);
}

TEST_F(Threads, AreByDefaultNoMoreThanTheCores) {
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  for (int core = 0; CPU_COUNT(&one) == 0; ++core)
    if (CPU_ISSET(core, &all)) CPU_SET(core, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(algebra::usable_cores(), 1);
  algebra::restrict_threads(0, 1);
  EXPECT_EQ(threads_for(many), 1);
  ASSERT_EQ(sched_setaffinity(0, sizeof all, &all), 0);
  EXPECT_EQ(algebra::usable_cores(), CPU_COUNT(&all));
}

TEST_F(Threads, AreNoMoreThanOthersLeaveCoresFor) {
  std::atomic<bool> stop = false;
  std::vector<std::thread> others;
  for (long i = 0; i < sysconf(_SC_NPROCESSORS_ONLN); ++i)
    others.emplace_back([&] {
      while (!stop) {
      }
    });
  algebra::restrict_threads(0, 1);
  const int by_default = algebra::threads_now_for(many);
  algebra::restrict_threads(2, 1);
  const int given = algebra::threads_now_for(many);
  stop = true;
  for (std::thread& other : others) other.join();
  EXPECT_EQ(by_default, 1);
  EXPECT_EQ(given, 2);
}

TEST_F(Threads, OfSeveralRanksAreOneEach) {
  algebra::restrict_threads(0, 2);
  EXPECT_EQ(threads_for(many), 1);
}

/// OpenBLAS makes threads before main() begins. They spin for a tenth of a second before they sleep for the first time.
void wait_for_threads_to_sleep() {
  constexpr auto moment = std::chrono::milliseconds(20);
  constexpr double asleep = 1e-3;
  double before = seconds(CLOCK_PROCESS_CPUTIME_ID) - 1;
  for (int i = 0; i < 100 && seconds(CLOCK_PROCESS_CPUTIME_ID) - before > asleep; ++i) {
    before = seconds(CLOCK_PROCESS_CPUTIME_ID);
    std::this_thread::sleep_for(moment);
  }
}

// Waiting threads of the BLAS or of OpenMP spin. This shows as processor time beyond the caller's.
TEST_F(Threads, BesideTheCallersTakeNoTimeInASmallFactorisation) {
  const Matrix A = full_matrix();
  Factorisation F(A);
  solution(F, A);
  wait_for_threads_to_sleep();
  const double process = seconds(CLOCK_PROCESS_CPUTIME_ID), caller = seconds(CLOCK_THREAD_CPUTIME_ID);
  for (int i = 0; i < 20; ++i) solution(F, A);
  const double own = seconds(CLOCK_THREAD_CPUTIME_ID) - caller;
  EXPECT_LT(seconds(CLOCK_PROCESS_CPUTIME_ID) - process - own, 0.2 * own);
}

TEST_F(Threads, TwoGiveTheSameBitsEveryTime) {
  const BlasThreads two(2);
  const Matrix A = full_matrix();
  Factorisation F(A);
  const auto first = solution(F, A);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(solution(F, A), first);
}

}  // namespace
}  // namespace plastron::test
