#include <plastron/io/atomic_file.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/scratch_directory.hpp>

namespace plastron::io {

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const MPI_Comm world = MPI_COMM_WORLD;

/// The message of the runtime_error that `action` throws on this rank; "" if it throws none.
template <class Action>
std::string complaint(const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(AtomicFile, holds_the_pieces_of_all_ranks_in_their_order) {
  const ScratchDirectory scratch("pieces");
  const auto piece = [](int rank) {
    return rank == 1 ? std::string() : std::string(1000 + 17 * rank, char('a' + rank));
  };
  write_atomically(
      scratch.path / "file", [&] { return piece(world_rank()); }, world);
  std::string expected;
  for (int rank = 0; rank < world_size(); ++rank) expected += piece(rank);
  EXPECT_EQ(text_of(scratch.path / "file"), expected);
  EXPECT_THAT(scratch.names(), UnorderedElementsAre("file"));
}

TEST(AtomicFile, replaces_an_earlier_longer_file) {
  const ScratchDirectory scratch("replaces");
  const auto write = [&](const char* text) {
    write_atomically(
        scratch.path / "file", [&] { return std::string(world_rank() == 0 ? text : ""); }, world);
  };
  write("a long first text");
  write("short");
  EXPECT_EQ(text_of(scratch.path / "file"), "short");
}

TEST(AtomicFile, a_producer_that_throws_on_one_rank_leaves_the_old_file_and_throws_on_all_ranks) {
  const ScratchDirectory scratch("throws");
  write_atomically(
      scratch.path / "file", [] { return std::string(world_rank() == 0 ? "old" : ""); }, world);
  const auto piece = []() -> std::string {
    if (world_rank() == world_size() - 1) throw std::invalid_argument("no more ink");
    return "new";
  };
  const std::string message = complaint([&] { write_atomically(scratch.path / "file", piece, world); });
  EXPECT_THAT(message, AllOf(HasSubstr((scratch.path / "file").string()), HasSubstr("no more ink")));
  EXPECT_EQ(text_of(scratch.path / "file"), "old");
  EXPECT_THAT(scratch.names(), UnorderedElementsAre("file"));
}

TEST(AtomicFile, a_missing_directory_is_named_with_the_reason) {
  const ScratchDirectory scratch("missing");
  const auto path = scratch.path / "nowhere" / "file";
  const std::string message = complaint([&] {
    write_atomically(
        path, [] { return std::string("x"); }, world);
  });
  EXPECT_THAT(message, AllOf(HasSubstr(path.string()), HasSubstr("No such file or directory")));
  EXPECT_THAT(scratch.names(), IsEmpty());
}

TEST(AtomicFile, a_failed_rename_leaves_no_temporary_file) {
  const ScratchDirectory scratch("rename");
  make_directory(scratch.path / "taken", world);
  const std::string message = complaint([&] {
    write_atomically(
        scratch.path / "taken", [] { return std::string("x"); }, world);
  });
  EXPECT_THAT(message, HasSubstr("Is a directory"));
  EXPECT_THAT(scratch.names(), UnorderedElementsAre("taken"));
}

TEST(AtomicFile, a_full_disk_is_one_error_with_its_reason) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  // The temporary name of the only process is known: a link there sends the text to the device that is always full.
  const ScratchDirectory scratch("full");
  auto process = static_cast<std::int64_t>(getpid());
  MPI_Bcast(&process, 1, MPI_INT64_T, 0, world);
  const auto temporary = scratch.path / ("file." + std::to_string(process) + ".partial");
  if (world_rank() == 0) std::filesystem::create_symlink("/dev/full", temporary);
  MPI_Barrier(world);
  const std::string message = complaint([&] {
    write_atomically(
        scratch.path / "file", [] { return std::string("x"); }, world);
  });
  EXPECT_THAT(message, HasSubstr("No space left on device"));
  EXPECT_THAT(scratch.names(), IsEmpty());
}

TEST(AtomicFile, a_directory_that_cannot_be_made_is_named) {
  const ScratchDirectory scratch("parent");
  write_atomically(
      scratch.path / "file", [] { return std::string("x"); }, world);
  const std::string message = complaint([&] { make_directory(scratch.path / "file" / "below", world); });
  EXPECT_THAT(message, AllOf(HasSubstr("below"), HasSubstr("Not a directory")));
}

}  // namespace

}  // namespace plastron::io
