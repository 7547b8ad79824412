// Portable float map (Paul Debevec): "PF" or "Pf", width, height, a scale whose sign tells the byte
// order, then rows of floats from the bottom up. And Radiance RGBE (Greg Ward 1991, Real Pixels,
// Graphics Gems II), read here because a truncated file makes stb_image 2.27 loop for ever.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "nacre/image/formats.h"
#include "nacre/math/error.h"
#include "nacre/text/lines.h"
#include "nacre/text/number.h"

namespace nacre::image_formats {
namespace {

/// Reads a file from its beginning; running out of bytes is an error of its own.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}
    std::size_t left() const { return bytes_.size() - at_; }
    std::uint8_t byte() { return static_cast<std::uint8_t>(take(1)[0]); }
    std::string_view take(std::size_t n) {
        if (n > left()) throw InputError("is truncated: pixels are missing; copy it again");
        at_ += n;
        return bytes_.substr(at_ - n, n);
    }
    std::string_view line() {
        const std::size_t end = bytes_.find('\n', at_);
        if (end == bytes_.npos || end - at_ > 4096)
            throw InputError("has a header that does not end");
        std::string_view r = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        if (r.ends_with('\r')) r.remove_suffix(1);
        return r;
    }
    void skip(std::size_t n) { take(n); }
    /// A word of the header; the one white-space character that ends it is consumed.
    std::string word() {
        const auto space = [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; };
        while (left() && space(bytes_[at_])) ++at_;
        const std::size_t start = at_;
        while (left() && !space(bytes_[at_])) ++at_;
        if (!left() || at_ == start) throw InputError("has a header that does not end");
        return std::string(bytes_.substr(start, at_++ - start));
    }
    double number(const char* what) {
        const std::string text = word();
        const auto value = parse_number(text);
        if (!value || !std::isfinite(*value))
            throw InputError(fmt::format("has '{}' for its {}, which is not a number", text, what));
        return *value;
    }

  private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

/// One row of the run-length encoding of 1991: four planes of runs (> 128) and literal stretches.
void read_planes(Reader& in, std::vector<std::uint8_t>& row, int width) {
    for (int plane = 0; plane < 4; ++plane)
        for (int x = 0; x < width;) {
            int count = in.byte();
            const bool run = count > 128;
            if (run) count -= 128;
            if (count == 0 || count > width - x)
                throw InputError("is damaged: a run of pixels leaves its row; copy it again");
            std::uint8_t value = run ? in.byte() : 0;
            for (; count > 0; --count, ++x) row[x * 4 + plane] = run ? value : in.byte();
        }
}

/// One row of single pixels, in which (1, 1, 1, n) repeats the pixel before n times; several such
/// counts in a row are the bytes of one number.
void read_pixels(Reader& in, std::vector<std::uint8_t>& row, int width) {
    int shift = 0;
    for (int x = 0; x < width;) {
        const std::string_view p = in.take(4);
        if (p[0] == 1 && p[1] == 1 && p[2] == 1) {
            const std::uint64_t count = std::uint64_t(std::uint8_t(p[3])) << shift;
            if (x == 0 || shift > 24 || count > std::uint64_t(width - x))
                throw InputError("is damaged: a run of pixels leaves its row; copy it again");
            for (std::uint64_t i = 0; i < count; ++i, ++x)
                std::copy_n(&row[(x - 1) * 4], 4, &row[x * 4]);
            shift += 8;
        } else {
            std::copy_n(p.data(), 4, &row[x * 4]);
            ++x;
            shift = 0;
        }
    }
}

/// The positive numbers of a line NAME=NUMBER..., one for all three channels or one for each.
Vec3d factors(std::string_view line, int count) {
    std::string_view rest = line.substr(line.find('=') + 1);
    std::vector<double> numbers;
    for (auto word = take_word(rest); !word.empty(); word = take_word(rest))
        numbers.push_back(parse_number(word).value_or(-1.));
    const auto good = [](double x) { return x > 0. && std::isfinite(x); };
    if (numbers.size() != std::size_t(count) || !std::ranges::all_of(numbers, good))
        throw InputError(fmt::format("has the line '{}'; {} positive number{} belong{} there", line,
                                     count, count == 1 ? "" : "s", count == 1 ? "s" : ""));
    return {numbers.front(), numbers[numbers.size() / 2], numbers.back()};
}

}  // namespace

Image decode_pfm(std::string_view bytes) {
    Reader in(bytes);
    const std::string magic = in.word();
    if (magic != "PF" && magic != "Pf") throw InputError("is not a PFM file");
    const bool color = magic == "PF";
    const double width = in.number("width"), height = in.number("height"),
                 scale = in.number("scale");
    if (scale == 0) throw InputError("has a scale of 0; its sign must tell the byte order");
    if (width != std::floor(width) || height != std::floor(height))
        throw InputError("has a size that is not a whole number");
    // One white-space character ends the header; in files whose lines end in CR LF, two.
    if (bytes.substr(2, 2) == "\r\n") in.skip(1);
    // Four bytes a value, nothing compressed: a header that promises more than there is lies.
    check_size(width, height, color ? 3 : 1, static_cast<double>(in.left()),
               1.0 / (color ? 12 : 4));
    Image image(static_cast<int>(width), static_cast<int>(height),
                color ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"});
    const std::size_t row = std::size_t(image.width) * image.channels.size();
    const bool swap = (scale < 0) != (std::endian::native == std::endian::little);
    const float factor = static_cast<float>(std::abs(scale));
    for (int y = image.height - 1; y >= 0; --y) {
        float* to = &image.data[y * row];
        std::memcpy(to, in.take(row * 4).data(), row * 4);
        for (std::size_t i = 0; i < row; ++i) {
            if (swap)
                to[i] =
                    std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(to[i])));
            to[i] *= factor;
        }
    }
    return image;
}

