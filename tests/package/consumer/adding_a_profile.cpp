// The profile of docs/adding-a-profile.md in a project of its own: made of settings, its closed
// forms against quadrature, and tabulated as renderers do.
#include <nacre/bssrdf/radial_integral.h>
#include <nacre/bssrdf/radial_table.h>

#include <cstdio>

#include "gaussian_profile.h"

int main() {
    const nacre::ProfileDescription& gaussian = example::gaussian_profile();
    const auto medium = nacre::ProfileMedium::reduced(2., 0.01, 1.3);  // mm^-1
    const auto made = [&](const char* settings) {
        const nacre::Settings options = nacre::parse_settings(settings);
        return gaussian.make(medium,
                             nacre::ParameterValues(gaussian.name, gaussian.options, options));
    };
    const auto profile = made("width=2 total=all");
    const auto value = [&](double r) { return profile->eval(r); };
    bool good = profile->total() == 1.;
    for (const double r : {0.1, 1., 3.}) {
        const double within = nacre::disk_integral(r, profile->scale(), value);
        std::printf("gaussian width=2: %.6f of the light leaves within %g mm\n", within, r);
        good = good && std::abs(within - profile->cumulative(r)) < 1e-7;
    }
    const nacre::RadialTable table(*profile);
    good = good && std::abs(table.total() - 1.f) < 1e-4f && table.sample(0.5f) > 0.f;
    try {
        made("width=0");
        good = false;
    } catch (const nacre::InputError& error) {
        std::printf("%s\n", error.what());
    }
    return good ? 0 : 1;
}
