#pragma once
// What an audit found, in words.
#include "nacre/measured/audit.h"

namespace nacre {

/// "theta_i 30, theta_o 40, phi 180 degrees": phi is the azimuth of the exit against that of the
/// light.
std::string place_in_words(const AuditedPair& pair);

/// Fills `trusted` and `doubtful` from the rest.
void judge(const MeasuredInfo& info, Audit& audit);

}  // namespace nacre
