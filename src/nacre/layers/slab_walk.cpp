#include "nacre/layers/slab_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "nacre/layers/slab_packs.h"

namespace nacre::slab {

namespace {

/// The photons of a batch, `width` at a time; a lane whose photon has ended gets the next one.
/// `single`: one layer that is not clear. `lateral`: x and y are followed as well as depth.
template <bool single, bool lateral>
class Walk {
  public:
    Walk(const WalkProblem& problem, const TallyLayout& layout, std::uint64_t key,
         std::uint64_t photons, double* tally)
        : problem_(problem),
          layout_(layout),
          tally_(tally),
          bottom_layer_(int(problem.layers.size()) - 1),
          random_(key),
          photons_(photons),
          left_(photons) {
        for (int i = 0; i < width; ++i) first_.set(i, problem.layers[0]);
        here_ = first_;
        const WalkLayer& l = problem.layers[0];
        matched_ = single && l.eta_up == 1.f && l.eta_down == 1.f;
        launch(all_lanes);
    }

    bool alive() const { return alive_ != 0; }
    /// Photons that have ended.
    std::uint64_t ended() const { return photons_ - left_ - std::uint64_t(std::popcount(alive_)); }

    // Inlined, with all of the loop, so that the packs of two walks stay in registers and overlap.
    [[gnu::always_inline]] void step() {
        fly();
        collide();
        if (const std::uint32_t dead = bits(weight_ == Pack(0.f))) launch(dead);
    }

    void finish() {
        const double photons = double(photons_);
        tally_[layout_.reflected] += reflected_.total();
        tally_[layout_.transmitted] += transmitted_.total();
        const double absorbed = photons - reflected_.total() - transmitted_.total();
        tally_[layout_.all_absorbed] += absorbed;
        if (single) tally_[layout_.absorbed] += absorbed;
    }

  private:
    /// New photons for these lanes as long as there are any; the others rest with weight 0.
    void launch(std::uint32_t dead) {
        std::uint32_t fresh = dead;
        while (std::uint64_t(std::popcount(fresh)) > left_) fresh &= fresh - 1;
        left_ -= std::uint64_t(std::popcount(fresh));
        alive_ = (all_lanes & ~dead) | fresh;
        const Where start = lanes_of<width>(fresh);
        weight_ = select(start, Pack(1.f), weight_);
        z_ = select(start, Pack(0.f), z_);
        uz_ = select(start, Pack(problem_.cosine), uz_);
        if constexpr (lateral) {
            x_ = select(start, Pack(0.f), x_);
            y_ = select(start, Pack(0.f), y_);
            ux_ = select(start, Pack(problem_.sine), ux_);
            uy_ = select(start, Pack(0.f), uy_);
        }
        if constexpr (!single) {
            for_each_bit(dead, [&](int i) {
                tally_[layout_.absorbed + std::size_t(layer_[i])] += double(entered_[i]);
            });
            entered_ = select(lanes_of<width>(dead), weight_, entered_);
            for_each_bit(fresh, [&](int i) { enter(i, 0); });
        }
    }

    void enter(int lane, int layer) {
        layer_[lane] = layer;
        here_.set(lane, problem_.layers[std::size_t(layer)]);
        const std::uint32_t bit = 1u << lane;
        in_top_ = layer == 0 ? in_top_ | bit : in_top_ & ~bit;
        in_bottom_ = layer == bottom_layer_ ? in_bottom_ | bit : in_bottom_ & ~bit;
    }

    /// To the next collision, or out. Where a photon is reflected, the rest of its way is mirrored.
    [[gnu::always_inline]] void fly() {
        const Pack zero(0.f);
        Pack way = -fast_log(random_.next()), from = z_;
        z_ = z_ + uz_ * way;
        Where gone = weight_ == zero;
        for (;;) {
            const Where down = uz_ > zero;
            // A clear layer has no optical thickness: there, to touch the border is to be beyond
            // it.
            const Where out = (single ? (z_ < zero) | (z_ > here_.tau)
                                      : (down & (z_ >= here_.tau)) | (!down & (z_ <= zero))) &
                              !gone;
            if (bits(out) == 0) break;
            const Pack border = select(down, here_.tau, zero);
            Pack cosine = abs(uz_);
            if constexpr (lateral) {
                const Pack steep = select(out, uz_, Pack(1.f));
                const Pack part = select(out, (border - from) / steep, zero);
                Pack length = part * here_.length;
                if constexpr (!single)
                    length = length + select(out, here_.clear / abs(steep), zero);
                advance(length);
                way = way - part;
                from = select(out, border, from);
            }
            Where passes = out;
            if (!matched_) {
                const Crossing c = cross(cosine, select(down, here_.eta_down, here_.eta_up));
                const Where reflected = random_.next() <= c.reflectance;
                cosine = c.cosine;
                passes = out & !reflected;
            }
            Where exits = passes;
            if constexpr (!single) {
                const std::uint32_t d = bits(down);
                exits = passes & lanes_of<width>((d & in_bottom_) | (~d & in_top_));
            }
            if (bits(exits)) {
                leave(exits, down, cosine);
                gone = gone | exits;
                way = select(exits, zero, way);
            }
            const Where mirrored = out & !passes;
            z_ = select(mirrored, border + border - z_, z_);
            uz_ = select(mirrored, -uz_, uz_);
            if constexpr (!single) {
                const Where crossing = passes & !exits;
                const Pack rest = lateral ? way : (z_ - border) / select(crossing, uz_, Pack(1.f));
                refract(crossing, down, cosine, rest);
                from = select(crossing, select(down, zero, here_.tau), from);
            }
        }
        if constexpr (lateral) advance(way * here_.length);
    }