std::string encode_pfm(const Image& image) {
    const bool grey = image.channels.size() == 1;
    std::string out = fmt::format("{}\n{} {}\n{}\n", grey ? "Pf" : "PF", image.width, image.height,
                                  std::endian::native == std::endian::little ? "-1.0" : "1.0");
    for (int y = image.height - 1; y >= 0; --y)
        for (int x = 0; x < image.width; ++x) {
            const Vec3f c = image.rgb(x, y);
            for (int i = 0; i < (grey ? 1 : 3); ++i) {
                char b[4];
                std::memcpy(b, &c[i], 4);
                out.append(b, 4);
            }
        }
    return out;
}

Image decode_hdr(std::string_view bytes) {
    Reader in(bytes);
    in.line();  // "#?RADIANCE", whose word differs between programs
    bool rgbe = false;
    // What the pixels were multiplied by, in turn; divided by it they are radiance again.
    Vec3d gain{1, 1, 1};
    for (std::string_view line = in.line(); !line.empty(); line = in.line()) {
        if (line == "FORMAT=32-bit_rle_rgbe") rgbe = true;
        if (line.starts_with("EXPOSURE=")) gain = gain * factors(line, 1);
        if (line.starts_with("COLORCORR=")) gain = gain * factors(line, 3);
    }
    if (!rgbe) throw InputError("is not of the format 32-bit_rle_rgbe; convert it to RGBE");
    const std::string size(in.line());
    int width = 0, height = 0;
    char end = 0;
    if (std::sscanf(size.c_str(), "-Y %d +X %d %c", &height, &width, &end) != 2)
        throw InputError(fmt::format(
            "has the size '{}'; nacre reads rows from the top left, '-Y height +X width'", size));
    // A run of 127 pixels takes two bytes in each of four planes.
    check_size(width, height, 3, static_cast<double>(in.left()), 127);
    Image image(width, height);
    std::vector<std::uint8_t> row(std::size_t(width) * 4);
    for (int y = 0; y < height; ++y) {
        const Reader before = in;
        const std::string_view start = in.take(4);
        const bool planes =
            width >= 8 && width < 32768 && start[0] == 2 && start[1] == 2 && !(start[2] & 0x80);
        if (planes) {
            if ((std::uint8_t(start[2]) << 8 | std::uint8_t(start[3])) != width)
                throw InputError("is damaged: a row has another width than the image");
            read_planes(in, row, width);
        } else {
            in = before;
            read_pixels(in, row, width);
        }
        for (int x = 0; x < width; ++x) {
            const std::uint8_t* p = &row[std::size_t(x) * 4];
            // A mantissa of 8 bits and an exponent with an offset of 128.
            const float scale = p[3] ? std::ldexp(1.f, p[3] - (128 + 8)) : 0.f;
            for (int c = 0; c < 3; ++c)
                image.at(x, y, c) = static_cast<float>(p[c] * scale / gain[c]);
        }
    }
    return image;
}

}  // namespace nacre::image_formats
