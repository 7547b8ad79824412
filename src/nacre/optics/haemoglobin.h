#pragma once
// How strongly haemoglobin absorbs, with and without oxygen.

namespace nacre {

/// Range of the table, nm.
inline constexpr int haemoglobin_first = 350, haemoglobin_last = 850;

/// Decadic molar extinction of the molecule of four haems, cm^-1 / (mol / L).
struct HaemoglobinExtinction {
    double oxygenated, deoxygenated;
};

/// At a wavelength within the table, linear between its points every 2 nm; throws InputError
/// outside. Source: Prahl 1998, Tabulated Molar Extinction Coefficient for Hemoglobin in Water,
/// omlc.org, compiled from data of Gratzer and of Kollias.
HaemoglobinExtinction haemoglobin_extinction(double nm);

}  // namespace nacre
