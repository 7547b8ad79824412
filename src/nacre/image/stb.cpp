// PNG and JPEG through stb_image, PNG and HDR through stb_image_write (Sean Barrett): the one
// translation unit that holds their code, with internal linkage so that another library's copy
// cannot meet it.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include "nacre/image/formats.h"
#include "nacre/math/error.h"
#include "nacre/math/random.h"
#include "nacre/spectrum/color.h"

namespace nacre::image_formats {
namespace {

void append(void* out, void* data, int size) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(data), size);
}

/// Pixels as whole numbers of `Sample` to linear values.
template <class Sample>
void store(Image& image, const Sample* pixels, bool raw) {
    constexpr int levels = std::numeric_limits<Sample>::max() + 1;
    std::vector<float> table(levels);
    for (int i = 0; i < levels; ++i) {
        const float v = static_cast<float>(i) / (levels - 1);
        table[i] = raw ? v : srgb_decode(v);
    }
    const int alpha = image.channel("A");
    const std::size_t n = image.channels.size();
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = static_cast<int>(i % n) == alpha
                            ? static_cast<float>(pixels[i]) / (levels - 1)
                            : table[pixels[i]];
}

}  // namespace

Image decode_ldr(std::string_view bytes, bool raw) {
    // stb_image takes what is missing at the end of a file for zeros.
    const bool jpeg = bytes.starts_with("\xff\xd8");
    // (PNG: the last block is IEND and a checksum.)
    const std::size_t end = jpeg ? bytes.rfind("\xff\xd9") : bytes.rfind("IEND");
    if (end == bytes.npos || end + (jpeg ? 2 : 8) > bytes.size())
        throw InputError("is truncated: it has no end marker; copy it again");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(std::min<std::size_t>(bytes.size(), INT_MAX));
    int width = 0, height = 0, n = 0;
    const auto damaged = [] {
        return InputError(fmt::format("is damaged ({}); copy it again", stbi_failure_reason()));
    };
    if (!stbi_info_from_memory(data, size, &width, &height, &n)) throw damaged();
    // Deflate packs at most 1032 to 1 and a bit is the smallest pixel.
    check_size(width, height, n, static_cast<double>(bytes.size()), 8 * 1032);
    const bool deep = stbi_is_16_bit_from_memory(data, size);
    const std::unique_ptr<void, void (*)(void*)> pixels(
        deep ? static_cast<void*>(stbi_load_16_from_memory(data, size, &width, &height, &n, 0))
             : static_cast<void*>(stbi_load_from_memory(data, size, &width, &height, &n, 0)),
        stbi_image_free);
    if (!pixels) throw damaged();
    std::vector<std::string> names;
    if (n < 3)
        names = {"Y"};
    else
        names = {"R", "G", "B"};
    if (n % 2 == 0) names.emplace_back("A");
    Image image(width, height, names);
    if (deep)
        store(image, static_cast<const stbi_us*>(pixels.get()), raw);
    else
        store(image, static_cast<const stbi_uc*>(pixels.get()), raw);
    return image;
}

std::string encode_hdr(const Image& image) {
    std::vector<float> rgb;
    rgb.reserve(std::size_t(image.width) * image.height * 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Vec3f c = image.rgb(x, y);
            // The format knows no sign and no infinity.
            for (int i = 0; i < 3; ++i) rgb.push_back(c[i] > 0 ? std::min(c[i], 1e38f) : 0.f);
        }
    std::string out;
    if (!stbi_write_hdr_to_func(append, &out, image.width, image.height, 3, rgb.data()))
        throw RunError("the image cannot be encoded as HDR");
    return out;
}

std::string encode_png(const Image& image, float exposure) {
    const int alpha = image.channel("A");
    const int n = alpha >= 0 ? 4 : 3;
    const float gain = std::exp2(exposure);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(std::size_t(image.width) * image.height * n);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Vec3f c = image.rgb(x, y);
            const std::uint64_t noise = mix_bits(std::uint64_t(y) * image.width + x + 1);
            for (int i = 0; i < 3; ++i) {
                const float v = srgb_encode(std::clamp(c[i] * gain, 0.f, 1.f)) * 255.f;
                const float u = static_cast<float>((noise >> (16 * i)) & 0xffff) / 65536.f;
                // NaN becomes black; noise of half a step, so that v within a quarter of a code
                // stays that code.
                bytes.push_back(v >= 0.f ? static_cast<std::uint8_t>(
                                               std::min(255.f, std::floor(v + 0.25f + 0.5f * u)))
                                         : 0);
            }
            if (alpha >= 0)
                bytes.push_back(static_cast<std::uint8_t>(
                    std::lround(std::clamp(image.at(x, y, alpha), 0.f, 1.f) * 255.f)));
        }
    std::string out;
    if (!stbi_write_png_to_func(append, &out, image.width, image.height, n, bytes.data(),
                                image.width * n))
        throw RunError("the image cannot be encoded as PNG");
    return out;
}

}  // namespace nacre::image_formats
