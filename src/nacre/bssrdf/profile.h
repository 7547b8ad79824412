#pragma once
// The radial diffusion profiles by name, in double precision: what scenes, the command line, tables
// (radial_table.h) and comparisons use. Who knows the model at compile time uses its own header.
#include <memory>
#include <string_view>
#include <vector>

#include "nacre/bssrdf/medium.h"
#include "nacre/catalogue/catalogue.h"
#include "nacre/catalogue/settings.h"

namespace nacre {

class RadialProfile;

/// What a profile says of itself.
struct ProfileDescription {
    std::string_view name;   ///< in scene files and on the command line
    std::string_view title;  ///< as the field says
    std::string_view authors;
    int year = 0;
    std::string_view paper;
    std::string_view formula;            ///< as text, one line a string line
    std::string_view single_scattering;  ///< whether and how light scattered once is included
    std::vector<Parameter> options = {};
    std::vector<std::string_view> errata = {};
    /// Its total depends on the reduced albedo and eta, so that an albedo can be inverted.
    bool invertible = true;
    /// Makes it of a checked medium and the values of its options.
    std::unique_ptr<RadialProfile> (*make)(const ProfileMedium& medium,
                                           const ParameterValues& options) = nullptr;
};

/// How much of the light that entered a flat, homogeneous half space at a point leaves at distance
/// r (mm), per area (mm^-2). Values are never negative.
class RadialProfile {
  public:
    virtual ~RadialProfile() = default;

    virtual const ProfileDescription& description() const = 0;
    /// R(r) for r > 0.
    virtual double eval(double r) const = 0;
    /// Integral of R over the disk of radius r >= 0.
    virtual double cumulative(double r) const = 0;
    /// Over the plane.
    virtual double total() const = 0;
    /// Whether light that was scattered exactly once is part of it.
    virtual bool includes_single_scattering() const = 0;
    /// A length (mm) on which R varies near the source.
    virtual double scale() const = 0;
    /// Effective transport coefficient, mm^-1: far away R falls as e^(-sigma_tr r). 0 if unknown.
    virtual double sigma_tr() const = 0;
};

/// All of them.
const Catalogue<ProfileDescription>& profiles();

/// Options are set as those of reflectance models: parse_settings("moments=fit kappa=off"). Throws
/// InputError as profiles().find and ParameterValues do, and for a medium out of range.
std::unique_ptr<RadialProfile> make_profile(std::string_view name, const ProfileMedium& medium,
                                            const Settings& options = {});

}  // namespace nacre
