// Ctrl-C and SIGTERM: the first asks the computation to stop and to write what is finished, the second ends at once.
#pragma once

namespace plastron::app {

void listen_for_interruptions();
bool is_interrupted();

}  // namespace plastron::app
