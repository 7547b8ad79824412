#pragma once
// What a real gonioreflectometer would have reported of a surface whose true reflectance was found
// by the virtual one, and what it would have missed.
//
// An instrument reaches a part of the hemisphere, sees the mean over the solid angles of its
// source and detector, adds noise, and knows nothing of light that passes. Here that is a filter
// over the bins of a fine measurement: it changes nothing that is narrower than a bin.
#include <string>
#include <string_view>
#include <vector>

#include "nacre/catalogue/catalogue.h"
#include "nacre/catalogue/settings.h"
#include "nacre/goniometer/measurement_set.h"

namespace nacre {

/// What a kind of instrument says of itself.
struct InstrumentDescription {
    std::string_view name;
    std::string_view title;
    std::string_view meaning;  ///< what it was; which defaults are known and which assumed
    std::vector<Parameter> parameters;
    std::vector<std::string_view> references = {};
};
const Catalogue<InstrumentDescription>& instruments();

struct Instrument {
    std::string name;
    double incidence, exit;  ///< largest polar angles, degrees
    double blocked;  ///< half-angle about the source that the detector does not reach, degrees
    double source, detector;  ///< half-angles of the cones that they fill, degrees
    double noise;             ///< standard deviation, a share of the value
    double floor;             ///< standard deviation, sr^-1
    bool isotropic;           ///< it measures at one azimuth of incidence
    int seed;
};

/// "foo detector=2": one of the list, with its parameters. Throws InputError.
Instrument make_instrument(std::string_view text);

/// Of one incidence. The last three are shares of all the light that leaves the surface, in the
/// mean over the lanes that count.
struct InstrumentReading {
    bool reached = false;      ///< whether light can come from there at all
    std::vector<Vec3d> value;  ///< of each bin above, sr^-1, by lane; NaN: not seen
    double outside = 1.;       ///< what leaves to where it does not look
    double blur = 0.;          ///< sum over bins of what source and detector change
    double noise = 0.;         ///< the same of noise
};

/// Throws InputError if an isotropic instrument is to measure several azimuths of incidence.
void check_azimuths(const Instrument& instrument, const MeasurementSet& set);

/// Of each incidence, after check_azimuths. The same numbers for any number of threads.
std::vector<InstrumentReading> read_instrument(const Instrument& instrument,
                                               const MeasurementSet& set);

/// Its table, as csv_of writes it: nan where it does not reach.
std::string csv_of(const MeasurementSet& set, const std::string& instrument,
                   const std::vector<InstrumentReading>& readings);

}  // namespace nacre
