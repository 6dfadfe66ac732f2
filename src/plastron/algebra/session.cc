#include <plastron/algebra/session.hpp>
#include <plastron/algebra/threads.hpp>

#include <slepcsys.h>

#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "petsc_use.hpp"

namespace plastron::algebra {
namespace {

/// While it exists, a process without a launcher starts under Open MPI without a daemon and without a search for the
/// machine's networks. These cost 0.3 s, most of a small run. It also starts without a session folder: all such processes of a
/// user share the folder of job 0, and one that ends removes it while another one enters it. Other implementations of
/// MPI ignore these names. Settings of the user are kept.
class StartAlone {
 public:
  StartAlone() {
    if (rank_of_launcher()) return;
    for (const auto& [name, value] : settings)
      if (setenv_if_absent(name, value)) mine_.emplace_back(name);
  }
  ~StartAlone() {
    for (const std::string& name : mine_) unsetenv(name.c_str());  // programs that this one starts may be parallel
  }
  StartAlone(const StartAlone&) = delete;
  StartAlone& operator=(const StartAlone&) = delete;

 private:
  struct Setting {
    const char *name, *value;
  };
  static constexpr std::array settings{Setting{"OMPI_MCA_ess_singleton_isolated", "1"}, Setting{"OMPI_MCA_pml", "ob1"},
                                       Setting{"OMPI_MCA_btl", "self"},
                                       Setting{"OMPI_MCA_orte_create_session_dirs", "0"}};

  static bool setenv_if_absent(const char* name, const char* value) {
    return !std::getenv(name) && setenv(name, value, 0) == 0;
  }

  std::vector<std::string> mine_{};
};

bool start_mpi(int& argc, char**& argv) {
  int runs = 0;
  MPI_Initialized(&runs);
  if (runs) return false;
  const StartAlone alone;
  MPI_Init(&argc, &argv);
  return true;
}

bool mpi_has_ended() {
  int ended = 0;
  MPI_Finalized(&ended);
  return ended != 0;
}

int number_of_ranks() {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

}  // namespace

Session::Session(int& argc, char**& argv, int threads) : owns_mpi_(start_mpi(argc, argv)), owns_slepc_(false) {
  restrict_threads(threads, number_of_ranks());
  owns_slepc_ = start_slepc(MPI_COMM_SELF);  // a single rank may compute while others do not
}

Session::~Session() {
  if (mpi_has_ended()) return;
  PetscErrorPrintf = PetscErrorPrintfNone;  // it would report a standard output that was closed
  if (owns_slepc_) SlepcFinalize();
  if (owns_mpi_) MPI_Finalize();
}

}  // namespace plastron::algebra
