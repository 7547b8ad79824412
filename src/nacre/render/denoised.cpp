#include "nacre/render/denoised.h"

#include "nacre/math/error.h"

namespace nacre {
namespace {

/// Channels one after the other and their variances.
struct Features {
    Image values, variance;

    Features(int width, int height)
        : values(
              width, height,
              {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "nearness"}),
          variance(width, height, values.channels) {}

    void put(int x, int y, int channel, const Film& film) {
        const Vec3f mean = film.mean(x, y), v = film.sample_variance(x, y);
        const float n = float(std::max(1u, film.count(x, y)));
        for (int c = 0; c < 3; ++c) {
            values.at(x, y, channel + c) = mean[c];
            variance.at(x, y, channel + c) = v[c] / n;
        }
    }
};

/// Depth as a feature: the least depth over depth, which is linear in the picture on planes, times
/// the share of the samples that met something.
void put_nearness(Features& features, const AuxiliaryImages& auxiliary) {
    const Film& depth = auxiliary.depth;
    float least = 0.f;
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x)
            if (const float d = depth.mean(x, y).x; d > 0.f && (least == 0.f || d < least))
                least = d;
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x) {
            const float d = depth.mean(x, y).x;
            if (!(d > 0.f)) continue;
            const float n = float(std::max(1u, auxiliary.albedo.count(x, y))),
                        met = float(depth.count(x, y)), share = std::min(1.f, met / n),
                        nearness = least / d;
            const float relative = depth.sample_variance(x, y).x / (d * d * met);
            features.values.at(x, y, 6) = share * nearness;
            features.variance.at(x, y, 6) =
                nearness * nearness * (share * share * relative + share * (1.f - share) / n);
        }
}

void put_mean(Image& image, int x, int y, const Vec3f& mean) {
    for (int c = 0; c < 3; ++c) image.at(x, y, c) = mean[c];
}

}  // namespace

DenoiseInput denoise_input(const RenderResult& result, const AuxiliaryImages& auxiliary) {
    if (result.halves.size() != 2)
        throw InputError("denoising needs the halves of the samples: render with options.halves");
    const Film &film = result.film, &a = result.halves[0], &b = result.halves[1];
    const int width = film.width(), height = film.height();
    Features features(width, height);
    DenoiseInput input{.halves = {Image(width, height), Image(width, height)},
                       .variance = Image(width, height)};
    double all = 0, first = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            all += film.count(x, y);
            first += a.count(x, y);
            // A pixel that only one half has seen is the same in both.
            put_mean(input.halves[0], x, y, (a.count(x, y) ? a : b).mean(x, y));
            put_mean(input.halves[1], x, y, (b.count(x, y) ? b : a).mean(x, y));
            const float n = float(std::max(1u, film.count(x, y)));
            put_mean(input.variance, x, y, film.sample_variance(x, y) * (1.f / n));
            features.put(x, y, 0, auxiliary.albedo);
            features.put(x, y, 3, auxiliary.normal);
        }
    put_nearness(features, auxiliary);
    if (first > 0 && first < all) input.share = float(first / all);
    input.features = std::move(features.values);
    input.feature_variance = std::move(features.variance);
    return input;
}

Image denoised(const RenderResult& result, const AuxiliaryImages& auxiliary, const Work& work) {
    return denoise(denoise_input(result, auxiliary), work);
}

void put_denoised(Image& picture, const Image& clean, const std::string& how) {
    const auto plain = [](const std::string& name) {
        return name == "R" || name == "G" || name == "B" || name == "Y";
    };
    std::vector<std::string> names, rest;
    for (const std::string& name : picture.channels) {
        if (plain(name)) names.push_back(name);
        const bool variance = name.starts_with("variance.") && plain(name.substr(9));
        rest.push_back(plain(name) ? "noisy." + name
                       : variance  ? "variance.noisy." + name.substr(9)
                                   : name);
    }
    const int n = static_cast<int>(names.size());
    names.insert(names.end(), rest.begin(), rest.end());
    Image all(picture.width, picture.height, names);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            for (int c = 0; c < n; ++c) all.at(x, y, c) = clean.at(x, y, c);
            for (int c = 0; c < picture.channel_count(); ++c)
                all.at(x, y, n + c) = picture.at(x, y, c);
        }
    all.metadata = std::move(picture.metadata);
    all.metadata["nacre.denoised"] = how;
    picture = std::move(all);
}

}  // namespace nacre
