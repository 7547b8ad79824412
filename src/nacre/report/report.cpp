#include "nacre/report/report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "nacre/math/error.h"
#include "nacre/report/page.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

std::string base64(const std::vector<unsigned char>& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
        unsigned v = 0;
        for (std::size_t k = 0; k < 3; ++k) v = v << 8 | (k < n ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[v >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string deflated(const std::vector<unsigned char>& bytes) {
    uLongf size = compressBound(uLong(bytes.size()));
    std::vector<unsigned char> out(size);
    if (compress2(out.data(), &size, bytes.data(), uLong(bytes.size()), Z_BEST_COMPRESSION) != Z_OK)
        throw RunError("a picture could not be compressed: out of memory");
    out.resize(size);
    return base64(out);
}

ordered_json encoded(int width, int height, const char* encoding,
                     const std::vector<unsigned char>& bytes) {
    return {
        {"width", width}, {"height", height}, {"encoding", encoding}, {"data", deflated(bytes)}};
}

void replace(std::string& text, std::string_view mark, std::string_view by) {
    const std::size_t at = text.find(mark);
    if (at != text.npos) text.replace(at, mark.size(), by);
}

std::string dump(const ordered_json& json, int indent = -1) {
    return json.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

/// JSON that may stand inside a <script>: `<` could end it.
std::string for_script(const ordered_json& json) {
    std::string text;
    for (const char c : dump(json)) text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return text;
}

std::string escaped(const std::string& text) {
    std::string r;
    for (const char c : text)
        r += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
    return r;
}

}  // namespace

ordered_json rgbe_picture(const Image& image) {
    const std::size_t n = std::size_t(image.width) * image.height;
    std::vector<unsigned char> planes(4 * n);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            Vec3f v = image.rgb(x, y);
            for (int c = 0; c < 3; ++c)
                v[c] = v[c] > 0.f ? std::min(v[c], 1e37f) : 0.f;  // NaN fails the comparison
            const float most = std::max({v.x, v.y, v.z});
            if (!(most > 1e-37f)) continue;
            int exponent = 0;
            std::frexp(most, &exponent);  // most < 2^exponent
            // The largest may round up to 256: then the next exponent.
            if (std::lround(std::ldexp(most, 8 - exponent)) > 255) ++exponent;
            const std::size_t i = std::size_t(y) * image.width + x;
            for (int c = 0; c < 3; ++c)
                planes[c * n + i] =
                    static_cast<unsigned char>(std::lround(std::ldexp(v[c], 8 - exponent)));
            planes[3 * n + i] = static_cast<unsigned char>(exponent + 128);
        }
    return encoded(image.width, image.height, "rgbe", planes);
}

ordered_json byte_map(const Image& image) {
    std::vector<unsigned char> bytes;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float v = image.at(x, y, 0);
            bytes.push_back(static_cast<unsigned char>(
                std::lround(255.f * (v > 0.f ? std::min(v, 1.f) : 0.f))));
        }
    return encoded(image.width, image.height, "u8", bytes);
}

Image shrunk(const Image& image, int side) {
    const int most = std::max(image.width, image.height);
    if (most <= side) return image;
    const auto scaled = [&](int n) {
        return std::max(1, int(std::lround(double(n) * side / most)));
    };
    Image small(scaled(image.width), scaled(image.height), image.channels);
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            const int x0 = int(std::int64_t(x) * image.width / small.width),
                      x1 = std::max(x0 + 1, int(std::int64_t(x + 1) * image.width / small.width)),
                      y0 = int(std::int64_t(y) * image.height / small.height),
                      y1 = std::max(y0 + 1, int(std::int64_t(y + 1) * image.height / small.height));
            for (int c = 0; c < image.channel_count(); ++c) {
                double sum = 0;
                for (int j = y0; j < y1; ++j)
                    for (int i = x0; i < x1; ++i) sum += image.at(i, j, c);
                small.at(x, y, c) = float(sum / ((x1 - x0) * (y1 - y0)));
            }
        }
    return small;
}

ordered_json number_column(const char* key, const char* title, const char* unit, int digits,
                           const char* better, const char* help) {
    return {{"key", key},       {"title", title},   {"unit", unit},
            {"digits", digits}, {"better", better}, {"help", help}};
}

ordered_json text_column(const char* key, const char* title, const char* help) {
    return {{"key", key}, {"title", title}, {"text", true}, {"help", help}};
}

void write_report(const ordered_json& document, const std::filesystem::path& folder) {
    make_output_folder(folder);
    std::string page(page_html);
    replace(page, "<!--TITLE-->", escaped(document.value("title", "Report")));
    replace(page, "/*STYLE*/", page_style);
    replace(page, "/*SCRIPT*/", page_script);
    replace(page, "/*DOCUMENT*/", for_script(document));
    ordered_json numbers = document;
    for (const char* key : {"pictures", "maps", "mask"}) numbers.erase(key);
    write_whole_file(folder / "report.json", dump(numbers, 2) + "\n");
    write_whole_file(folder / "index.html", page);
}

std::string utc_now() {
    return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)));
}

}  // namespace nacre
