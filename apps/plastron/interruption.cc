#include "interruption.hpp"

#include <signal.h>

#include <initializer_list>

namespace plastron::app {

namespace {

volatile sig_atomic_t interrupted = 0;

extern "C" void note_interruption(int) { interrupted = 1; }

}  // namespace

void listen_for_interruptions() {
  struct sigaction action {};
  action.sa_handler = note_interruption;
  // The first signal restores the default: the second ends the program.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
}

bool is_interrupted() { return interrupted != 0; }

}  // namespace plastron::app
