// MerlBrdf for many pairs of directions: the places of sixteen are found together, and the table is
// asked for them while those before are summed, because that is what single calls wait for.
#include "nacre/measured/merl.h"
#include "nacre/measured/packs.h"

namespace nacre {
namespace {

constexpr int nh = MerlBrdf::theta_h_count, nd = MerlBrdf::theta_d_count,
              np = MerlBrdf::phi_d_count;

/// The place of each lane in the table: the node below, the steps to the next ones, and the parts.
struct PackPlace {
    std::array<std::int32_t, pack_size> first, h_step, d_step, p_step;
    std::array<float, pack_size> h, d, p;

    /// MerlPlace (merl.cpp) of each lane.
    PackPlace(const PackVec& wi, const PackVec& wo) {
        const Pack half(0.5f), zero(0.f);
        const PackVec h = (wi + wo) * half, d = (wi - wo) * half;
        const Pack cos_d = fast_sqrt(dot(h, h)), across = sin_theta_of(h);
        Pack y = d.y * h.x - d.x * h.y;
        Pack x = (h.z * (h.x * d.x + h.y * d.y) - across * across * d.z) / cos_d;
        const PackMask upright = across == zero;
        x = select(upright, d.x, x);
        y = select(upright, d.y, y);
        const PackMask turn = y < zero;
        x = select(turn, -x, x);
        y = select(turn, -y, y);
        constexpr float pi = std::numbers::pi_v<float>;
        set(fast_sqrt(fast_atan2(across, h.z) * Pack(2.f / pi)) * Pack(float(nh)), nh, h_below,
            this->h);
        set(fast_atan2(fast_sqrt(dot(d, d)), cos_d) * Pack(2.f / pi) * Pack(float(nd)), nd, d_below,
            this->d);
        set(fast_atan2(y, x) * Pack(1.f / pi) * Pack(float(np)), np, p_below, p);
        store((h_below * nd + d_below) * np + p_below, first);
        store(h_below < nh - 1 ? PackInts{} + nd * np : PackInts{}, h_step);
        store(d_below < nd - 1 ? PackInts{} + np : PackInts{}, d_step);
        store(p_below < np - 1 ? PackInts{} + 1 : PackInts{} + (1 - np), p_step);
    }

  private:
    PackInts h_below, d_below, p_below;

    static void set(Pack at, int nodes, PackInts& below, std::array<float, pack_size>& part) {
        // What is no number stays within the table.
        const Pack place = select(at > Pack(0.f), min(at, Pack(float(nodes))), Pack(0.f));
        below = to_ints(min(place, Pack(float(nodes - 1))));
        min(place - to_floats<pack_size>(below), Pack(1.f)).store(part.data());
    }
    static void store(PackInts i, std::array<std::int32_t, pack_size>& to) {
        __builtin_memcpy(to.data(), &i, sizeof i);
    }
};

}  // namespace

void MerlBrdf::eval_many(std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out,
                         std::span<bool> known) const {
    const auto fetch = [&](const PackPlace& at) {
        for (int i = 0; i < pack_size; ++i)
            for (int k = 0; k < 4; ++k) {
                const Lanes<float, 4>* v = values_.data() + at.first[i] +
                                           (k & 1 ? at.h_step[i] : 0) + (k & 2 ? at.d_step[i] : 0);
                __builtin_prefetch(v);
                __builtin_prefetch(v + at.p_step[i]);
            }
    };
    const auto sum = [&](const PackPlace& at, std::size_t begin, int count) {
        for (int i = 0; i < count; ++i) {
            using Four = Lanes<float, 4>;
            const Four* v = values_.data() + at.first[i];
            const auto along = [&](const Four* v) {
                return v[0] + Four(at.p[i]) * (v[at.p_step[i]] - v[0]);
            };
            const auto across = [&](const Four* v) {
                const Four a = along(v), b = along(v + at.d_step[i]);
                return a + Four(at.d[i]) * (b - a);
            };
            const Four low = across(v), high = across(v + at.h_step[i]);
            const Four s = low + Four(at.h[i]) * (high - low);
            const bool is_known = wi[begin + i].z > 0.f && wo[begin + i].z > 0.f && s[3] >= 0.5f;
            known[begin + i] = is_known;
            if (!is_known) continue;
            const Four mean = s / Four(s[3]);
            for (int c = 0; c < 3; ++c) out[3 * (begin + i) + c] = mean[c];
        }
    };
    std::optional<PackPlace> before;
    for_each_pack(wi.size(), [&](std::size_t i, int count) {
        const PackPlace at(load(&wi[i], count), load(&wo[i], count));
        fetch(at);
        if (before) sum(*before, i - pack_size, pack_size);
        before = at;
        if (i + pack_size >= wi.size()) sum(at, i, count);
    });
}

}  // namespace nacre
