// A height field that is given as a picture.
#include <algorithm>
#include <cmath>

#include "nacre/goniometer/microgeometry.h"
#include "nacre/image/image.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

/// Grey in eight bits may differ by a code between channels: dither, JPEG.
constexpr float two_codes = 2.01f / 255.f;

/// The one value of each pixel, row after row from below.
std::vector<double> values_of(const Image& picture, const std::string& name) {
    std::vector<double> values;
    values.reserve(std::size_t(picture.width) * picture.height);
    for (int y = picture.height - 1; y >= 0; --y)
        for (int x = 0; x < picture.width; ++x) {
            const Vec3f c = picture.rgb(x, y);
            if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z))
                throw InputError(fmt::format("{}: pixel {}, {} is no number", name, x, y));
            const float most = std::max({c.x, c.y, c.z}), least = std::min({c.x, c.y, c.z});
            if (most - least > two_codes)
                throw InputError(fmt::format(
                    "{}: pixel {}, {} is coloured ({:.4g}, {:.4g}, {:.4g}): heights are "
                    "grey; convert the picture",
                    name, x, y, c.x, c.y, c.z));
            values.push_back(most == least ? double(c.x) : (double(c.x) + c.y + c.z) / 3.);
        }
    return values;
}

/// The picture and its mirror images, which meet without a step.
std::vector<double> mirrored(const std::vector<double>& values, int columns, int rows) {
    std::vector<double> all;
    all.reserve(4 * values.size());
    for (int j = 0; j < 2 * rows; ++j)
        for (int i = 0; i < 2 * columns; ++i) {
            const int y = j < rows ? j : 2 * rows - 1 - j,
                      x = i < columns ? i : 2 * columns - 1 - i;
            all.push_back(values[std::size_t(y) * columns + x]);
        }
    return all;
}

Microgeometry make_height_field(const ParameterValues& v, const std::filesystem::path& file) {
    // Heights are numbers, not colours: the curve of sRGB stays as it is.
    const Image picture = read_image(file, {.raw = true});
    int columns = picture.width, rows = picture.height;
    const double step = v.number("width") / columns;
    std::vector<double> heights = values_of(picture, file.string());
    if (v.word("edges") == "mirror") {
        heights = mirrored(heights, columns, rows);
        columns *= 2;
        rows *= 2;
    }
    if (columns < 2 || rows < 2 || double(columns) * rows > 1e8)
        throw InputError(fmt::format(
            "{}: heights at {} by {} points: at least 2 by 2 and at most 10^8 are possible",
            file.string(), columns, rows));
    for (double& h : heights) h *= v.number("height");
    return height_field(columns, rows, step, heights);
}

}  // namespace

const MicrogeometryDescription picture_geometry{
    .name = "height_field",
    .title = "Height field from a picture",
    .meaning =
        "a period is a grey picture (EXR, PFM, HDR, PNG of 8 or 16 bits, JPEG) whose pixels are "
        "points of the surface, linear between them; the top of the picture lies towards +y",
    .parameters =
        {{.name = "height",
          .meaning = "of the value 1 (white, in PNG and JPEG) above 0, as stored, without "
                     "the curve of sRGB",
          .unit = "that of width",
          .low = -1e9,
          .high = 1e9,
          .otherwise = 0.1},
         {.name = "width",
          .meaning = "of the picture along x; pixels are squares",
          .high = 1e9,
          .above_low = true,
          .otherwise = 1.},
         choice_parameter(
             "edges", "how pictures stand side by side",
             {{"repeat", "as they are: the edges must fit each other, or there is a step"},
              {"mirror", "by turns as mirror images, four a period"}})},
    .make_of_file = make_height_field,
};

}  // namespace nacre
