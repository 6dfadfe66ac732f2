// Starts MPI and the algebra around the tests of a program. Rank 0 reports, the others print only their failures, and a failure of any rank
// counts. With --files=a_test.cc,b_test.cc only the tests of these files run.
#include <plastron/algebra/session.hpp>

#include <gtest/gtest.h>
#include <mpi.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <set>
#include <sstream>
#include <string>

/// Open MPI and OpenBLAS call this function again and again while they wait. On idle cores the C library's version returns at once, and a sum
/// over ranks takes a few microseconds; a rank that sleeps needs a hundred to wake up. On busy cores each call hands a whole time slice to
/// another process. After such a call the rank sleeps while it waits, because Linux wakes a sleeping process before the other slices end.
extern "C" int sched_yield() noexcept {
  using Clock = std::chrono::steady_clock;
  static thread_local Clock::time_point busy_until;
  const Clock::time_point now = Clock::now();
  if (now < busy_until) {
    const timespec moment{.tv_sec = 0, .tv_nsec = 20'000};
    nanosleep(&moment, nullptr);
  } else {
    syscall(SYS_sched_yield);
    if (Clock::now() - now > std::chrono::milliseconds(1)) busy_until = now + std::chrono::milliseconds(50);
  }
  return 0;
}

namespace {

const std::string files_option = "--files=";

std::string name_of(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

/// GoogleTest's filter for the tests of these files, separated by commas.
std::string filter_for(const std::string& files) {
  std::set<std::string> names;
  std::istringstream list(files);
  for (std::string file; std::getline(list, file, ',');) names.insert(name_of(file));
  std::string filter;
  const auto& unit_test = *testing::UnitTest::GetInstance();
  for (int i = 0; i < unit_test.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *unit_test.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const testing::TestInfo& test = *suite.GetTestInfo(k);
      if (names.contains(name_of(test.file()))) filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter.empty() ? "no test is in " + files : filter;
}

class Failures : public testing::EmptyTestEventListener {
 public:
  explicit Failures(int rank) : rank_(rank) {}
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (result.failed())
      std::fprintf(stderr, "rank %d: %s:%d: %s\n", rank_, result.file_name() ? result.file_name() : "?",
                   result.line_number(), result.message());
  }

 private:
  int rank_;
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1 && std::string(argv[1]).starts_with(files_option))
    GTEST_FLAG_SET(filter, filter_for(std::string(argv[1]).substr(files_option.size())));
  const plastron::algebra::Session session(argc, argv, 1);  // one thread: tests run side by side
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Failures(rank));
  }
  int failed = RUN_ALL_TESTS();
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 0) failed = 1;
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return failed;
}
