#pragma once
// The formats of image.h, from and to bytes in memory. Decoders throw InputError with what is wrong
// and leave the file's name to the caller; they accept any bytes.
#include <string>
#include <string_view>

#include "nacre/image/image.h"

namespace nacre::image_formats {

/// `layer` and `any_channels`: as in image.h.
Image decode_exr(const std::string& bytes, const std::string& layer = {},
                 bool any_channels = false);
std::string encode_exr(const Image& image);

Image decode_pfm(std::string_view bytes);
std::string encode_pfm(const Image& image);

Image decode_hdr(std::string_view bytes);
std::string encode_hdr(const Image& image);

/// PNG and JPEG.
Image decode_ldr(std::string_view bytes, bool raw);
std::string encode_png(const Image& image, float exposure);

/// A picture larger than this is refused before memory is asked for: 2^30 values, 4 GiB.
inline constexpr double max_values = 1073741824.0;
/// Throws unless the size is one that an image may have and that a file of `file_bytes` could hold
/// at `max_ratio` pixels a byte.
void check_size(double width, double height, double channels, double file_bytes, double max_ratio);

}  // namespace nacre::image_formats
