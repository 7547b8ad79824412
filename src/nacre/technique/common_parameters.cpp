#include "nacre/technique/common_parameters.h"

#include "nacre/bssrdf/profile.h"

namespace nacre {

Parameter profile_parameter(std::initializer_list<std::string_view> only) {
    std::vector<Choice> choices;
    for (const ProfileDescription* p : profiles())
        if (only.size() == 0 || std::ranges::find(only, p->name) != only.end())
            choices.push_back({p->name, p->title});
    return choice_parameter("profile", "R(r), the diffusion profile", std::move(choices));
}

Parameter exit_fresnel_parameter() {
    return choice_parameter("exit_fresnel",
                            "the transmittance at the exit, over its mean or as in the paper",
                            {{"normalised", "over its mean: what the profile says leaves does"},
                             {"paper", "as it is (Jensen et al. 2001): some of it is lost"}});
}

Parameter single_scattering_parameter() {
    return choice_parameter(
        "single_scattering", "whether light scattered once is added",
        {{"auto", "to profiles that leave it out"}, {"on", "to any profile"}, {"off", "to none"}});
}

float exit_scale(const ShapeInput& in) {
    const bool paper = std::ranges::find(in.options.parameters(), "exit_fresnel",
                                         &Parameter::name) != in.options.parameters().end() &&
                       in.options.word("exit_fresnel") == "paper";
    return float(1. / (paper ? 1. : in.boundary.mean_transmittance()));
}

std::shared_ptr<const ProfileTables> profile_tables(const ShapeInput& in) {
    return std::make_shared<ProfileTables>(in.medium(), in.eta(), in.profile, Bands(in.scene.mode),
                                           in.rough_return, in.work);
}

}  // namespace nacre
