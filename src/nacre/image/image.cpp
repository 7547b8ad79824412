#include "nacre/image/image.h"

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "nacre/image/formats.h"
#include "nacre/math/error.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

enum class Format { unknown, exr, pfm, hdr, png, jpeg };

const char* name(Format f) {
    switch (f) {
        case Format::exr:
            return "EXR";
        case Format::pfm:
            return "PFM";
        case Format::hdr:
            return "HDR";
        case Format::png:
            return "PNG";
        case Format::jpeg:
            return "JPEG";
        case Format::unknown:
            break;
    }
    return "unknown";
}

Format format_of_name(const std::filesystem::path& file) {
    std::string ext = file.extension().string();
    for (char& c : ext) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (ext == ".exr") return Format::exr;
    if (ext == ".pfm") return Format::pfm;
    if (ext == ".hdr" || ext == ".rgbe" || ext == ".pic") return Format::hdr;
    if (ext == ".png") return Format::png;
    if (ext == ".jpg" || ext == ".jpeg") return Format::jpeg;
    return Format::unknown;
}

/// What the first bytes say.
Format format_of_content(std::string_view bytes) {
    if (bytes.starts_with("\x76\x2f\x31\x01")) return Format::exr;
    if (bytes.starts_with("PF") || bytes.starts_with("Pf")) return Format::pfm;
    if (bytes.starts_with("#?")) return Format::hdr;
    if (bytes.starts_with("\x89PNG")) return Format::png;
    if (bytes.starts_with("\xff\xd8")) return Format::jpeg;
    return Format::unknown;
}

std::string read_file(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        throw InputError(fmt::format("{}: no such file", file.string()));
    if (std::filesystem::is_directory(file, error))
        throw InputError(fmt::format("{}: is a folder, not an image", file.string()));
    auto bytes = read_whole_file(file);
    if (!bytes || bytes->empty())
        throw InputError(fmt::format("{}: {}", file.string(),
                                     bytes ? "the file is empty" : "the file cannot be read"));
    return *std::move(bytes);
}

[[noreturn]] void fail_unknown(const std::filesystem::path& file, const char* known) {
    throw InputError(fmt::format("{}: '{}' is not an image format that nacre {}", file.string(),
                                 file.extension().string(), known));
}
constexpr const char* readable = "reads; known are .exr, .pfm, .hdr, .png, .jpg";
constexpr const char* writable = "writes; known are .exr, .pfm, .hdr, .png";

Format output_format(const std::filesystem::path& file) {
    const Format format = format_of_name(file);
    if (format == Format::unknown || format == Format::jpeg) fail_unknown(file, writable);
    return format;
}

}  // namespace

namespace image_formats {

void check_size(double width, double height, double channels, double file_bytes, double max_ratio) {
    if (!(width >= 1) || !(height >= 1))
        throw InputError(
            fmt::format("its size is {:.0f} x {:.0f}; both sides must be positive", width, height));
    if (width * height * channels > max_values)
        throw InputError(
            fmt::format("its size of {:.0f} x {:.0f} with {:.0f} channels is more than "
                        "nacre reads (2^30 values)",
                        width, height, channels));
    if (width * height > file_bytes * max_ratio)
        throw InputError(
            fmt::format("its header promises {:.0f} x {:.0f} pixels, but the file is "
                        "too short for that",
                        width, height));
}

}  // namespace image_formats

Image::Image(int w, int h, std::vector<std::string> names)
    : width(w), height(h), channels(std::move(names)) {
    if (w < 1 || h < 1 || channels.empty())
        throw InputError(fmt::format("an image of {} x {} pixels with {} channels cannot be made",
                                     w, h, channels.size()));
    data.assign(std::size_t(w) * h * channels.size(), 0.f);
}

int Image::channel(const std::string& wanted) const {
    const auto it = std::find(channels.begin(), channels.end(), wanted);
    return it == channels.end() ? -1 : static_cast<int>(it - channels.begin());
}

Vec3f Image::rgb(int x, int y) const {
    if (channels.size() >= 3 && channels[0] == "R" && channels[1] == "G" && channels[2] == "B")
        return {at(x, y, 0), at(x, y, 1), at(x, y, 2)};
    const int r = channel("R"), g = channel("G"), b = channel("B");
    if (r >= 0 && g >= 0 && b >= 0) return {at(x, y, r), at(x, y, g), at(x, y, b)};
    const float grey = at(x, y, std::max(0, channel("Y")));
    return {grey, grey, grey};
}

std::filesystem::path without_layer(const std::filesystem::path& file) {
    const std::string text = file.string();
    const std::size_t hash = text.rfind('#');
    std::error_code error;
    if (hash == text.npos || std::filesystem::exists(file, error)) return file;
    return text.substr(0, hash);
}

Image read_image(const std::filesystem::path& whole, const ImageReadOptions& options) {
    const std::filesystem::path file = without_layer(whole);
    const std::string layer = whole == file ? "" : whole.string().substr(file.string().size() + 1);
    const Format format = format_of_name(file);
    if (format == Format::unknown) fail_unknown(file, readable);
    const std::string bytes = read_file(file);
    const Format content = format_of_content(bytes);
    if (content == Format::unknown)
        throw InputError(
            fmt::format("{}: is not an image of the format {}: it does not begin like one",
                        file.string(), name(format)));
    if (content != format)
        throw InputError(fmt::format("{}: holds {} data behind the extension of {}; rename it",
                                     file.string(), name(content), name(format)));
    try {
        if (whole != file && (format != Format::exr || layer.empty()))
            throw InputError(layer.empty()
                                 ? "no layer is named behind '#'"
                                 : fmt::format("only EXR has layers, such as '{}'", layer));
        switch (format) {
            case Format::exr:
                return image_formats::decode_exr(bytes, layer, options.any_channels);
            case Format::pfm:
                return image_formats::decode_pfm(bytes);
            case Format::hdr:
                return image_formats::decode_hdr(bytes);
            default:
                return image_formats::decode_ldr(bytes, options.raw);
        }
    } catch (const InputError& e) {
        throw InputError(fmt::format("{}: {}", file.string(), e.what()));
    }
}

Image parse_image(std::string_view bytes, const std::string& name,
                  const ImageReadOptions& options) {
    const Format content = format_of_content(bytes);
    if (content != Format::png && content != Format::jpeg)
        throw InputError(fmt::format("{}: is neither PNG nor JPEG", name));
    try {
        return image_formats::decode_ldr(bytes, options.raw);
    } catch (const InputError& e) {
        throw InputError(fmt::format("{}: {}", name, e.what()));
    }
}

void write_image(const Image& image, const std::filesystem::path& file, float exposure) {
    if (image.width < 1 || image.height < 1 || image.channels.empty() ||
        image.data.size() != std::size_t(image.width) * image.height * image.channels.size())
        throw InputError(
            fmt::format("{}: an image without pixels cannot be written", file.string()));
    const Format format = output_format(file);
    switch (format) {
        case Format::exr:
            return write_whole_file(file, image_formats::encode_exr(image));
        case Format::pfm:
            return write_whole_file(file, image_formats::encode_pfm(image));
        case Format::hdr:
            return write_whole_file(file, image_formats::encode_hdr(image));
        default:
            return write_whole_file(file, image_formats::encode_png(image, exposure));
    }
}

void check_image_output(const std::filesystem::path& file) {
    output_format(file);
    check_output_file(file);
}

bool has_image_extension(const std::filesystem::path& file) {
    return format_of_name(without_layer(file)) != Format::unknown;
}

}  // namespace nacre