    void advance(Pack length) {
        x_ = x_ + ux_ * length;
        y_ = y_ + uy_ * length;
    }

    /// Into the next layer, with the optical way that is left.
    void refract(Where crossing, Where down, Pack cosine, Pack rest) {
        const std::uint32_t lanes = bits(crossing), d = bits(down);
        if (lanes == 0) return;
        const Pack eta = select(down, here_.eta_down, here_.eta_up);
        for_each_bit(lanes, [&](int i) {
            tally_[layout_.absorbed + std::size_t(layer_[i])] += double(entered_[i] - weight_[i]);
            enter(i, layer_[i] + (d >> i & 1 ? 1 : -1));
        });
        entered_ = select(crossing, weight_, entered_);
        const Pack c = max(cosine, Pack(1e-6f));  // a photon that goes nowhere would never end
        uz_ = select(crossing, select(down, c, -c), uz_);
        z_ = select(crossing, select(down, Pack(0.f), here_.tau) + uz_ * rest, z_);
        if constexpr (lateral) {
            ux_ = select(crossing, ux_ / eta, ux_);
            uy_ = select(crossing, uy_ / eta, uy_);
        }
    }

    void leave(Where exits, Where down, Pack cosine) {
        const Pack zero(0.f);
        reflected_.add(select(exits & !down, weight_, zero));
        transmitted_.add(select(exits & down, weight_, zero));
        const SlabBins& b = layout_.bins;
        if (b.radius > 0 || b.angle > 0) {
            float weight[width], cosines[width], radii[width];
            weight_.store(weight);
            cosine.store(cosines);
            radius().store(radii);
            const std::uint32_t d = bits(down);
            for_each_bit(bits(exits), [&](int i) {
                record_exit(d >> i & 1, radii[i], cosines[i], double(weight[i]));
            });
        }
        if constexpr (!single) {
            for_each_bit(bits(exits), [&](int i) {
                tally_[layout_.absorbed + std::size_t(layer_[i])] +=
                    double(entered_[i] - weight_[i]);
            });
            entered_ = select(exits, zero, entered_);
        }
        weight_ = select(exits, zero, weight_);
    }

    void record_exit(bool below, float radius, float cosine, double weight) {
        const SlabBins& b = layout_.bins;
        const bool within = radius < float(b.radius);
        const auto r = std::size_t(within ? radius : 0.f);
        if (within)
            tally_[(below ? layout_.transmitted_radius : layout_.reflected_radius) + r] += weight;
        if (b.angle == 0) return;
        const float angle = std::acos(std::min(cosine, 1.f)) * float(2. * std::numbers::inv_pi);
        const auto a = std::size_t(std::min(int(angle * float(b.angle)), b.angle - 1));
        tally_[(below ? layout_.transmitted_angle : layout_.reflected_angle) + a] += weight;
        if (within && b.pairs)
            tally_[(below ? layout_.transmitted_radius_angle : layout_.reflected_radius_angle) +
                   r * std::size_t(b.angle) + a] += weight;
    }

    /// Distance from the axis, in bins.
    Pack radius() const {
        if constexpr (!lateral) return {};
        return fast_sqrt(x_ * x_ + y_ * y_) * Pack(float(1. / layout_.bins.radius_width));
    }

    [[gnu::always_inline]] void collide() {
        const Pack zero(0.f);
        if (layout_.bins.depth > 0) record_absorption();
        weight_ = weight_ - weight_ * here_.absorb;  // exact for albedos close to 1, too
        if (problem_.isotropic)
            scatter_isotropically();
        else
            scatter();
        const Where light = (weight_ < Pack(problem_.roulette_weight)) & (weight_ > zero);
        if (bits(light)) {
            const Where survives = random_.next() <= Pack(1.f / problem_.roulette_gain);
            const Pack after = select(survives, weight_ * Pack(problem_.roulette_gain), zero);
            weight_ = select(light, after, weight_);
        }
    }

    void record_absorption() {
        const SlabBins& b = layout_.bins;
        float weight[width], depths[width], radii[width];
        (weight_ * here_.absorb).store(weight);
        (here_.top_bin + z_ * here_.depth_bins).store(depths);
        radius().store(radii);
        const auto last = std::size_t(b.depth);
        for_each_bit(bits(weight_ > Pack(0.f)), [&](int i) {
            if (!(depths[i] < float(last))) return;
            const auto z = std::size_t(std::max(depths[i], 0.f));
            tally_[layout_.absorbed_depth + z] += double(weight[i]);
            if (lateral && b.pairs && radii[i] < float(b.radius))
                tally_[layout_.absorbed_radius_depth + std::size_t(radii[i]) * last + z] +=
                    double(weight[i]);
        });
    }

