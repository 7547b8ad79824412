#pragma once
// Measured reflectance seen otherwise, and models seen as if measured: all that writers of files
// (formats.h) and the audit need is a `Measured`. A view keeps what it looks at, and has no
// samples unless it says so.
#include <memory>

#include "nacre/measured/measured.h"
#include "nacre/measured/target.h"

namespace nacre {

/// A target in linear red, green and blue. `info().format` is empty.
std::shared_ptr<const Measured> view_of(std::shared_ptr<const Target> target);

/// A model at wavelengths (nm, ascending). Throws InputError if there is none, more than
/// max_measured_channels, or if they do not ascend.
std::shared_ptr<const Measured> view_of(const AnyModel& model, std::string name,
                                        std::vector<double> wavelengths);

/// The colours of what has wavelengths or is grey (ChannelColours), with its samples; what has colours
/// is itself.
std::shared_ptr<const Measured> in_colour(std::shared_ptr<const Measured> data);

/// The mean over 32 turns about the normal, and over the two sides of the plane of incidence, of
/// those that are known; nothing where less than half of them are. What is isotropic is itself.
std::shared_ptr<const Measured> turned_around(std::shared_ptr<const Measured> data);

}  // namespace nacre
