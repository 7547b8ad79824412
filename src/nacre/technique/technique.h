#pragma once
// What a technique is: something that makes pictures of a scene with translucent objects. It says
// of itself what its options are and what of a scene may change once it is prepared; it is prepared
// once, told what changed, and renders frames.
//
// A technique is one file: its description with its parameters, what it prepares, how it renders.
// The one list of all is techniques/techniques.h, from which the command line, the scene reader,
// comparisons and the documentation are driven.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/catalogue/parameter.h"
#include "nacre/catalogue/settings.h"
#include "nacre/render/render.h"
#include "nacre/render/translucency.h"
#include "nacre/scene/scene.h"

namespace nacre {

/// Parts of a scene that may change from one frame to the next.
struct Changes {
    bool view = false;      ///< camera, film, samples: what a frame says anyway
    bool light = false;     ///< lights and environment
    bool material = false;  ///< materials and media
    bool geometry = false;  ///< shapes, their places and forms

    /// Whether all of these are among the others.
    bool within(const Changes& others) const {
        return (!view || others.view) && (!light || others.light) &&
               (!material || others.material) && (!geometry || others.geometry);
    }
    /// "view, light"
    std::string text() const;
    bool operator==(const Changes&) const = default;
};

/// A technique that is ready to render the scene it was prepared for. Not for two threads at a
/// time; it uses as many as it is given.
class Technique {
  public:
    virtual ~Technique() = default;

    /// A picture of the scene, which has not changed but as `changed` was told. As nacre::render of
    /// render.h, and the bits are as promised there.
    virtual RenderResult render(const FrameSettings& frame, const RenderOptions& options = {}) = 0;
    /// The scene changed in these parts (its owner saw to it that nobody rendered then). What was
    /// precomputed from them is computed anew, the rest is kept: the next frame is as if the
    /// technique had been prepared for the scene as it is. Throws as `prepare` does.
    virtual void changed(const Changes& what, const Work& work = {}) = 0;
    /// What precomputation took and made.
    virtual Statistics statistics() const { return {}; }
};
using TechniquePtr = std::unique_ptr<Technique>;

struct TechniqueDescription;

/// Which technique renders a shape, and how.
struct ShapeTechnique {
    const TechniqueDescription* technique = nullptr;  ///< null: the shape is not translucent
    ParameterValues options;                          ///< of the technique's parameters
    /// The profile R(r) that stands for the shape's matter where light only passes by, whether or
    /// not the technique has such a parameter.
    std::string profile = "dipole";
    std::string place = {};  ///< in the scene file, "file:line:column: "; empty: none
};

/// What a technique is prepared for.
struct TechniqueInput {
    const Scene& scene;                  ///< outlives the technique
    std::vector<ShapeTechnique> shapes;  ///< one for each shape of the scene
    std::uint64_t seed = 0;              ///< of what is drawn before the first frame
};

struct ShapeInput;     // path_technique.h
struct RealtimeInput;  // realtime/realtime_technique.h
class RealtimeTechnique;

struct TechniqueDescription {
    std::string_view name;   ///< in scene files and on the command line
    std::string_view title;  ///< as the field says
    std::string_view authors;
    int year = 0;
    std::string_view paper;
    std::string_view how;               ///< a sentence or two
    std::string_view precomputes = "";  ///< before the first picture; empty if nothing
    /// What may change without computing that again: a claim that a test holds against pictures.
    Changes keeps = {.view = true};
    std::vector<Parameter> parameters = {};  ///< scalar, integer and choice
    /// The settings at which comparisons run it, separated by '|', each "name=value name=value";
    /// all else is as by default. Empty: the defaults alone.
    std::string_view variants = "";
    /// Takes media that vary in space; others leave shapes with such a medium alone.
    bool takes_volumes = false;
    /// It is complete simulation: what others are measured against.
    bool simulates = false;
    /// Makes it for a scene all of whose translucent shapes are its own or, for techniques that
    /// path tracing shows (path_technique.h) or that are made in real time, others of that kind. Throws InputError, with the
    /// place in the file where there is one, for what it cannot do, and Stopped if `work` says so.
    TechniquePtr (*prepare)(const TechniqueInput& input, const Work& work) = nullptr;
    /// Of techniques that path tracing shows: makes one shape's matter. Else null.
    TranslucencyPtr (*below)(const ShapeInput& input) = nullptr;
    /// Of techniques in real time: makes one shape's, on the device. Else null.
    std::unique_ptr<RealtimeTechnique> (*realtime)(const RealtimeInput& input) = nullptr;
};

}  // namespace nacre
