#pragma once
// Images in memory and in files.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "nacre/math/vec.h"

namespace nacre {

/// Pixels row by row from the top left, channels interleaved, linear values.
struct Image {
    int width = 0, height = 0;
    std::vector<std::string> channels;  ///< R, G, B, ... in the order in which they are stored
    std::vector<float> data;
    std::map<std::string, std::string> metadata;  ///< EXR attributes

    int channel_count() const { return static_cast<int>(channels.size()); }
    float& at(int x, int y, int c) {
        return data[(std::size_t(y) * width + x) * channels.size() + c];
    }
    float at(int x, int y, int c) const {
        return data[(std::size_t(y) * width + x) * channels.size() + c];
    }
    Vec3f rgb(int x, int y) const;  ///< channels R, G, B, or the one grey channel three times
};

struct ImageReadOptions {
    bool raw = false;  ///< PNG, JPEG: do not undo the sRGB curve
};

/// Reads EXR, PFM, HDR, PNG, JPEG by extension. Throws InputError "FILE: what is wrong; how to
/// mend".
Image read_image(const std::filesystem::path& file, const ImageReadOptions& options = {});
/// Writes EXR (float32, ZIP, all channels and metadata), PFM (RGB), PNG (8 bit sRGB of `exposure`
/// stops, clamped), HDR by extension. The file appears whole or not at all: written beside, then
/// renamed.
void write_image(const Image& image, const std::filesystem::path& file, float exposure = 0.f);

}  // namespace nacre
