#pragma once
// A film with what it is a film of, so that it goes on only as the same picture, and is put together
// only with others of it.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "nacre/render/film_state.h"
#include "nacre/techniques/techniques.h"

namespace nacre {

/// Samples of one render.
struct RenderPart {
    std::uint64_t seed = 0;
    int samples = 0;                          ///< a pixel, valid or not: the most
    int x = 0, y = 0, width = 0, height = 0;  ///< the window of the film that they are in

    bool operator==(const RenderPart&) const = default;
};

/// By name, everything that decides the samples of a pixel but the seed: parts of the scene by
/// content ("shape", "emitter", ...), film, sampler, integrator and its settings, techniques of
/// shapes; and, from whoever adds it, the version of the program as "nacre". Renders may be of
/// different windows of the film.
using RenderIdentity = std::map<std::string, std::string>;
/// Throws as content_key does.
RenderIdentity identity_of(const Scene& scene, const RenderPlan& plan, const FrameSettings& frame);
/// What differs, in words: "shape; rr_depth (5 there, 8 here)"; empty if nothing does.
std::string differences(const RenderIdentity& there, const RenderIdentity& here);

/// Kept as a FilmState, whose notes hold the rest: identity under "nacre.is." and its names;
/// parts; sampler, samples, complete and times as pictures have them.
struct RenderState {
    Film film;
    RenderIdentity identity = {};
    std::vector<RenderPart> parts = {};
    std::string integrator = {};  ///< what rendered it
    int samples = 0;              ///< a pixel, as asked for
    bool complete = false;        ///< each pixel has that many
    double seconds = 0, cpu_seconds = 0;
    RayCounts counts = {};

    /// Throws InputError "FILE: what is wrong with it".
    static RenderState load(const std::filesystem::path& file);
    /// Throws RunError if it cannot be written; the file appears whole or not at all.
    static void save(const Film& film, const RenderState& about, const std::filesystem::path& file);
};

/// The window of the film and the most samples of its pixels.
RenderPart part_of(const Film& film, std::uint64_t seed);

/// One film of the samples of all: of the smallest window that holds theirs. Throws InputError,
/// with the names of two files, if they show different pictures or if samples would count twice,
/// since both have some of one seed and pixel.
RenderState merge(std::vector<RenderState> states, const std::vector<std::string>& names);

}  // namespace nacre
