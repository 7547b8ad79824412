#pragma once
// Parameters of a scene file: numbers, vectors, colours, transforms. Used by the scene reader only.
#include <functional>

#include "nacre/scene/xml/source.h"

namespace nacre {

/// Whether `tag` is that of a parameter that `read_value` reads.
bool is_value_tag(const std::string& tag);
/// All tags of parameters, for suggestions.
const std::vector<std::string>& value_tags();

/// What reading a parameter needs from the reader around it.
struct ValueContext {
    const XmlSource& source;
    XmlParameters& parameters;
    const std::vector<std::filesystem::path>& search_path;  ///< for spectra in files
};

/// The parameter that `element` states. Throws InputError with its place if it is malformed.
SceneValue read_value(const XmlElement& element, const ValueContext& context);

/// Wavelengths in nm and values of a text file: a pair a line, separated by blanks or a comma; '#'
/// begins a comment. Throws InputError with the line.
ColorValue read_spectrum_file(const std::filesystem::path& file);

}  // namespace nacre
