// <medium type="skin">: human skin as one medium, by wavelength. What that leaves out is told in
// layers/skin.h.
#include "nacre/layers/skin.h"

#include "nacre/scene/media/types.h"

namespace nacre {

namespace {

/// `blood` is that of the papillary dermis; the layers below keep their proportion to it.
void set_blood(SkinParameters& skin, double blood) {
    const double factor = blood / skin.papillary_dermis.blood;
    for (SkinLayer* layer : {&skin.papillary_dermis, &skin.reticular_dermis, &skin.hypodermis})
        layer->blood *= factor;
}

SkinParameters get_skin(const SceneNode& node) {
    SkinParameters skin;
    const auto share = [&](const char* name, double otherwise) {
        return node.get_float_in(name, otherwise, 0.0, 1.0);
    };
    skin.epidermis.melanin = share("melanin", skin.epidermis.melanin);
    set_blood(skin, share("blood", skin.papillary_dermis.blood));
    skin.oxygenation = share("oxygenation", skin.oxygenation);
    if (node.get_choice("optics", {"jacques", "donner_jensen"}) == "donner_jensen") {
        skin.melanin_model = MelaninModel::donner_jensen;
        skin.scattering_model = SkinScattering::donner_jensen;
        skin.eumelanin = share("eumelanin", skin.eumelanin);
    } else if (node.has("eumelanin")) {
        node.fail_at("eumelanin",
                     "'eumelanin' is a parameter of 'optics' donner_jensen; jacques has one "
                     "melanin");
    }
    return skin;
}

}  // namespace

void set_skin_coefficients(const SceneNode& node, Medium& medium) {
    constexpr float step = 5.f;  // nm: several points to each band of haemoglobin
    const SkinParameters skin = get_skin(node);
    std::vector<float> wavelengths, scattering, absorption;
    for (float nm = visible_min; nm <= visible_max; nm += step) {
        const Layer matter = skin_coefficients(skin, nm);
        // Reduced coefficients, by the similarity relation for whichever phase function there is.
        const double similar = (1. - matter.g) / (1. - medium.phase.mean_cosine());
        wavelengths.push_back(nm);
        scattering.push_back(static_cast<float>(matter.sigma_s * similar));
        absorption.push_back(static_cast<float>(matter.sigma_a));
    }
    const auto spectrum = [&](std::vector<float> values) {
        return make_tabulated(wavelengths, std::move(values), SpectrumRole::unbounded);
    };
    set_scattering_and_absorption(medium, spectrum(std::move(scattering)),
                                  spectrum(std::move(absorption)));
}

}  // namespace nacre
