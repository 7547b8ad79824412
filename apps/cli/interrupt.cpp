#include "apps/cli/interrupt.h"

#include <csignal>

namespace nacre::cli {
namespace {

std::atomic<bool> arrived{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only do that");

void handle(int) { arrived.store(true); }

}  // namespace

const std::atomic<bool>& interrupt_flag() {
    static const bool installed = [] {
        struct sigaction action {};
        action.sa_handler = handle;
        action.sa_flags = SA_RESETHAND | SA_RESTART;  // the second one has its usual effect
        sigaction(SIGINT, &action, nullptr);
        sigaction(SIGTERM, &action, nullptr);
        // The terminal is gone; unless the user has said that this does not matter (nohup).
        struct sigaction before {};
        if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(SIGHUP, &action, nullptr);
        return true;
    }();
    (void)installed;
    return arrived;
}

}  // namespace nacre::cli
