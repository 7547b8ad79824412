// Any bytes either load as a measured file of the format NACRE_FUZZ_FORMAT, whose samples and values
// can then be asked for, or are refused with InputError. One program a format (CMakeLists.txt).
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "nacre/math/error.h"
#include "nacre/measured/formats.h"

namespace {

/// Directions of every kind, what callers may hand over by mistake included.
const nacre::Vec3d directions[] = {
    {0., 0., 1.},        {0.6, 0., 0.8}, {-0.6, 0., 0.8}, {0., 0.999, 0.0447101778},
    {0.48, -0.6, -0.64}, {0., 0., -1.},  {1., 0., 0.},    {std::nan(""), 0., 1.}};

void ask(const nacre::Measured& data) {
    const nacre::MeasuredInfo& info = data.info();
    if (info.channels < 1 || info.channels > nacre::max_measured_channels) std::abort();
    if (!info.wavelengths.empty() && info.wavelengths.size() != std::size_t(info.channels))
        std::abort();
    if (info.samples == 0 || info.missing + info.negative > info.samples) std::abort();
    std::vector<double> value(std::size_t(info.channels));
    std::vector<float> quick(value.size());
    for (const nacre::Vec3d& wi : directions)
        for (const nacre::Vec3d& wo : directions) {
            data.eval(wi, wo, value);
            data.eval_float(nacre::Vec3f(wi), nacre::Vec3f(wo), quick);
        }
    std::size_t seen = 0;
    data.for_each_sample([&](const nacre::MeasuredSample& s) {
        if (s.value.size() != value.size()) std::abort();
        if (++seen < 64) data.eval(s.wi, s.wo, value);
    });
    if (seen != info.samples) std::abort();
    const nacre::ChannelColours colours(info);
    colours(value);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static const nacre::MeasuredFormat& format = nacre::measured_formats().find(NACRE_FUZZ_FORMAT);
    const std::string_view text(reinterpret_cast<const char*>(bytes), size);
    format.recognise({text.substr(0, nacre::FileStart::length), size});
    try {
        ask(*format.read({text, "fuzz"}));
    } catch (const nacre::InputError&) {
    }
    return 0;
}
