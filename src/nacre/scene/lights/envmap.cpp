// Light from infinitely far away by a picture in latitude and longitude.
//
// The mapping is Mitsuba 3's: a local direction d has u = atan2(d.x, -d.z) / 2 pi (modulo 1) and
// v = acos(d.y) / pi, so +Y is up, the middle of the picture is +Z, its left edge -Z, and the
// middle of its left half +X. Columns of pixels stand at u = (x + 1/2) / width and repeat; rows
// stand at v = y / (height - 1), so the first row is the upper pole and the last the lower one.
// Between them radiance is bilinear.
//
// Directions are drawn by the cells between four pixels: a cell with probability proportional to
// its mean luminance times its solid angle, and uniformly in solid angle within it.
#include <tbb/parallel_for.h>

#include <mutex>
#include <numbers>

#include "nacre/math/error.h"
#include "nacre/scene/lights/types.h"
#include "nacre/spectrum/color.h"
#include "nacre/spectrum/uplift.h"

namespace nacre {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Index of the interval of a cumulative distribution (0 = cdf[0], ..., cdf[n] = 1) that holds u,
/// and where in it u lies. Intervals of no width are never found.
std::pair<int, float> find_interval(std::span<const float> cdf, float u) {
    const auto above = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, u);
    const int i = static_cast<int>(above - cdf.begin()) - 1;
    const float width = cdf[i + 1] - cdf[i];
    return {i, width > 0.f ? std::clamp((u - cdf[i]) / width, 0.f, 1.f) : 0.5f};
}

/// Turns weights[1..n] (weights[0] = 0) into a cumulative distribution; returns their sum. The last
/// interval of positive weight ends at exactly 1.
double accumulate(std::span<float> weights) {
    double sum = 0.0;
    for (const float w : weights) sum += w;
    if (!(sum > 0.0)) return 0.0;
    double running = 0.0;
    for (float& w : weights) w = static_cast<float>(std::min(1.0, (running += w) / sum));
    return sum;
}

class EnvironmentMap final : public Light {
  public:
    EnvironmentMap(int width, int height, std::vector<Vec3f> texels,
                   const EnvironmentPlacement& placement)
        : width_(width),
          height_(height),
          texels_(std::move(texels)),
          scene_radius_(placement.scene_radius),
          white_(make_rgb_illuminant({1.f, 1.f, 1.f})) {
        const auto axis = [&](const Vec3f& v) { return normalize(placement.to_world.vector(v)); };
        x_ = axis({1.f, 0.f, 0.f});
        y_ = axis({0.f, 1.f, 0.f});
        z_ = axis({0.f, 0.f, 1.f});
        build_distribution();
    }

    LightSample sample(const Point3f& from, Vec2f u, const Wavelengths& w) const override {
        if (!(total_ > 0.0)) return {};
        const auto [row, in_row] = find_interval(rows_, u.y);
        const std::span<const float> columns(&columns_[std::size_t(row) * (width_ + 1)],
                                             std::size_t(width_) + 1);
        const auto [column, in_column] = find_interval(columns, u.x);
        const float top = std::cos(polar_angle(row)), bottom = std::cos(polar_angle(row + 1));
        const float cosine = top + (bottom - top) * in_row;
        const float sine = std::sqrt(std::max(0.f, 1.f - cosine * cosine));
        const float phi = 2.f * pi * ((column + in_column + 0.5f) / width_);
        const Vec3f wi = x_ * (sine * std::sin(phi)) + y_ * cosine - z_ * (sine * std::cos(phi));
        // Looked up again, so that rounding at the edge of a cell cannot make this density differ
        // from what `pdf` says.
        return {wi, 1e30f, radiance(nullptr, wi, w), pdf(from, wi, nullptr)};
    }

    float pdf(const Point3f&, const Vec3f& wi, const SurfacePoint*) const override {
        if (!(total_ > 0.0)) return 0.f;
        const Lookup at = lookup(wi);
        return density_[std::size_t(at.y) * width_ + at.x];
    }

