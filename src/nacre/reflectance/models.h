#pragma once
// The list of models. A new model is one line here and one line in the file of its family
// (family_*.cpp), beside its own header; docs/adding-a-model.md walks through it.

// clang-format off
#define NACRE_MODELS(X)      \
    X(Lambert)               \
    X(OrenNayar)             \
    X(Eon)                   \
    X(Phong)                 \
    X(BlinnPhong)            \
    X(TorranceSparrow)       \
    X(BlinnTorranceSparrow)  \
    X(CookTorrance)          \
    X(GgxSmith)              \
    X(MetallicRoughness)     \
    X(Ward)                  \
    X(Schlick)               \
    X(SchlickCt)             \
    X(HeTorrance)            \
    X(Lafortune)             \
    X(PoulinFournier)
// clang-format on

namespace nacre {

#define NACRE_DECLARE_MODEL(Model)       \
    template <class D, class P, class S> \
    struct Model;
NACRE_MODELS(NACRE_DECLARE_MODEL)
#undef NACRE_DECLARE_MODEL

}  // namespace nacre
