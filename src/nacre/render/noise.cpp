#include "nacre/render/noise.h"

#include <cmath>
#include <limits>

namespace nacre {
namespace {

constexpr double epsilon = 0.01;
/// Relative variance of a sample that is rounding.
constexpr double no_noise = 1e-12;

}  // namespace

double film_noise(const Film& film) {
    double sum = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            const Vec3f mean = film.mean(x, y);
            for (int c = 0; c < 3; ++c) sum += double(mean[c]);
        }
    const double picture_mean = sum / (3. * film.width() * film.height());

    double errors = 0;
    std::size_t noisy = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            const double n = film.count(x, y);
            if (film.drawn(x, y) < 2) return std::numeric_limits<double>::infinity();
            if (n < 2) continue;  // invalid samples, of which others tell
            const Vec3f mean = film.mean(x, y), variance = film.sample_variance(x, y);
            for (int c = 0; c < 3; ++c) {
                const double m2 = double(mean[c]) * double(mean[c]), v = double(variance[c]);
                if (!(v > no_noise * m2)) continue;
                errors += v / n / (m2 + epsilon * picture_mean * picture_mean);
                ++noisy;
            }
        }
    return noisy ? std::sqrt(errors / double(noisy)) : 0.;
}

}  // namespace nacre
