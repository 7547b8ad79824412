#include "nacre/render/sampler.h"

#include <bit>

#include "nacre/math/error.h"
#include "nacre/math/sobol.h"

namespace nacre {
namespace {

constexpr float below_one = 0x1.fffffep-1f;

}  // namespace

std::uint32_t permute(std::uint32_t i, std::uint32_t n, std::uint64_t key) {
    if (n < 2) return 0;
    const int bits = std::bit_width(n - 1);
    const std::uint32_t mask = bits == 32 ? ~0u : (1u << bits) - 1;
    const int shift = std::max(1, bits / 2);
    do {
        std::uint64_t k = key;
        for (int round = 0; round < 4; ++round) {
            k = mix_bits(k + 0x9e3779b97f4a7c15ull);
            i = (i ^ static_cast<std::uint32_t>(k)) & mask;
            i = i * (static_cast<std::uint32_t>(k >> 32) | 1u) & mask;
            i ^= i >> shift;
        }
    } while (i >= n);
    return i;
}

Sampler::Sampler(Kind kind, std::uint64_t seed, int samples)
    : kind_(kind),
      seed_(seed),
      samples_(static_cast<std::uint32_t>(std::max(1, samples))),
      columns_(static_cast<std::uint32_t>(std::lround(std::sqrt(double(samples_))))),
      rows_((samples_ + columns_ - 1) / columns_) {}

Sampler::Kind Sampler::kind_from_name(const std::string& name) {
    if (name == "independent") return Kind::independent;
    if (name == "stratified") return Kind::stratified;
    if (name == "sobol") return Kind::sobol;
    throw InputError(
        fmt::format("unknown sampler '{}'; known are: independent, stratified, sobol", name));
}

void Sampler::start(std::uint64_t pixel, std::uint32_t sample_index) {
    pixel_key_ = stream_key(seed_, pixel);
    index_ = sample_index;
    call_ = 0;
    random_ = Random(stream_key(seed_, pixel, sample_index, 1));
}

float Sampler::next1d() {
    if (kind_ == Kind::independent) return random_.next();
    const std::uint64_t key = next_key();
    if (kind_ == Kind::sobol) return sobol_owen(index_, 0, static_cast<std::uint32_t>(key));
    const std::uint32_t stratum = permute(index_ % samples_, samples_, key + index_ / samples_);
    return std::min((float(stratum) + random_.next()) / float(samples_), below_one);
}

Vec2f Sampler::next2d() {
    if (kind_ == Kind::independent) return random_.next2();
    const std::uint64_t key = next_key();
    if (kind_ == Kind::sobol) {
        const auto seed = static_cast<std::uint32_t>(key);
        return {sobol_owen(index_, 0, seed), sobol_owen(index_, 1, seed)};
    }
    const std::uint32_t cells = columns_ * rows_;
    const std::uint32_t cell = permute(index_ % samples_, cells, key + index_ / samples_);
    const Vec2f jitter = random_.next2();
    return {std::min((float(cell % columns_) + jitter.x) / float(columns_), below_one),
            std::min((float(cell / columns_) + jitter.y) / float(rows_), below_one)};
}

}  // namespace nacre
