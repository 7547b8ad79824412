#pragma once
// What a file is that no reader of measured reflectance knows: for the sentence that refuses it.
#include <string>

#include "nacre/measured/formats.h"

namespace nacre {

/// "it is a web page, saved instead of the data; fetch the file itself": what the first bytes say,
/// and how to mend it.
std::string what_it_seems_to_be(const FileStart& start);

}  // namespace nacre
