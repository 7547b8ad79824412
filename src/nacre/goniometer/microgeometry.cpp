#include "nacre/goniometer/microgeometry.h"

#include "nacre/math/error.h"
#include "nacre/text/split_words.h"

namespace nacre {

const Catalogue<MicrogeometryDescription>& microgeometries() {
    static const MicrogeometryDescription* const list[] = {
        &flat_geometry,     &cylinder_geometry, &v_groove_geometry,
        &gaussian_geometry, &fractal_geometry,  &brushed_geometry,
        &picture_geometry,  &fibre_geometry,    &weave_geometry};
    static const Catalogue<MicrogeometryDescription> all("microgeometry", std::span(list));
    return all;
}

namespace {

/// Takes file=NAME out of the words of `text`, for surfaces that have one.
std::filesystem::path take_file(const MicrogeometryDescription& d, std::string& text) {
    std::filesystem::path file;
    std::string rest;
    for (const std::string_view word : split_words(text, " ")) {
        if (!word.starts_with("file=") || word.size() == 5) {
            rest += std::string(word) + ' ';
            continue;
        }
        if (!file.empty()) throw InputError(fmt::format("{}: file is given twice", d.name));
        file = word.substr(5);
    }
    if (file.empty()) throw InputError(fmt::format("{}: which one? file=NAME is missing", d.name));
    text = rest;
    return file;
}

}  // namespace

Microgeometry make_microgeometry(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
    const MicrogeometryDescription& d = microgeometries().find(text.substr(begin, end - begin));
    std::string settings(text.substr(end));
    const std::filesystem::path file =
        d.make_of_file ? take_file(d, settings) : std::filesystem::path();
    const ParameterValues values(d.name, d.parameters, parse_settings(settings));
    return d.make_of_file ? d.make_of_file(values, file) : d.make(values);
}

Microgeometry height_field(int columns, int rows, double step, const std::vector<double>& heights) {
    Microgeometry g{.mesh = {}, .width = columns * step, .height = rows * step};
    g.mesh.name = "height field";
    const int across = columns + 3;  // from -1 to columns + 1
    g.mesh.positions.reserve(std::size_t(across) * (rows + 3) + 1);
    for (int j = -1; j <= rows + 1; ++j)
        for (int i = -1; i <= columns + 1; ++i) {
            const std::size_t at =
                std::size_t((j + rows) % rows) * columns + (i + columns) % columns;
            g.mesh.positions.push_back({float(i * step), float(j * step), float(heights[at])});
        }
    for (int j = 0; j < rows + 2; ++j)
        for (int i = 0; i < columns + 2; ++i) {
            const auto a = std::uint32_t(j * across + i), b = a + 1;
            const auto c = a + std::uint32_t(across), d = c + 1;
            // Diagonals by turns, so that none is preferred; the same ones a period on.
            if (((i + columns - 1) % columns + (j + rows - 1) % rows) % 2 == 0) {
                g.mesh.triangles.push_back({a, b, d});
                g.mesh.triangles.push_back({a, d, c});
            } else {
                g.mesh.triangles.push_back({a, b, c});
                g.mesh.triangles.push_back({b, d, c});
            }
        }
    return g;
}

Microgeometry extruded_profile(const std::vector<Vec2<double>>& profile, double period) {
    Microgeometry g{.mesh = {}, .width = period, .height = period};
    g.mesh.name = "profile";
    std::vector<Vec2<double>> points;
    const Vec2<double> before = profile.back();
    points.push_back({before.x - period, before.y});
    points.insert(points.end(), profile.begin(), profile.end());
    // To the first point beyond the period's end, so that the last piece does not end on it.
    for (std::size_t i = 0; i < 2; ++i)
        points.push_back({profile[i % profile.size()].x + period * double(1 + i / profile.size()),
                          profile[i % profile.size()].y});
    g.mesh.positions.reserve(2 * points.size() + 1);
    for (const Vec2<double>& p : points)
        for (double x : {-0.1 * period, 1.1 * period})
            g.mesh.positions.push_back({float(x), float(p.x), float(p.y)});
    for (std::uint32_t i = 0; i + 1 < points.size(); ++i) {
        const std::uint32_t a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
        g.mesh.triangles.push_back({a, b, d});
        g.mesh.triangles.push_back({a, d, c});
    }
    return g;
}

}  // namespace nacre
