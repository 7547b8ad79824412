#pragma once
// Gaussian profile: light leaves around where it entered as a blur of texture space would have it.
//
//   R(r) = A exp(-r^2 / (2 v)) / (2 pi v),   v = (width / sigma_t')^2
//
// A is the albedo of the half space, by the fit of Chiang, Kutz, Burley 2016 that the index is no
// part of, or all that entered.
#include <nacre/bssrdf/chiang2016.h>
#include <nacre/bssrdf/profile.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace example {

enum class Total { medium, all };

const nacre::ProfileDescription& gaussian_profile();

class GaussianProfile final : public nacre::RadialProfile {
  public:
    GaussianProfile(const nacre::ProfileMedium& m, double width, Total total)
        : variance_(std::pow(width / m.sigma_t_prime(), 2)),
          total_(total == Total::all ? 1. : nacre::chiang2016_surface_albedo(m.reduced_albedo())) {}

    const nacre::ProfileDescription& description() const override { return gaussian_profile(); }
    double eval(double r) const override {
        return total_ * std::exp(-r * r / (2. * variance_)) / (2. * std::numbers::pi * variance_);
    }
    double cumulative(double r) const override {
        return -total_ * std::expm1(-r * r / (2. * variance_));
    }
    double total() const override { return total_; }
    bool includes_single_scattering() const override { return true; }
    double scale() const override { return std::sqrt(variance_); }
    double sigma_tr() const override { return 0.; }  // it falls faster than any exponential

  private:
    double variance_, total_;
};

inline const nacre::ProfileDescription& gaussian_profile() {
    static const nacre::ProfileDescription description{
        .name = "gaussian",
        .title = "Gaussian",
        .authors = "G. Borshukov, J. P. Lewis",
        .year = 2003,
        .paper = "Realistic Human Face Rendering for The Matrix Reloaded, SIGGRAPH Sketches",
        .formula = "R = A exp(-r^2 / (2 v)) / (2 pi v),   v = (width / sigma_t')^2",
        .single_scattering = "included",
        .options = {{.name = "width",
                     .meaning = "standard deviation, in transport mean free paths",
                     .high = 100.,
                     .above_low = true,
                     .otherwise = 1.},
                    nacre::choice_parameter(
                        "total", "how much leaves",
                        {{"medium", "the albedo of the half space"}, {"all", "what entered"}})},
        .make = [](const nacre::ProfileMedium& m,
                   const nacre::ParameterValues& o) -> std::unique_ptr<nacre::RadialProfile> {
            return std::make_unique<GaussianProfile>(m, o.number("width"),
                                                     o.choice<Total>("total"));
        }};
    return description;
}

}  // namespace example
