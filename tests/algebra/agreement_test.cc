// An error is planted on one rank. All ranks must throw, or the test hangs until its time is up.
#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/factorisation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "algebra/chain.hpp"

namespace plastron::test {
namespace {

using algebra::in_agreement;

struct OwnError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};
struct OtherError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

bool is_last() { return rank() == ranks() - 1; }
const char* const harmless = "this rank found nothing";

TEST(Agreement, GivesTheValueWhereNobodyThrows) {
  EXPECT_EQ((in_agreement<OwnError>(MPI_COMM_WORLD, [] { return 3 * rank(); })), 3 * rank());
  int done = 0;
  in_agreement(MPI_COMM_WORLD, [&] { ++done; });
  EXPECT_EQ(done, 1);
}

TEST(Agreement, AnErrorOfOneRankIsThrownOnAllWithItsTypeAndWords) {
  const auto plant = [] { return is_last() ? throw OwnError("in cell 7") : 1; };
  EXPECT_THROW((in_agreement<OtherError, OwnError>(MPI_COMM_WORLD, plant)), OwnError);
  try {
    in_agreement<OtherError, OwnError>(MPI_COMM_WORLD, plant);
    ADD_FAILURE() << harmless;
  } catch (const OwnError& error) {
    EXPECT_STREQ(error.what(), "in cell 7");
  }
}

TEST(Agreement, ErrorsOfTheStandardLibraryKeepTheirKind) {
  const auto plant = [](auto error) {
    return [error] {
      if (is_last()) throw error;
    };
  };
  EXPECT_THROW(in_agreement(MPI_COMM_WORLD, plant(std::bad_alloc())), std::bad_alloc);
  EXPECT_THROW(in_agreement(MPI_COMM_WORLD, plant(std::out_of_range("9"))), std::out_of_range);
  EXPECT_THROW(in_agreement(MPI_COMM_WORLD, plant(std::logic_error("9"))), std::logic_error);
  EXPECT_THROW(in_agreement(MPI_COMM_WORLD, plant(OwnError("not named above"))), std::invalid_argument);
  EXPECT_THROW(in_agreement(MPI_COMM_WORLD, plant(std::underflow_error("9"))), std::runtime_error);
  if (ranks() > 1 && !is_last()) {
    EXPECT_THROW(in_agreement(MPI_COMM_WORLD, plant(7)), std::runtime_error);
  } else {
    EXPECT_THROW(in_agreement(MPI_COMM_WORLD, plant(7)), int);
  }
}

TEST(Agreement, AmongSeveralErrorsTheLowestRankIsHeardByAll) {
  try {
    in_agreement(MPI_COMM_WORLD, [] {
      if (rank() > 0 || ranks() == 1) throw std::runtime_error("rank " + std::to_string(rank()));
    });
    ADD_FAILURE() << harmless;
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), ranks() == 1 ? "rank 0" : "rank 1");
  }
}

TEST(Agreement, OnPartOfTheRanksConcernsNobodyElse) {
  MPI_Comm half = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, is_last() ? 1 : 0, 0, &half);
  const auto plant = [] {
    if (is_last()) throw OwnError("alone");
  };
  if (is_last()) {
    EXPECT_THROW(in_agreement<OwnError>(half, plant), OwnError);
  } else {
    EXPECT_NO_THROW(in_agreement<OwnError>(half, plant));
  }
  MPI_Comm_free(&half);
}

TEST(Matrix, OfElementsThatAreWrongOnOneRankIsRefusedOnAll) {
  const auto elements = chain(12);
  const auto layout = layout_for(12, elements);
  Connectivity own = connectivity(*layout, elements);
  if (is_last()) own.nodes.front() = layout->local_size();
  EXPECT_THROW(Matrix(layout, 1, own), std::out_of_range);
}

TEST(Matrix, OfAPatternThatDiffersOnOneRankIsNotAddedOnAny) {
  const auto elements = chain(12);
  const auto layout = layout_for(12, elements);
  const Connectivity own = connectivity(*layout, elements);
  Connectivity fewer = own;
  if (is_last()) fewer.nodes.resize(fewer.nodes.size() - 2);
  const Matrix A(layout, 1, own), B(layout, 1, fewer);
  EXPECT_THROW(static_cast<void>(A.plus_multiple(1, B)), std::invalid_argument);
}

TEST(Factorisation, WithMarksThatAreTooFewOnOneRankThrowsOnAll) {
  const auto elements = chain(12);
  const auto layout = layout_for(12, elements);
  Matrix A(layout, 1, connectivity(*layout, elements));
  A.finish();
  algebra::Factorisation F(A);
  const std::vector<char> marks(static_cast<std::size_t>(layout->owned) - (is_last() ? 1 : 0), 1);
  EXPECT_THROW(F.factorise(marks), std::invalid_argument);
}

}  // namespace
}  // namespace plastron::test
