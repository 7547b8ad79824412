#include "nacre/render/sampler.h"

#include "nacre/math/error.h"
#include "nacre/math/sobol.h"
#include "nacre/text/names.h"

namespace nacre {
namespace {

constexpr float below_one = 0x1.fffffep-1f;

}  // namespace

std::uint32_t permute(std::uint32_t i, std::uint32_t n, std::uint64_t key) {
    // Each round pairs x with (shift - x) mod n and swaps the pair or not; an index that is swapped
    // goes to a uniform place, so after 16 rounds all but 2^-16 of them are uniform.
    for (int round = 0; round < 16; ++round) {
        key = mix_bits(key + 0x9e3779b97f4a7c15ull);
        const auto shift = static_cast<std::uint32_t>((key >> 32) * n >> 32);
        const std::uint32_t partner = shift >= i ? shift - i : shift + n - i;
        const std::uint32_t pair = std::max(i, partner);
        const std::uint32_t coin = ((pair ^ static_cast<std::uint32_t>(key)) * 0x9e3779b1u) >> 31;
        i = coin ? partner : i;
    }
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
    throw InputError(unknown_name("sampler", name, {"independent", "stratified", "sobol"}));
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