    Spectral radiance(const SurfacePoint*, const Vec3f& direction,
                      const Wavelengths& w) const override {
        const Lookup at = lookup(direction);
        const std::size_t x1 = at.x + 1 == width_ ? 0 : at.x + 1;
        const std::size_t upper = std::size_t(at.y) * width_, lower = upper + width_;
        const std::size_t index[4] = {upper + at.x, upper + x1, lower + at.x, lower + x1};
        const float weight[4] = {(1.f - at.fx) * (1.f - at.fy), at.fx * (1.f - at.fy),
                                 (1.f - at.fx) * at.fy, at.fx * at.fy};
        if (w.mode == ColorMode::rgb_bands) {
            Vec3f rgb;
            for (int i = 0; i < 4; ++i) rgb += texels_[index[i]] * weight[i];
            return {rgb.x, rgb.y, rgb.z, 0.f};
        }
        const std::vector<SpectralTexel>& spectral = spectral_texels();
        Spectral sum(0.f);
        for (int i = 0; i < 4; ++i) {
            const SpectralTexel& t = spectral[index[i]];
            sum += (weight[i] * t.scale) * t.shape.eval(w.lambda);
        }
        return sum * white_->eval(w);
    }

    /// What enters the bounding sphere through its cross section, over all directions.
    float power() const override {
        return static_cast<float>(pi * scene_radius_ * scene_radius_ * total_);
    }
    bool is_infinite() const override { return true; }
    Box3f bounds() const override { return {}; }

  private:
    /// A cell and the position in it.
    struct Lookup {
        int x, y;
        float fx, fy;
    };
    /// As make_rgb_illuminant: scale times a smooth shape times D65.
    struct SpectralTexel {
        SigmoidPolynomial shape;
        float scale;
    };

    Lookup lookup(const Vec3f& d) const {
        const Vec3f local{dot(d, x_), dot(d, y_), dot(d, z_)};
        float u = std::atan2(local.x, -local.z) * (0.5f / pi) - 0.5f / width_;
        u -= std::floor(u);
        // The arc tangent keeps its digits near the poles, where acos(y) loses half of them.
        const float v = std::atan2(std::hypot(local.x, local.z), local.y) * (1.f / pi);
        const float x = u * width_, y = v * (height_ - 1);
        const int ix = std::min(static_cast<int>(x), width_ - 1);
        const int iy = std::min(static_cast<int>(y), height_ - 2);
        return {ix, iy, std::min(x - ix, 1.f), std::min(y - iy, 1.f)};
    }

    float polar_angle(int row) const { return pi * row / (height_ - 1); }

    void build_distribution() {
        const int rows = height_ - 1;
        rows_.assign(std::size_t(rows) + 1, 0.f);
        columns_.assign(std::size_t(rows) * (width_ + 1), 0.f);
        density_.resize(std::size_t(rows) * width_);
        for (int y = 0; y < rows; ++y) {
            const double ring =
                std::cos(std::numbers::pi * y / rows) - std::cos(std::numbers::pi * (y + 1) / rows);
            const double solid_angle = 2.0 * std::numbers::pi / width_ * ring;
            float* columns = &columns_[std::size_t(y) * (width_ + 1)];
            for (int x = 0; x < width_; ++x) {
                const int x1 = x + 1 == width_ ? 0 : x + 1;
                const float mean = 0.25f * (texel_luminance(x, y) + texel_luminance(x1, y) +
                                            texel_luminance(x, y + 1) + texel_luminance(x1, y + 1));
                density_[std::size_t(y) * width_ + x] = mean;
                columns[x + 1] = mean;
            }
            const double row_sum = accumulate({columns, std::size_t(width_) + 1}) * solid_angle;
            rows_[std::size_t(y) + 1] = static_cast<float>(row_sum);
        }
        total_ = accumulate(rows_);
        if (total_ > 0.0)
            for (float& d : density_) d = static_cast<float>(d / total_);
    }

    float texel_luminance(int x, int y) const {
        return luminance(texels_[std::size_t(y) * width_ + x]);
    }

