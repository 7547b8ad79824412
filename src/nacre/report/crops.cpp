#include "nacre/report/crops.h"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

/// Sum of the squared relative differences of blocks of a quarter of the square: noise averages
/// out, and what differs in the square's corner is seen.
double difference(const Image& picture, const Image& reference, const PixelMask& mask,
                  const Crop& crop) {
    const int step = std::max(1, crop.side / 4);
    double total = 0;
    for (int y0 = crop.y; y0 + step <= crop.y + crop.side; y0 += step)
        for (int x0 = crop.x; x0 + step <= crop.x + crop.side; x0 += step) {
            double p = 0, t = 0;
            for (int y = y0; y < y0 + step; ++y)
                for (int x = x0; x < x0 + step; ++x) {
                    if (!mask(x, y)) continue;
                    const Vec3f a = picture.rgb(x, y), b = reference.rgb(x, y);
                    p += double(a.x) + a.y + a.z;
                    t += double(b.x) + b.y + b.z;
                }
            const double d = t > 0 ? (p - t) / t : 0;
            total += std::min(d * d, 1.);  // one bright spot must not decide
        }
    return total;
}

bool mostly_covered(const PixelMask& mask, const Crop& c) {
    int covered = 0;
    for (int y = c.y; y < c.y + c.side; ++y)
        for (int x = c.x; x < c.x + c.side; ++x) covered += mask(x, y);
    return 2 * covered >= c.side * c.side;
}

}  // namespace

std::vector<Crop> telling_crops(const std::vector<const Image*>& pictures, const Image& reference,
                                const PixelMask& mask, int count) {
    const int shorter = std::min(reference.width, reference.height);
    const int side = std::min(shorter, std::max(24, shorter / 8));
    struct Candidate {
        Crop crop;
        double score;
    };
    std::vector<Candidate> candidates;
    for (int y = 0; y + side <= reference.height; y += std::max(1, side / 2))
        for (int x = 0; x + side <= reference.width; x += std::max(1, side / 2)) {
            const Crop crop{x, y, side};
            if (!mostly_covered(mask, crop)) continue;
            double score = 0;
            for (const Image* p : pictures) score += difference(*p, reference, mask, crop);
            candidates.push_back({crop, score});
        }
    std::ranges::stable_sort(candidates, std::greater<>{}, &Candidate::score);
    std::vector<Crop> chosen;
    for (const Candidate& c : candidates) {
        if (int(chosen.size()) == count) break;
        const bool apart = std::ranges::all_of(chosen, [&](const Crop& o) {
            return std::abs(o.x - c.crop.x) >= 2 * side || std::abs(o.y - c.crop.y) >= 2 * side;
        });
        if (apart) chosen.push_back(c.crop);
    }
    return chosen;
}

}  // namespace nacre
