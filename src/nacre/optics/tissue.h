#pragma once
// What human tissue does to light: absorption and reduced scattering in mm^-1 at a wavelength in nm
// from 350 to 850, the range of the haemoglobin table. Every function throws InputError outside it,
// and for fractions outside [0, 1]. Sources give cm^-1; a tenth of it is meant here.
//
// The working model is that of Jacques 1998, Skin Optics, OMLC News (omlc.org), with the variant of
// Donner and Jensen 2006, A Spectral BSSRDF for Shading Human Skin, EGSR, by name. These are fits
// through scattered measurements: melanosomes alone vary ten-fold between people.

namespace nacre {

/// Tissue without blood and melanin.
enum class BaselineModel {
    exponential,  ///< 0.244 + 85.3 exp(-(nm - 154) / 66.2) cm^-1: Jacques, bloodless rat skin
    power,        ///< 7.84e8 nm^-3.255 cm^-1: Saidi 1994, neonatal skin
};
double baseline_absorption(double nm, BaselineModel model = BaselineModel::exponential);

/// The inside of melanosomes. Two fits of the same author are in circulation; they differ by 2 % at
/// 500 nm.
enum class MelaninModel {
    exponent_3_33,  ///< 6.6e11 nm^-3.33 cm^-1: Jacques, Skin Optics, January 1998
    exponent_3_48,  ///< 1.70e12 nm^-3.48 cm^-1: Jacques, Melanosome absorption, July 1998
    donner_jensen,  ///< eumelanin as exponent_3_33, pheomelanin 2.9e15 nm^-4.75 cm^-1, by shares
};
/// `eumelanin` is its share of the melanin; the other models ignore it.
double melanin_absorption(double nm, MelaninModel model = MelaninModel::exponent_3_33,
                          double eumelanin = 1.);

/// Whole blood, of whose haemoglobin the share `oxygenation` carries oxygen (0.6 to 0.95 in skin):
/// 2.303 c / 64500 (S e_HbO2 + (1 - S) e_Hb), with c the grams of haemoglobin in a litre and 2.303
/// for ln 10 as in Prahl's compilation (see haemoglobin.h).
double blood_absorption(double nm, double oxygenation, double haemoglobin = 150.);

/// A share `melanin` of melanosomes in baseline tissue: 0.013 to 0.063 in light, 0.11 to 0.16 in
/// medium, 0.18 to 0.43 in dark skin.
double epidermis_absorption(double nm, double melanin);

/// A share `blood` of blood in baseline tissue: 0.002 to 0.07.
double dermis_absorption(double nm, double blood, double oxygenation);

enum class SkinScattering {
    /// Mie + Rayleigh scattering, 2e5 nm^-1.5 + 2e12 nm^-4 cm^-1, in epidermis and dermis.
    jacques,
    /// 147.4 nm^-0.22 + 2.2e12 nm^-4 cm^-1 in the epidermis and half of it in the dermis. That half
    /// is the fit of Bashkatov et al. 2005 to skin, so the constants are right; that the epidermis
    /// scatters twice as much is the authors' choice.
    donner_jensen,
};
/// Reduced scattering (1 - g) sigma_s.
double epidermis_reduced_scattering(double nm, SkinScattering model = SkinScattering::jacques);
double dermis_reduced_scattering(double nm, SkinScattering model = SkinScattering::jacques);

/// Mean cosine of a scattering, 0.62 + 0.00029 nm: van Gemert et al. 1989, as given by Jacques.
double skin_anisotropy(double nm);

/// Indices of refraction over air. The first four are those of BioSpec (Krishnaswamy and Baranoski
/// 2004, A Biophysically-Based Spectral Model of Light Interaction with Human Skin, Eurographics),
/// fat that of Meglinski and Matcher 2002. Other sources give the dermis 1.37 to 1.39.
namespace tissue_index {
inline constexpr double stratum_corneum = 1.55, epidermis = 1.4, papillary_dermis = 1.36,
                        reticular_dermis = 1.38, fat = 1.44;
}

}  // namespace nacre
