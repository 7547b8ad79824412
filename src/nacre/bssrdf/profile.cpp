#include "nacre/bssrdf/profile.h"

#include "nacre/bssrdf/profile_models.h"

namespace nacre {

const Catalogue<ProfileDescription>& profiles() {
    static const std::array<const ProfileDescription*, 7> listed{
        &dipole_profile(),      &better_dipole_profile(), &quantised_diffusion_profile(),
        &photon_beam_profile(), &normalised_profile(),    &gaussian_sum_profile(),
        &multipole_profile()};
    static const Catalogue<ProfileDescription> all("diffusion profile", listed);
    return all;
}

std::unique_ptr<RadialProfile> make_profile(std::string_view name, const ProfileMedium& medium,
                                            const Settings& options) {
    const ProfileDescription& profile = profiles().find(name);
    check(medium);
    return profile.make(medium, ParameterValues(profile.name, profile.options, options));
}

}  // namespace nacre
