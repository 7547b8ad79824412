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
    /// In the order in which they are stored. Read from a file: R, G, B, A first, then the others
    /// by name; a grey channel is called Y.
    std::vector<std::string> channels;
    std::vector<float> data;
    std::map<std::string, std::string> metadata;  ///< EXR attributes of type string
    std::vector<std::string>
        layers;               ///< of an EXR file: what may stand behind its name, file.exr#layer
    std::string data_window;  ///< of an EXR file, "x, y to x, y" if it is not the whole picture

    Image() = default;
    /// All zero. Throws InputError if a side is not positive or there is no channel.
    Image(int width, int height, std::vector<std::string> channels = {"R", "G", "B"});

    int channel_count() const { return static_cast<int>(channels.size()); }
    /// Index of a channel; -1 if there is none of that name.
    int channel(const std::string& name) const;
    float& at(int x, int y, int c) {
        return data[(std::size_t(y) * width + x) * channels.size() + c];
    }
    float at(int x, int y, int c) const {
        return data[(std::size_t(y) * width + x) * channels.size() + c];
    }
    /// Channels R, G, B, or else the channel Y, or else the first channel, three times.
    Vec3f rgb(int x, int y) const;
};

struct ImageReadOptions {
    bool raw = false;  ///< PNG, JPEG: do not undo the sRGB curve
    /// EXR: take the channels of the first part as they are, be they a picture or not.
    bool any_channels = false;
};

/// Reads EXR (half, float and integer channels; scan lines or tiles), PFM, HDR (Radiance RGBE), PNG
/// (8 and 16 bit) and JPEG by extension. Throws InputError "FILE: what is wrong; how to mend".
///
/// EXR: a picture is R, G, B (or r, g, b), else a single luminance Y; plain ones or those of a
/// layer (beauty.R) or part. Where there are several and none is plain, `file` must name one:
/// "file.exr#layer", "file.exr#part" or "file.exr#part.layer". Its channels become R, G, B, A;
/// depth, alpha and the like do not stand in for a picture. The picture is the display window; what
/// is not stored is black.
Image read_image(const std::filesystem::path& file, const ImageReadOptions& options = {});

/// A PNG or JPEG in memory; `name` is what it is called in messages.
Image parse_image(std::string_view bytes, const std::string& name,
                  const ImageReadOptions& options = {});

/// Writes EXR (float32, ZIP, all channels and metadata), PFM (RGB), PNG (8 bit sRGB of `exposure`
/// stops, clamped, alpha kept if there is one) or HDR by extension; the exposure of the other
/// formats is 0. In PNG, noise of half a step that depends on nothing but the pixel's place breaks
/// up the bands of smooth gradients; values that are exact codes stay what they are. The file
/// appears whole or not at all: written beside, then renamed. Throws InputError for an unknown
/// extension, RunError if it cannot be written.
void write_image(const Image& image, const std::filesystem::path& file, float exposure = 0.f);

/// Throws the InputError that `write_image` would end in (unknown extension, missing or unwritable
/// folder), so that a long render does not find out at its end.
void check_image_output(const std::filesystem::path& file);

/// A file's name without the "#layer" behind it, if there is one and no file has the whole name.
std::filesystem::path without_layer(const std::filesystem::path& file);

/// Whether the extension is one that `read_image` knows.
bool has_image_extension(const std::filesystem::path& file);

}  // namespace nacre