    void scatter_isotropically() {
        uz_ = Pack(2.f) * random_.next() - Pack(1.f);
        if constexpr (lateral) {
            const Pack sine = positive_sqrt(Pack(1.f) - uz_ * uz_);
            const auto circle = fast_unit_circle(random_.next());
            ux_ = sine * circle.cos;
            uy_ = sine * circle.sin;
        }
    }

    /// By Henyey and Greenstein, with phase_henyey_greenstein.h's form of the inverse.
    void scatter() {
        const Pack one(1.f), u = random_.next(), g = here_.g;
        const Pack m = (one - g) / (one - g + Pack(2.f) * g * u);
        const Pack less = Pack(2.f) * m * m * (one - u) * (one + g * u);  // 1 - cos
        const Pack c = one - less, sine2 = less * (Pack(2.f) - less);
        const auto circle = fast_unit_circle(random_.next());
        if constexpr (!lateral) {
            const Pack across = positive_sqrt((one - uz_ * uz_) * sine2) * circle.cos;
            uz_ = min(max(uz_ * c + across, -one), one);
        } else {
            // Two directions across the old one: T. Duff et al. 2017, Building an orthonormal
            // basis, revisited, JCGT 6(1).
            const Pack sine = positive_sqrt(sine2), s = sine * circle.cos, t = sine * circle.sin;
            const Pack sign = copysign(one, uz_), a = -one / (sign + uz_), b = ux_ * uy_ * a;
            const Pack x = s * (one + sign * ux_ * ux_ * a) + t * b + c * ux_;
            const Pack y = s * sign * b + t * (sign + uy_ * uy_ * a) + c * uy_;
            const Pack z = c * uz_ - s * sign * ux_ - t * uy_;
            // One step of Newton's towards length 1, or rounding would let it drift.
            const Pack f = Pack(1.5f) - Pack(0.5f) * (x * x + y * y + z * z);
            ux_ = x * f;
            uy_ = y * f;
            uz_ = z * f;
        }
    }

    const WalkProblem& problem_;
    const TallyLayout& layout_;
    double* tally_;
    int bottom_layer_;
    bool matched_ = false;

    RandomLanes<width> random_;
    LayerPacks first_, here_;
    Pack z_, uz_, weight_;
    Pack x_, y_, ux_, uy_;  // mm; lateral only
    Pack entered_;          // weight on entering the layer, unless single
    int layer_[width] = {};
    std::uint32_t in_top_ = 0, in_bottom_ = 0, alive_ = 0;
    std::uint64_t photons_, left_;
    WideSum reflected_, transmitted_;
};

template <bool single, bool lateral>
void walk(const WalkProblem& p, const TallyLayout& l, std::uint64_t key, std::uint64_t photons,
          WorkPhase& phase, double* tally) {
    // Two packs in turn: while one waits for the result of an instruction, the other computes.
    Walk<single, lateral> a(p, l, stream_key(key, 0), photons / 2, tally);
    Walk<single, lateral> b(p, l, stream_key(key, 1), photons - photons / 2, tally);
    // A look at whether to stop costs more than a step.
    constexpr int steps_at_a_time = 4096;
    std::uint64_t told = 0;
    while (a.alive() || b.alive()) {
        for (int i = 0; i < steps_at_a_time && (a.alive() || b.alive()); ++i) {
            a.step();
            b.step();
        }
        const std::uint64_t ended = a.ended() + b.ended();
        phase.advance(ended - told);
        told = ended;
    }
    a.finish();
    b.finish();
}

}  // namespace

TallyLayout::TallyLayout(const SlabBins& b, std::size_t layer_count)
    : bins(b), layers(layer_count) {
    const auto r = std::size_t(b.radius), z = std::size_t(b.depth), a = std::size_t(b.angle);
    const std::size_t pairs = b.pairs ? 1 : 0;
    size = 0;
    const auto reserve = [&](std::size_t& begin, std::size_t count) {
        begin = size;
        size += count;
    };
    reserve(reflected, 1);
    reserve(transmitted, 1);
    reserve(all_absorbed, 1);
    reserve(absorbed, layers);
    reserve(reflected_radius, r);
    reserve(transmitted_radius, r);
    reserve(reflected_angle, a);
    reserve(transmitted_angle, a);
    reserve(absorbed_depth, z);
    reserve(absorbed_radius_depth, pairs * r * z);
    reserve(reflected_radius_angle, pairs * r * a);
    reserve(transmitted_radius_angle, pairs * r * a);
}

void walk_batch(const WalkProblem& problem, const TallyLayout& layout, std::uint64_t key,
                std::uint64_t photons, WorkPhase& phase, double* tally) {
    const bool single = problem.layers.size() == 1 && problem.layers[0].length > 0.f;
    const bool lateral = layout.bins.radius > 0;
    const auto f = single ? (lateral ? walk<true, true> : walk<true, false>)
                          : (lateral ? walk<false, true> : walk<false, false>);
    f(problem, layout, key, photons, phase, tally);
}

}  // namespace nacre::slab
