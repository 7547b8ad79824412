#pragma once
// Ctrl-C: the first one asks the render to stop, the second one ends the program.
#include <atomic>

namespace nacre::cli {

/// Installs the handler for SIGINT, SIGTERM and SIGHUP on the first call; the flag becomes true
/// when one arrives. A SIGHUP that is ignored, as under nohup, stays so.
const std::atomic<bool>& interrupt_flag();

}  // namespace nacre::cli
