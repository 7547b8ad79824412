#include "nacre/compare/peer_job.h"
#include "nacre/compare/peer_process.h"
namespace nacre {
std::optional<std::filesystem::path> find_mitsuba(const std::string&) { return std::nullopt; }
PeerResult run_mitsuba(const PeerRequest&) { throw_absent("Mitsuba 3", "pip install mitsuba"); }
}  // namespace nacre
