// Wrong parameters of the models of facets, Schlick's, He's and Lafortune's: exact messages.
#include "nacre/math/error.h"
#include "nacre/reflectance/registry.h"

namespace nacre {

TEST(WrongParameters, AreNamedWithTheirRange) {
    struct Case {
        const char *model, *settings, *message;
    };
    const Case cases[] = {
        {"cook_torrance", "m=0",
         "cook_torrance: m = 0 is out of range: must lie within (0, 100000]"},
        {"cook_torrance", "m=-0.1",
         "cook_torrance: m = -0.1 is out of range: must lie within (0, 100000]"},
        {"cook_torrance", "m=nan",
         "cook_torrance: m = nan is out of range: must lie within (0, 100000]"},
        {"cook_torrance", "kd=0.6 ks=0.5",
         "cook_torrance: kd + ks = 1.1 is out of range: must lie within [0, 1], lest energy appear "
         "from nowhere"},
        {"cook_torrance", "terms=4",
         "cook_torrance: terms = 4 is out of range: must lie within [1, 3]"},
        {"cook_torrance", "terms=1.5", "cook_torrance: terms = 1.5 must be a whole number"},
        {"cook_torrance", "parallel=1.5",
         "cook_torrance: parallel = 1.5 is out of range: must lie within [0, 1]"},
        {"torrance_sparrow", "n=0",
         "torrance_sparrow: n = 0 is out of range: must lie within (0, 10]"},
        {"blinn_torrance_sparrow", "beta=90",
         "blinn_torrance_sparrow: beta = 90 is out of range: must lie within (0, 89]"},
        {"ggx", "alpha=0", "ggx: alpha_u = 0 is out of range: must lie within (0, 1.5]"},
        {"schlick", "r=0", "schlick: r = 0 is out of range: must lie within (0, 1]"},
        {"schlick", "p=1.2", "schlick: p = 1.2 is out of range: must lie within (0, 1]"},
        {"schlick", "c=2", "schlick: c = 2 is out of range: must lie within [0, 1]"},
        {"schlick_ct", "m=1.1", "schlick_ct: m = 1.1 is out of range: must lie within (0, 1]"},
        {"he_torrance", "sigma0=0",
         "he_torrance: sigma0 = 0 is out of range: must lie within (0, 20]"},
        {"he_torrance", "tau=-1",
         "he_torrance: tau = -1 is out of range: must lie within (0, 1000]"},
        {"lafortune", "n=-1", "lafortune: n = -1 is out of range: must lie within [0, 10000]"},
        {"lafortune", "ks2=-0.1",
         "lafortune: ks2 = -0.1 is out of range: must lie within [0, 1000]"},
    };
    for (const Case& c : cases) {
        std::string message;
        try {
            make_model(c.model, parse_settings(c.settings));
        } catch (const InputError& e) {
            message = e.what();
        }
        EXPECT_EQ(message, c.message) << c.settings;
    }
}

TEST(WrongParameters, UnknownNamesGetASuggestion) {
    const auto message = [](const char* model, const char* settings) {
        try {
            make_model(model, parse_settings(settings));
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_NE(message("cook_torrance", "masking=vcavty").find("did you mean 'v_cavity'?"),
              std::string::npos)
        << message("cook_torrance", "masking=vcavty");
    EXPECT_NE(message("he_torrance", "sigma=0.1").find("did you mean 'sigma0'?"),
              std::string::npos);
    EXPECT_NE(message("lafortune", "ks4=0.1").find("unknown parameter"), std::string::npos)
        << message("lafortune", "ks4=0.1");
}

}  // namespace nacre
