#pragma once
// What generated microgeometry is made of, as `nacre measure --material` says it.
#include <map>
#include <string>

#include "nacre/goniometer/patch.h"

namespace nacre::cli {

/// A reflectance model with settings, mirror, a material of scenes with those of its parameters
/// that are numbers, colours or words ("roughdielectric alpha=0.2"), or a file of measured
/// reflectance. Adds what the material consists of to `facts`. Throws InputError for what is none
/// of them, and if it depends on the wavelength while three bands are measured.
SurfaceBsdf generated_material(const std::string& text, const Wavelengths& wavelengths,
                               std::map<std::string, std::string>& facts);

/// A fact for each file that stands behind a '=' in `text`, or is all of it: what is in it.
void add_file_facts(const std::string& text, std::map<std::string, std::string>& facts);

}  // namespace nacre::cli
