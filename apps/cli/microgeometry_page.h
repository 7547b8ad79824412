#pragma once
// What `nacre models` says of generated microgeometry and of the instruments that measure, from their
// own descriptions.
#include <nlohmann/json.hpp>
#include <string>

#include "nacre/goniometer/instrument.h"
#include "nacre/goniometer/microgeometry.h"

namespace nacre::cli {

std::string microgeometry_page(const MicrogeometryDescription& geometry);
nlohmann::ordered_json microgeometry_json(const MicrogeometryDescription& geometry);
std::string instrument_page(const InstrumentDescription& instrument);
nlohmann::ordered_json instrument_json(const InstrumentDescription& instrument);

}  // namespace nacre::cli
