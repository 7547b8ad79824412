#pragma once
// Techniques that path tracing shows: each says what is below the surface of a shape
// (render/translucency.h), and the path tracer does the rest. Shapes of one scene may have different
// ones.
#include <span>

#include "nacre/technique/technique.h"

namespace nacre {

class PathTracer;

/// What a shape's matter is made of.
struct ShapeInput {
    const Scene& scene;
    std::uint32_t shape;
    const ParameterValues& options;  ///< of the technique
    std::string_view profile;
    const ObjectBoundary& boundary;
    /// In each band, the factor of what returns behind a rough boundary (rough_half_space.h); empty
    /// if it is smooth.
    std::span<const double> rough_return;
    std::uint64_t seed;  ///< of what is drawn before the first frame
    /// Traces paths among surfaces, translucent shapes as local reflectors: for light that falls on
    /// the shape. Null while those are being made.
    const PathTracer* light;
    Statistics& statistics;  ///< what precomputation took
    const Work& work;        ///< whether to stop, and whom to tell how far precomputation is

    /// Index of the medium over that outside.
    float eta() const { return boundary.eta(); }
    const Medium& medium() const { return *scene.shapes[shape].interior; }
};

/// What `prepare` of such a technique is; all shapes' techniques are of this kind. Throws
/// InputError, with the place in the file, for flat shapes.
TechniquePtr prepare_path_technique(const TechniqueInput& input, const Work& work);

}  // namespace nacre
