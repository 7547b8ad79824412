#include "nacre/spectrum/uplift.h"

#include "nacre/spectrum/cie.h"
#include "nacre/spectrum/color.h"

namespace nacre {

namespace {

using Pack = Lanes<float, 8>;

// ---- The colour of a reflectance under D65, by quadrature on 189 wavelengths ----

constexpr int node_count = 189;  // 360 to 830 nm by 2.5 nm
constexpr int pack_count = (node_count + Pack::size - 1) / Pack::size;

// Weights of the nodes for X, Y, Z relative to white. They integrate the product of the observer,
// D65 and a reflectance that is linear between nodes, so a constant reflectance is exact.
struct Quadrature {
    std::array<Pack, pack_count> t, x, y, z;

    Quadrature() {
        std::array<Vec3d, node_count> w{};
        Vec3d white;
        for (int j = 0; j <= 940; ++j) {  // half nanometres, as in integrate_xyz
            const float nm = visible_min + 0.5f * static_cast<float>(j);
            const double step = j == 0 || j == 940 ? 0.25 : 0.5;
            const Vec3d v = Vec3d(cie_xyz(nm)) * (step * cie_d65(nm));
            const int i = std::min(j / 5, node_count - 2);
            const double f = 0.2 * j - i;
            w[i] += v * (1. - f);
            w[i + 1] += v * f;
            white += v;
        }
        for (int i = 0; i < pack_count * Pack::size; ++i) {
            const Vec3d v = i < node_count ? w[i] : Vec3d();
            const int p = i / Pack::size, lane = i % Pack::size;
            t[p].set(lane, -1.f + 2.f * static_cast<float>(i) / (node_count - 1));
            x[p].set(lane, static_cast<float>(v.x / white.x));
            y[p].set(lane, static_cast<float>(v.y / white.y));
            z[p].set(lane, static_cast<float>(v.z / white.z));
        }
    }
};

const Quadrature& quadrature() {
    static const Quadrature q;
    return q;
}

// ---- CIELAB (CIE 15:2018) of XYZ relative to white, and its derivative ----

constexpr float lab_edge = 6.f / 29.f;

float lab_f(float v) {
    return v > lab_edge * lab_edge * lab_edge ? std::cbrt(v)
                                              : v / (3.f * lab_edge * lab_edge) + 4.f / 29.f;
}
// f'(v), given f(v).
float lab_slope(float f) {
    const float g = std::max(f, lab_edge);
    return 1.f / (3.f * g * g);
}

Vec3f lab_of(Vec3f f) { return {116.f * f.y - 16.f, 500.f * (f.x - f.y), 200.f * (f.y - f.z)}; }

Vec3f lab_of_rgb(Vec3f rgb) {
    const Vec3f xyz = rgb_to_xyz(rgb), white = rgb_to_xyz({1.f, 1.f, 1.f});
    return lab_of({lab_f(xyz.x / white.x), lab_f(xyz.y / white.y), lab_f(xyz.z / white.z)});
}

// ---- Damped Gauss-Newton ----

struct Residual {
    Vec3f value;        // L*a*b* of the polynomial's colour minus the wanted one
    Vec3f gradient[3];  // derivatives of `value` by c0, c1, c2
};

Residual residual(const SigmoidPolynomial& c, Vec3f lab) {
    const Quadrature& q = quadrature();
    Pack v[3], d[3][3];
    for (int p = 0; p < pack_count; ++p) {
        const Pack t = q.t[p], s = (c.c0 * t + c.c1) * t + c.c2;
        const Pack r = 1.f / sqrt(1.f + s * s);
        const Pack value = 0.5f + 0.5f * s * r, slope = 0.5f * r * r * r;
        const Pack weights[3] = {q.x[p], q.y[p], q.z[p]};
        for (int k = 0; k < 3; ++k) {
            v[k] += weights[k] * value;
            const Pack g = weights[k] * slope;
            d[k][0] += g * t * t;
            d[k][1] += g * t;
            d[k][2] += g;
        }
    }
    const Vec3f f(lab_f(sum(v[0])), lab_f(sum(v[1])), lab_f(sum(v[2])));
    Residual out{lab_of(f) - lab, {}};
    for (int j = 0; j < 3; ++j) {
        const Vec3f df(lab_slope(f.x) * sum(d[0][j]), lab_slope(f.y) * sum(d[1][j]),
                       lab_slope(f.z) * sum(d[2][j]));
        out.gradient[j] = {116.f * df.y, 500.f * (df.x - df.y), 200.f * (df.y - df.z)};
    }
    return out;
}

// Solution of (J^T J + damping diag(J^T J)) step = -J^T r, by Cramer's rule on the columns.
Vec3f step_of(const Residual& r, float damping) {
    const Vec3d g[3] = {Vec3d(r.gradient[0]), Vec3d(r.gradient[1]), Vec3d(r.gradient[2])};
    const Vec3d v(r.value);
    Vec3d column[3], rhs;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            column[j][i] = dot(g[i], g[j]) * (i == j ? 1. + damping : 1.) + (i == j ? 1e-12 : 0.);
        rhs[i] = -dot(g[i], v);
    }
    const double scale = 1. / dot(column[0], cross(column[1], column[2]));
    return Vec3f(Vec3d(dot(rhs, cross(column[1], column[2])), dot(column[0], cross(rhs, column[2])),
                       dot(column[0], cross(column[1], rhs))) *
                 scale);
}

// Improves `c` until its colour is within 1e-3 of CIELAB (a thousandth of what an eye can tell,
// 1e-5 in linear RGB) or no step helps.
SigmoidPolynomial refine(SigmoidPolynomial c, Vec3f lab) {
    constexpr int max_steps = 30;
    constexpr float goal = 1e-3f;
    // Beyond this the sigmoid is a step or 0 or 1 to six digits, and single precision ends.
    constexpr float largest = 1e3f;
    Residual r = residual(c, lab);
    float error = length_squared(r.value), damping = 1e-4f;
    for (int i = 0; i < max_steps && error > goal * goal; ++i) {
        const Vec3f s = step_of(r, damping);
        const auto bounded = [=](float v) { return std::clamp(v, -largest, largest); };
        const SigmoidPolynomial next{bounded(c.c0 + s.x), bounded(c.c1 + s.y), bounded(c.c2 + s.z)};
        const Residual trial = residual(next, lab);
        const float trial_error = length_squared(trial.value);
        if (trial_error < error) {
            c = next, r = trial, error = trial_error;
            damping = std::max(damping * 0.1f, 1e-7f);
        } else {
            damping = damping * 10.f;
            if (!(damping < 1e6f)) break;
        }
    }
    return c;
}

// ---- Starting points: coefficients on a grid over all colours ----

constexpr int grid = 16;

// Brightness of grid row k, denser at both ends, where the coefficients change fastest (the paper's
// double smoothstep).
float brightness(int k) {
    const auto smooth = [](float v) { return v * v * (3.f - 2.f * v); };
    const float v = smooth(smooth(static_cast<float>(k) / (grid - 1)));
    return std::clamp(v, 1e-3f, 1.f - 1e-3f);
}

// The colour whose largest component is number `major`, of size z, the others being x z and y z.
Vec3f color_at(int major, float x, float y, float z) {
    Vec3f rgb;
    rgb[major] = z;
    rgb[(major + 1) % 3] = x * z;
    rgb[(major + 2) % 3] = y * z;
    return rgb;
}

// Solved row by row from a medium brightness up and down, each colour from its neighbour's
// solution.
std::vector<SigmoidPolynomial> solve_grid() {
    std::vector<SigmoidPolynomial> table(3 * grid * grid * grid);
    for (int major = 0; major < 3; ++major)
        for (int j = 0; j < grid; ++j)
            for (int i = 0; i < grid; ++i) {
                const auto solve = [&](int k, SigmoidPolynomial start) {
                    const Vec3f rgb = color_at(major, static_cast<float>(i) / (grid - 1),
                                               static_cast<float>(j) / (grid - 1), brightness(k));
                    const SigmoidPolynomial c = refine(start, lab_of_rgb(rgb));
                    table[((major * grid + k) * grid + j) * grid + i] = c;
                    return c;
                };
                constexpr int middle = grid / 3;
                const SigmoidPolynomial medium = solve(middle, {});
                SigmoidPolynomial c = medium;
                for (int k = middle + 1; k < grid; ++k) c = solve(k, c);
                c = medium;
                for (int k = middle - 1; k >= 0; --k) c = solve(k, c);
            }
    return table;
}

SigmoidPolynomial nearest_on_grid(Vec3f rgb) {
    static const std::vector<SigmoidPolynomial> table = solve_grid();
    const int major = rgb.x >= rgb.y && rgb.x >= rgb.z ? 0 : rgb.y >= rgb.z ? 1 : 2;
    const float z = rgb[major];
    int k = 0;
    while (k + 1 < grid && brightness(k + 1) - z < z - brightness(k)) ++k;
    const auto cell = [z](float v) { return static_cast<int>(v / z * (grid - 1) + 0.5f); };
    const int i = cell(rgb[(major + 1) % 3]), j = cell(rgb[(major + 2) % 3]);
    return table[((major * grid + k) * grid + j) * grid + i];
}

}  // namespace

float SigmoidPolynomial::max() const {
    const auto value = [this](float t) {
        const float x = (c0 * t + c1) * t + c2;
        return 0.5f + 0.5f * x / std::sqrt(1.f + x * x);
    };
    const float top = c0 < 0.f ? std::clamp(-0.5f * c1 / c0, -1.f, 1.f) : 1.f;
    return std::max({value(-1.f), value(1.f), value(top)});
}

SigmoidPolynomial fit_rgb(Vec3f rgb) {
    for (int i = 0; i < 3; ++i) rgb[i] = rgb[i] > 0.f ? std::min(rgb[i], 1.f) : 0.f;
    if (rgb.x == rgb.y && rgb.y == rgb.z) {
        // A grey is constant; black and white are exact: the sigmoid of 1e4 rounds to 1.
        const float v = rgb.x;
        return {0.f, 0.f, std::clamp((v - 0.5f) / std::sqrt(v * (1.f - v)), -1e4f, 1e4f)};
    }
    return refine(nearest_on_grid(rgb), lab_of_rgb(rgb));
}

}  // namespace nacre
