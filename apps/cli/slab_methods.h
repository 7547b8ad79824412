#pragma once
// The methods that `nacre slab` sets side by side: one table.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/layers/layer.h"
#include "nacre/math/work.h"

namespace nacre::cli {

struct SlabTask {
    LayerStack stack;
    bool diffuse = false;  ///< the same radiance from all directions above, instead of a beam
    double cosine = 1.;    ///< of the beam, in the medium above
    std::uint64_t photons = 1'000'000, seed = 0;
    const Work* work = nullptr;  ///< of Monte Carlo; may be null
};

/// What a method cannot tell is not a number.
struct SlabAnswer {
    LayerTotals totals;
    std::optional<LayerTotals> error = {};  ///< standard errors, of methods that have them
};

struct SlabMethod {
    std::string_view name;   ///< on the command line
    std::string_view title;  ///< in tables
    /// Throws InputError for stacks that the method cannot take.
    SlabAnswer (*solve)(const SlabTask&);
};

std::span<const SlabMethod> slab_methods();

/// Methods by their names; empty or "all" are all. Throws InputError for unknown ones.
std::vector<const SlabMethod*> find_slab_methods(const std::vector<std::string>& names);

}  // namespace nacre::cli
