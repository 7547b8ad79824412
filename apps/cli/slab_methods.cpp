#include "apps/cli/slab_methods.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nacre/layers/adding_doubling.h"
#include "nacre/layers/angular_grid.h"
#include "nacre/layers/hanrahan_krueger.h"
#include "nacre/layers/interfaces.h"
#include "nacre/layers/kubelka_munk.h"
#include "nacre/layers/slab_monte_carlo.h"
#include "nacre/math/error.h"
#include "nacre/text/names.h"

namespace nacre::cli {
namespace {

const double unknown = std::numeric_limits<double>::quiet_NaN();

/// Calls f(cosine, share of the light) for the nodes of a quadrature over diffuse light.
template <class F>
void for_diffuse_light(const LayerStack& stack, F&& f) {
    constexpr int nodes = 24;
    const double eta = stack.eta_above;
    for (const AngularNode& node : angular_grid(media_indices(stack), nodes))
        if (const double cosine = node.cosine_in(eta); cosine > 0.)
            f(cosine, 2. * node.weight / (eta * eta));
}

void add(LayerTotals& sum, const LayerTotals& t, double share) {
    sum.reflectance += share * t.reflectance;
    sum.transmittance += share * t.transmittance;
    sum.absorptance += share * t.absorptance;
    sum.specular += share * t.specular;
    sum.unscattered += share * t.unscattered;
}

SlabAnswer by_kubelka_munk(const SlabTask& task) {
    if (!task.diffuse && task.cosine < 1.)
        throw InputError("Kubelka and Munk know diffuse light and a beam along the normal");
    SlabAnswer answer{kubelka_munk(task.stack, TwoStreamMapping::diffusion,
                                   task.diffuse ? Entry::diffuse : Entry::normal)};
    answer.totals.unscattered = unknown;
    return answer;
}

SlabAnswer by_hanrahan_krueger(const SlabTask& task) {
    const HanrahanKruegerStack once(task.stack);
    if (!task.diffuse) return {once.totals(task.cosine)};
    SlabAnswer answer;
    for_diffuse_light(task.stack, [&](double cosine, double share) {
        add(answer.totals, once.totals(cosine), share);
    });
    return answer;
}

SlabAnswer by_adding_doubling(const SlabTask& task) {
    const std::array incident{task.cosine};
    const AddingDoublingResult r = adding_doubling(task.stack, incident);
    return {task.diffuse ? r.diffuse : r.collimated.front()};
}

SlabAnswer by_monte_carlo(const SlabTask& task) {
    const Work alone, &work = task.work ? *task.work : alone;
    SlabMonteCarloOptions options;
    options.photons = task.photons;
    options.seed = task.seed;
    options.cosine = task.cosine;
    if (!task.diffuse) {
        const SlabMonteCarloResult r = slab_monte_carlo(task.stack, options, work);
        return {r.totals, r.error};
    }
    // Each beam has photons in proportion to its light, and random numbers of its own.
    SlabAnswer answer{{}, LayerTotals{}};
    LayerTotals& error = *answer.error;
    for_diffuse_light(task.stack, [&](double cosine, double share) {
        options.cosine = cosine;
        options.photons = std::max<std::uint64_t>(64, std::uint64_t(share * double(task.photons)));
        const SlabMonteCarloResult r = slab_monte_carlo(task.stack, options, work);
        options.seed += std::uint64_t(1) << 32;
        add(answer.totals, r.totals, share);
        error.reflectance = std::hypot(error.reflectance, share * r.error.reflectance);
        error.transmittance = std::hypot(error.transmittance, share * r.error.transmittance);
        error.absorptance = std::hypot(error.absorptance, share * r.error.absorptance);
    });
    return answer;
}

constexpr SlabMethod methods[] = {
    {"km", "Kubelka-Munk", by_kubelka_munk},
    {"hk", "single scattering", by_hanrahan_krueger},
    {"ad", "adding-doubling", by_adding_doubling},
    {"mc", "Monte Carlo", by_monte_carlo},
};

}  // namespace

std::span<const SlabMethod> slab_methods() { return methods; }

std::vector<const SlabMethod*> find_slab_methods(const std::vector<std::string>& names) {
    std::vector<std::string_view> known;
    for (const SlabMethod& m : methods) known.push_back(m.name);
    known.emplace_back("all");
    std::vector<bool> wanted(std::size(methods), names.empty());
    for (const std::string& name : names) {
        const int i = find_name(name, known);
        if (i < 0) throw InputError(unknown_name("method", name, known));
        if (i == int(std::size(methods)))
            wanted.assign(wanted.size(), true);
        else
            wanted[std::size_t(i)] = true;
    }
    std::vector<const SlabMethod*> found;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i]) found.push_back(&methods[i]);
    return found;
}

}  // namespace nacre::cli