    /// Fitted when first asked for: RGB renders need none of it.
    const std::vector<SpectralTexel>& spectral_texels() const {
        std::call_once(spectral_made_, [this] {
            std::vector<SpectralTexel> made(texels_.size());
            tbb::parallel_for(std::size_t(0), texels_.size(), [&](std::size_t i) {
                const Vec3f& rgb = texels_[i];
                const float scale = 2.f * std::max({rgb.x, rgb.y, rgb.z});
                if (scale > 0.f) made[i] = {fit_rgb(rgb * (1.f / scale)), scale};
            });
            spectral_ = std::move(made);
        });
        return spectral_;
    }

    int width_, height_;
    std::vector<Vec3f> texels_;  ///< scaled, rows from the top
    Vec3f x_, y_, z_;            ///< local axes in the world
    float scene_radius_;
    SpectrumPtr white_;
    std::vector<float> rows_;     ///< cumulative distribution of the rows of cells
    std::vector<float> columns_;  ///< for each row, of its cells
    std::vector<float> density_;  ///< per solid angle, of each cell
    double total_ = 0.0;          ///< integral of luminance over the sphere
    mutable std::once_flag spectral_made_;
    mutable std::vector<SpectralTexel> spectral_;
};

/// True if the map preserves solid angles up to a common factor: rotations, mirrors, uniform
/// scales.
bool is_similarity(const Transform& t) {
    const Vec3f x = t.vector({1.f, 0.f, 0.f}), y = t.vector({0.f, 1.f, 0.f}),
                z = t.vector({0.f, 0.f, 1.f});
    const float size = length_squared(x);
    constexpr float tolerance = 1e-4f;
    return std::abs(length_squared(y) - size) <= tolerance * size &&
           std::abs(length_squared(z) - size) <= tolerance * size &&
           std::abs(dot(x, y)) <= tolerance * size && std::abs(dot(y, z)) <= tolerance * size &&
           std::abs(dot(z, x)) <= tolerance * size;
}

}  // namespace

LightPtr make_environment_map(const Image& image, const EnvironmentPlacement& placement,
                              const std::string& name, std::vector<std::string>& warnings) {
    if (image.width < 2 || image.height < 3)
        throw InputError(
            fmt::format("{}: an environment map needs at least 2 x 3 pixels; this has {} x {}",
                        name, image.width, image.height));
    if (!is_similarity(placement.to_world))
        throw InputError(fmt::format(
            "{}: to_world of an environment map must be a rotation; it shears or stretches", name));
    std::vector<Vec3f> texels(std::size_t(image.width) * image.height);
    std::size_t negative = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            Vec3f rgb = image.rgb(x, y);
            for (int c = 0; c < 3; ++c) {
                if (!std::isfinite(rgb[c]))
                    throw InputError(
                        fmt::format("{}: pixel ({}, {}) is {}; an environment map must be finite",
                                    name, x, y, rgb[c]));
                if (rgb[c] < 0.f) ++negative, rgb[c] = 0.f;
            }
            texels[std::size_t(y) * image.width + x] = rgb * placement.scale;
        }
    if (negative > 0)
        warnings.push_back(fmt::format("{}: {} negative values were set to 0: no light is negative",
                                       name, negative));
    return std::make_shared<EnvironmentMap>(image.width, image.height, std::move(texels),
                                            placement);
}

LightPtr make_environment_map(const SceneNode& node, BuildContext& context) {
    const std::filesystem::path file = context.file(node, "filename");
    const double scale = node.get_float("scale", 1.0);
    if (!(scale >= 0.0) || !std::isfinite(scale))
        node.fail_at("scale", fmt::format("scale must be at least 0 and finite; got {}", scale));
    // Changes the noise of Mitsuba's renders, never their mean; nacre samples in its own way.
    node.get_bool("mis_compensation", false);
    return make_environment_map(
        read_image(file),
        {static_cast<float>(scale), node.get_transform("to_world"), context.scene_radius},
        file.string(), context.warnings);
}

}  // namespace nacre
