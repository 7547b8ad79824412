#pragma once
// Human skin as a stack of layers, and as one medium.
#include "nacre/layers/layer.h"
#include "nacre/optics/tissue.h"

namespace nacre {

/// One layer of skin: baseline tissue that holds melanosomes and blood.
struct SkinLayer {
    double thickness;        ///< mm, > 0; only the hypodermis may be infinite
    double eta;              ///< index of refraction, in [1, 2]
    double melanin = 0.;     ///< share of melanosomes by volume, in [0, 1]
    double blood = 0.;       ///< share of blood by volume, in [0, 1]; with melanin at most 1
    double scattering = 1.;  ///< factor on the model's reduced scattering, > 0
};

/// Five layers. Thicknesses and blood are BioSpec's (Krishnaswamy and Baranoski 2004), read from
/// the author's later renderer rather than from the paper, which has 1.25 mm for some reticular
/// dermis; people and places differ more (epidermis 0.027 to 0.15 mm, dermis 0.6 to 3 mm). Melanin
/// is that of light skin. The hypodermis reaches 30 mm, so that no light sees its end; for lack of
/// a reliable fit it has the reticular dermis's blood and scattering, only fat's index. Bilirubin
/// and carotene are left out.
struct SkinParameters {
    SkinLayer stratum_corneum{.thickness = 0.01, .eta = tissue_index::stratum_corneum};
    SkinLayer epidermis{.thickness = 0.1, .eta = tissue_index::epidermis, .melanin = 0.03};
    SkinLayer papillary_dermis{
        .thickness = 0.2, .eta = tissue_index::papillary_dermis, .blood = 0.012};
    SkinLayer reticular_dermis{
        .thickness = 1.8, .eta = tissue_index::reticular_dermis, .blood = 0.009};
    SkinLayer hypodermis{.thickness = 30., .eta = tissue_index::fat, .blood = 0.009};
    double oxygenation = 0.75;  ///< share of the haemoglobin that carries oxygen, in [0, 1]
    double haemoglobin = 150.;  ///< g in a litre of blood, >= 0
    double eumelanin = 1.;      ///< its share of the melanin, for MelaninModel::donner_jensen
    MelaninModel melanin_model = MelaninModel::exponent_3_33;
    BaselineModel baseline_model = BaselineModel::exponential;
    SkinScattering scattering_model = SkinScattering::jacques;
};

/// Throws InputError, naming layer, parameter, value and range, unless every number lies in its
/// range.
void check(const SkinParameters& skin);

/// The layers at a wavelength from 350 to 850 nm, top first, between air and more fat. Scattering
/// is sigma_s' / (1 - g) with g of `skin_anisotropy`. Throws as `check`, and for other wavelengths.
LayerStack skin_stack(const SkinParameters& skin, double nm);

/// An infinitely thick layer that stands for all of them where a method takes one medium only. Its
/// scattering is that of the reticular dermis, where light spreads; its absorption is such that it
/// returns as much diffuse light as the layers do in diffusion theory, the melanin above being
/// passed twice. Its index is the epidermis's: the thin stratum corneum changes what the surface
/// mirrors, but not which light is caught inside.
///
/// What is lost: the indices between the layers; that light spreads in the dermis far below the
/// melanin (here all of its path is darkened, so blurring is too short, the more so the darker the
/// skin); and the end of the hypodermis. How much of the colour is lost was measured against
/// adding-doubling of the default layers under diffuse light, from 400 to 700 nm, with papillary
/// blood of 0.012 and 0.05 and the deeper in proportion. With one index everywhere and isotropic
/// scattering the reflectance is within 0.021 for melanin up to 0.43. With the layers' indices, and
/// this medium behind a boundary of its own, it is too low by up to 0.018 without melanin, 0.027
/// for 0.013, 0.043 for 0.03, 0.062 for 0.06 and at worst 0.078, for 0.15 in the red. Of that some
/// 0.02 is mirrored by the stratum corneum; the rest is presumably light that refraction has turned
/// towards the normal, and that crosses the melanin by a shorter way than diffuse light.
///
/// How: let Y = flux / fluence going down, which is D kappa = sqrt(sigma_a / (3 sigma_t')) in a
/// half space and turns from the bottom of a layer to its top into
///   y (Y + y tanh(kappa d)) / (y + Y tanh(kappa d)),  y = D kappa of the layer,
/// as D and kappa = sqrt(3 sigma_a sigma_t') of classical diffusion have it. The half space with
/// the Y of the surface has the reduced albedo 1 - 3 Y^2.
Layer skin_coefficients(const SkinParameters& skin, double nm);

}  // namespace nacre
