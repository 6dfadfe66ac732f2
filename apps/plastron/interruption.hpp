// Ctrl-C and SIGTERM: the first requests the computation to stop and to write the finished results, the second ends it
// immediately.
#pragma once

namespace plastron::app {

void listen_for_interruptions();
bool is_interrupted();

}  // namespace plastron::app
