#include "nacre/measured/factor/textures.h"

#include <algorithm>

#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/text/number.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using Metadata = std::map<std::string, std::string>;

constexpr int most_terms = 4096;

fs::path file_of(const fs::path& folder, char letter, int term) {
    return folder / fmt::format("{}{:02}.exr", letter, term);
}

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
    throw InputError(fmt::format("{}: {}", file.string(), what));
}

Metadata metadata_of(const FactoredBrdf& b) {
    const bool half = b.grid().parameters == FactorParameters::half_difference;
    return {{"factorOf", b.name()},
            {"factorIsotropic", b.isotropic() ? "yes" : "no"},
            {"factorParameters", std::string(name_of(b.grid().parameters))},
            {"factorTerms", std::to_string(b.terms().size())},
            {"factorValues", b.logarithmic() ? "logarithm" : "linear"},
            {"factorScale", b.logarithmic() ? "sr^-1 = exp(sum of g h)" : "sr^-1 = sum of g h"},
            {"factorLayout", fmt::format("phi = 360 (x + 0.5)/R; theta = 90 (y + 0.5)/R{}",
                                         half ? ", of g its square: 90 ((y + 0.5)/R)^2" : "")}};
}

Image image_of(const FactorTexture& t, int side, const Metadata& metadata) {
    Image image(side, side);
    for (int r1 = 0; r1 < side; ++r1)
        for (int r2 = 0; r2 < side; ++r2)
            for (int c = 0; c < 3; ++c) image.at(r1, r2, c) = t[side * r1 + r2][c];
    image.metadata = metadata;
    return image;
}

FactorTexture texture_of(const Image& image, const fs::path& file) {
    FactorTexture t(std::size_t(image.width) * image.height);
    for (int r1 = 0; r1 < image.width; ++r1)
        for (int r2 = 0; r2 < image.height; ++r2) {
            const Vec3f v = image.rgb(r1, r2);
            for (int c = 0; c < 3; ++c)
                if (!std::isfinite(v[c]))
                    fail(file, fmt::format("pixel {}, {} is not finite; factor again", r1, r2));
            t[std::size_t(image.width) * r1 + r2] = v;
        }
    return t;
}

/// What a file says under a key; refuses what is none of `known`.
std::string said(const Image& image, const fs::path& file, const std::string& key,
                 const std::vector<std::string>& known = {}) {
    const auto at = image.metadata.find(key);
    if (at == image.metadata.end())
        fail(file, fmt::format("has no attribute '{}'; it was not written by nacre factor", key));
    if (!known.empty() && std::ranges::find(known, at->second) == known.end())
        fail(file, fmt::format("attribute '{}' is '{}'; known are: {}", key, at->second,
                               fmt::join(known, ", ")));
    return at->second;
}

Image read(const fs::path& file) {
    Image image = read_image(file);
    if (image.width != image.height || image.width < FactorGrid::least_side ||
        image.width > FactorGrid::most_side)
        fail(file,
             fmt::format("has {} x {} pixels; factors are square, of a side from {} to {}",
                         image.width, image.height, FactorGrid::least_side, FactorGrid::most_side));
    return image;
}

int terms_said(const Image& image, const fs::path& file) {
    const std::string text = said(image, file, "factorTerms");
    const auto number = parse_integer(text);
    if (!number || *number < 1 || *number > most_terms)
        fail(file, fmt::format("attribute 'factorTerms' is '{}', not a number from 1 to {}", text,
                               most_terms));
    return int(*number);
}

}  // namespace

void write_factors(const FactoredBrdf& brdf, const fs::path& folder) {
    const Metadata metadata = metadata_of(brdf);
    const int side = brdf.grid().side;
    int term = 1;
    for (const FactorTerm& t : brdf.terms()) {
        write_image(image_of(t.g, side, metadata), file_of(folder, 'g', term));
        write_image(image_of(t.h, side, metadata), file_of(folder, 'h', term));
        ++term;
    }
    std::error_code none;
    for (; fs::remove(file_of(folder, 'g', term), none) |
           fs::remove(file_of(folder, 'h', term), none);
         ++term) {
    }
}

FactoredBrdf read_factors(const fs::path& folder) {
    std::error_code none;
    const fs::path first = file_of(folder, 'g', 1);
    if (!fs::is_directory(folder, none) || !fs::exists(first, none))
        fail(folder, "is no folder of factors: it has no g01.exr; nacre factor -o writes one");
    const Image image = read(first);
    const FactorGrid grid{
        said(image, first, "factorParameters", {"in_out", "half_difference"}) == "in_out"
            ? FactorParameters::in_out
            : FactorParameters::half_difference,
        image.width};
    const bool logarithmic =
        said(image, first, "factorValues", {"linear", "logarithm"}) == "logarithm";
    const bool isotropic = said(image, first, "factorIsotropic", {"yes", "no"}) == "yes";
    const int count = terms_said(image, first);
    const std::string name = said(image, first, "factorOf");
    std::vector<FactorTerm> terms(count);
    for (int term = 1; term <= count; ++term)
        for (const char letter : {'g', 'h'}) {
            const fs::path file = file_of(folder, letter, term);
            const Image other = read(file);
            if (other.width != image.width || other.metadata != image.metadata)
                fail(file, "is of another factorisation than g01.exr; factor again");
            (letter == 'g' ? terms[term - 1].g : terms[term - 1].h) = texture_of(other, file);
        }
    return FactoredBrdf(grid, std::move(terms), logarithmic, name, isotropic);
}

}  // namespace nacre
