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

void write_atomically(const std::filesystem::path& path, const Piece& piece, MPI_Comm comm) {
  AtomicFiles one(comm);
  one.add(path, piece);
  one.commit();
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
  const ScratchDirectory scratch("full");
  std::string message;
  {
    const FileSizeLimit full(100);
    message = complaint([&] {
      write_atomically(
          scratch.path / "file", [] { return std::string(200, 'x'); }, world);
    });
  }
  EXPECT_THAT(message, HasSubstr("File too large"));
  EXPECT_THAT(scratch.names(), IsEmpty());
}

// ---- several files that belong together ------------------------------------------------------------------------------

std::string only_on_first(const char* text) { return world_rank() == 0 ? text : ""; }

TEST(AtomicFiles, appear_together_and_in_their_order) {
  const ScratchDirectory scratch("together");
  AtomicFiles files(world);
  files.add(scratch.path / "a", [] { return only_on_first("first"); });
  files.add(scratch.path / "b", [] { return only_on_first("second"); });
  MPI_Barrier(world);
  for (const std::string& name : scratch.names()) EXPECT_TRUE(name.starts_with(".plastron-partial-")) << name;
  MPI_Barrier(world);
  files.commit();
  EXPECT_THAT(scratch.names(), UnorderedElementsAre("a", "b"));
  EXPECT_EQ(text_of(scratch.path / "b"), "second");
  MPI_Barrier(world);
}

TEST(AtomicFiles, leave_those_of_before_when_one_of_them_cannot_be_written) {
  const ScratchDirectory scratch("one-fails");
  write_atomically(
      scratch.path / "a", [] { return only_on_first("old"); }, world);
  const std::string message = complaint([&] {
    AtomicFiles files(world);
    files.add(scratch.path / "a", [] { return only_on_first("new"); });
    files.add(scratch.path / "b", []() -> std::string { throw std::runtime_error("no more ink"); });
    files.commit();
  });
  EXPECT_THAT(message, HasSubstr("no more ink"));
  MPI_Barrier(world);
  EXPECT_THAT(scratch.names(), UnorderedElementsAre("a"));
  EXPECT_EQ(text_of(scratch.path / "a"), "old");
  MPI_Barrier(world);
}

TEST(AtomicFiles, replace_none_when_a_directory_is_in_the_way_of_one) {
  const ScratchDirectory scratch("in-the-way");
  make_directory(scratch.path / "b", world);
  const std::string message = complaint([&] {
    AtomicFiles files(world);
    files.add(scratch.path / "a", [] { return only_on_first("new"); });
    files.add(scratch.path / "b", [] { return only_on_first("new"); });
    files.commit();
  });
  EXPECT_THAT(message, HasSubstr("Is a directory"));
  MPI_Barrier(world);
  EXPECT_THAT(scratch.names(), UnorderedElementsAre("b"));
  MPI_Barrier(world);
}

TEST(TriedDirectory, loses_what_killed_runs_have_left_but_nothing_of_runs_that_go_on) {
  const ScratchDirectory scratch("killed");
  const auto left = scratch.path / ".plastron-partial-killed", elsewhere = scratch.path / "elsewhere";
  if (world_rank() == 0) {
    std::filesystem::create_directory(left);
    std::ofstream(left / "results.json") << "{";
    std::filesystem::create_directory(elsewhere);
    std::ofstream(elsewhere / "kept") << "kept";
    std::filesystem::create_directory_symlink(elsewhere, scratch.path / ".plastron-partial-link");
  }
  MPI_Barrier(world);
  AtomicFiles running(world);
  running.add(scratch.path / "a", [] { return only_on_first("first"); });
  std::vector<std::filesystem::path> made;
  try_directory(scratch.path, world, made);
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(elsewhere / "kept"));
  MPI_Barrier(world);
  running.commit();
  EXPECT_EQ(text_of(scratch.path / "a"), "first");
  MPI_Barrier(world);
}

TEST(TriedDirectory, is_left_empty_and_can_be_removed_with_those_above_it) {
  const ScratchDirectory scratch("tried");
  std::vector<std::filesystem::path> made;
  try_directory(scratch.path / "x" / "y", world, made);
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path / "x" / "y"));
  MPI_Barrier(world);
  remove_empty(made, world);
  MPI_Barrier(world);
  EXPECT_THAT(scratch.names(), IsEmpty());
  MPI_Barrier(world);
}

TEST(TriedDirectory, stays_when_it_was_there_before_or_holds_something) {
  const ScratchDirectory scratch("kept");
  std::vector<std::filesystem::path> none, made;
  try_directory(scratch.path, world, none);
  try_directory(scratch.path / "x", world, made);
  write_atomically(
      scratch.path / "x" / "file", [] { return only_on_first("kept"); }, world);
  remove_empty(none, world);
  remove_empty(made, world);
  MPI_Barrier(world);
  EXPECT_TRUE(std::filesystem::exists(scratch.path / "x" / "file"));
  MPI_Barrier(world);
}

TEST(TriedDirectory, that_takes_no_files_is_an_error_with_its_reason) {
  std::vector<std::filesystem::path> made;
  EXPECT_THAT(complaint([&] { try_directory("/proc/self", world, made); }), HasSubstr("/proc/self"));
  EXPECT_THAT(complaint([&] { try_directory("/dev/null/below", world, made); }), HasSubstr("Not a directory"));
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
