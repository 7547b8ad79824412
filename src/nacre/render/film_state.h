#pragma once
// A film as it can be kept and sent: what was rendered goes on elsewhere or later, and no bit of it
// is lost.
#include <filesystem>
#include <map>
#include <string>

#include "nacre/render/film.h"

namespace nacre {

/// An OpenEXR file. Viewers show its R, G, B (means) and `nacre diff` reads variance.R, ... (of one
/// sample); what `film` is made of stands beside them in whole numbers of 32 bits: sum.R.low and
/// sum.R.high, the halves of a double, square.R..., count, invalid, and the same under "negative."
/// for filters with negative lobes. Attributes: nacre.film, its settings; nacre.invalid_samples;
/// and `notes`, under "nacre." and their names.
class FilmState {
  public:
    /// Throws RunError if the file cannot be written; it appears whole or not at all.
    static void save(const Film& film, const std::map<std::string, std::string>& notes,
                     const std::filesystem::path& file);
    /// Throws InputError, with what is wrong with it, unless `file` was written by `save` and is
    /// undamaged.
    static FilmState load(const std::filesystem::path& file);

    // The same as bytes.
    static std::string encode(const Film& film, const std::map<std::string, std::string>& notes);
    static FilmState decode(const std::string& bytes);

    Film film;
    std::map<std::string, std::string> notes;  ///< without "nacre."
};

}  // namespace nacre
