#include "apps/cli/profile_medium.h"

#include <CLI/CLI.hpp>

#include "apps/cli/number_option.h"
#include "nacre/layers/skin.h"
#include "nacre/math/error.h"
#include "nacre/optics/media.h"
#include "nacre/reflectance/registry.h"
#include "nacre/scene/load.h"
#include "nacre/text/names.h"

namespace nacre::cli {
namespace {

constexpr std::string_view bands[] = {"red", "green", "blue"};

std::size_t band_of(const std::string& text) {
    if (text.empty()) return 1;
    for (std::size_t i = 0; i < 3; ++i)
        if (text == bands[i] || text == bands[i].substr(0, 1)) return i;
    throw InputError("--channel: " + unknown_name("band", text, {"red", "green", "blue"}));
}

}  // namespace

void add_medium_options(CLI::App& app, MediumOptions& o) {
    app.add_option("--material", o.material, "a measured medium, or skin; see 'nacre models'");
    app.add_option("--channel", o.channel, "band of the material: r, g or b (g)");
    add_number(app, "--sigma-s", o.sigma_s, any_number, "scattering, mm^-1, instead of a material");
    add_number(app, "--sigma-s-prime", o.sigma_s_prime, any_number,
               "reduced scattering, mm^-1, instead of it");
    add_number(app, "--sigma-a", o.sigma_a, any_number, "absorption, mm^-1 (0)");
    add_number(app, "--g", o.g, any_number, "mean cosine of a scattering (0)");
    add_number(app, "--eta", o.eta, any_number,
               "index of refraction over that outside (the material's; 1.3)");
}

ProfileMedium profile_medium(const MediumOptions& o) {
    const bool named = !o.material.empty();
    if (named + o.sigma_s.has_value() + o.sigma_s_prime.has_value() != 1)
        throw InputError("give one of --material, --sigma-s and --sigma-s-prime");
    if (named && o.sigma_a) throw InputError("--sigma-a is the material's; leave it out");
    if (!named && !o.channel.empty()) throw InputError("--channel belongs to --material");
    ProfileMedium m{o.sigma_s.value_or(1.), o.sigma_a.value_or(0.), o.g.value_or(0.),
                    o.eta.value_or(1.3)};
    double reduced = o.sigma_s_prime.value_or(0.);
    if (named) {
        const std::size_t band = band_of(o.channel);
        if (const MeasuredMedium* measured = translucent_material(o.material)) {
            // Through the shortest decimal: the table is of floats, 2.62 is meant.
            const auto exact = [](float x) { return std::stod(fmt::format("{}", x)); };
            reduced = exact(measured->sigma_s_prime[band]);
            m.sigma_a = exact(measured->sigma_a[band]);
            m.eta = o.eta.value_or(exact(measured->eta));
        } else {
            const Layer skin = skin_coefficients(SkinParameters{}, band_wavelengths()[int(band)]);
            m = {skin.sigma_s, skin.sigma_a, o.g.value_or(skin.g), o.eta.value_or(skin.eta)};
            reduced = skin.sigma_s * (1. - skin.g);
        }
    }
    if (o.sigma_s) return m;
    ProfileMedium unscaled = m;
    unscaled.sigma_s = 1.;
    check(unscaled);  // g, by which the next line divides
    m.sigma_s = reduced / (1. - m.g);
    return m;
}

std::string medium_title(const ProfileMedium& m, const MediumOptions& o) {
    std::string who;
    if (!o.material.empty())
        who = fmt::format("{}, {} band: ", o.material, bands[band_of(o.channel)]);
    return fmt::format("{}sigma_s {:.5g}, sigma_a {:.5g} mm^-1, g {:.4g}, eta {:.4g}", who,
                       m.sigma_s, m.sigma_a, m.g, m.eta);
}

}  // namespace nacre::cli
