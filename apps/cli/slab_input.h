#pragma once
// Layers and skin as they are written on the command line: words name=value.
#include <string>

#include "nacre/layers/skin.h"

namespace nacre::cli {

/// "sigma_s=10 sigma_a=0.1 g=0.8 thickness=1 eta=1.4", or with albedo and tau instead of sigma_s
/// and sigma_a (a thickness of 1 mm if none is given; tau=inf is a half space). `number`, from 1,
/// is for messages. Throws InputError for words, names and albedos that mean nothing and for a
/// missing thickness; ranges are left to `check(LayerStack)`.
Layer parse_layer(const std::string& text, std::size_t number);

/// "melanin=0.03 blood=0.012 oxygenation=0.75 haemoglobin=150 optics=donner_jensen eumelanin=0.6":
/// the parameters of <medium type="skin">. `blood` is that of the papillary dermis, with which that
/// below goes in proportion. Throws InputError for unknown names and `check(SkinParameters)`.
SkinParameters parse_skin(const std::string& text);

}  // namespace nacre::cli
