// nacre check --vectors on files of scattering vectors.
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;

class ScatteringVectors : public test::CommandLine {
  protected:
    /// A few of each group of ../shared/reference/scattering_vectors.json.
    static json few() {
        std::ifstream in(NACRE_SOURCE_DIR "/tests/cli/data/scattering_vectors.json");
        return json::parse(in);
    }
    Outcome check(const json& vectors) const {
        std::ofstream(folder_ / "v.json") << vectors.dump();
        return nacre("check --vectors v.json");
    }
    /// The line of the table that begins with the name.
    static std::string line_of(const std::string& name, const std::string& text) {
        const std::size_t at = text.find("\n" + name + " ");
        return at == text.npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    }
};

TEST_F(ScatteringVectors, EveryGroupIsAnswered) {
    const json all = few();
    const Outcome r = check(all);
    EXPECT_EQ(r.code, 0) << r.out;
    EXPECT_EQ(r.out.find("WRONG"), std::string::npos) << r.out;
    for (const auto& [name, group] : all.items()) {
        if (name == "meta") continue;
        const std::string line = line_of(name, r.out);
        ASSERT_FALSE(line.empty()) << name;
        EXPECT_GT(std::stoi(line.substr(name.size())), 0) << line;
    }
    EXPECT_EQ(r.out.find("not covered"), std::string::npos) << r.out;
}

// One number of each group, moved by a multiple of the group's tolerance, is found and named.
TEST_F(ScatteringVectors, AWrongNumberIsFoundInEveryGroup) {
    const struct {
        const char *group, *place, *where;
        double factor;  ///< or what is added to it, if below 0.5
    } cases[] = {
        {"phase", "/functions/0/value/3", "rayleigh 0 3", 1. + 1e-9},
        {"fresnel", "/directional/0/R_inside/2", "n = 1.1, 30 degrees, inside", 1. + 1e-9},
        {"fresnel", "/diffuse/0/A_exact", "eta = 1.3 A_exact", 1. + 1e-9},
        {"dipole", "/1/Rd/4", "Apple G Rd at r = 0.2", 1. + 1e-8},
        {"better_dipole", "/0/R_total", "sigma_s' 1 sigma_a 0.01 eta 1.3 fit R_total", 1. + 1e-8},
        {"photon_beam_diffusion", "/0/single/1", "sigma_s 1 g 0 single at r = 0.2", 1. + 1e-5},
        {"directional_dipole", "/1/S_d", "row 1", 1. + 1e-8},
        {"normalized_diffusion", "/0/r_of_xi/2", "A = 0.1 r_of_xi at xi = 0.5", 1. + 1e-9},
        {"chiang2016", "/1/sigma_t", "A = 0.05, d = 1 sigma_t", 1. + 1e-9},
        {"kubelka_munk", "/stacks/0/R_bottom", "stack 0 R_bottom", 1. + 1e-9},
        {"kubelka_munk", "/saunderson/0/k2", "Saunderson 1.3 R 0.1 k2", 1. + 1e-9},
        {"hanrahan_krueger", "/1/samples/3/f_t", "g -0.3 tau 0.5 n 1.5 theta_i 10 theta_o 65 f_t",
         1. + 1e-8},
        {"slab_adding_doubling", "/0/incidence/2/R_total", "stack 0 theta_i 40 R_total", 2e-8},
        {"semi_infinite", "/0/R_diffuse_incidence", "albedo 0.2 g 0 n 1 R_diffuse_incidence", 2e-8},
        {"monte_carlo", "/0/R_diffuse", "run 0 R_diffuse", 1.02},
        {"monte_carlo", "/0/R_of_r_mean_per_area/2", "run 0 ring 2", 1.1},
        {"diffusion_pde", "/slab_two_layer/0/phi/3", "slab 2 + 3 x 2", 1.02},
        {"dipole_triangle_integrals", "/0/integral", "row 0", 1. + 1e-7},
        {"skin_jacques", "/0/blood_mua_cm", "400 nm, melanin 0.013 blood_mua_cm", 1. + 1e-9},
        {"materials_jensen2001", "/Marble/eta", "Marble eta", 1. + 1e-6},
        {"published_anchors", "/2/value", "H(1)", 2e-4},
        {"published_anchors", "/1/oracle", "(oracle)", 1e-6},
    };
    for (const auto& c : cases) {
        const std::string at = fmt::format("{} {}", c.group, c.place);
        json wrong{{c.group, few().at(c.group)}};
        ASSERT_EQ(check(wrong).code, 0) << at;
        json& number = wrong[c.group][json::json_pointer(c.place)];
        ASSERT_TRUE(number.is_number()) << at;
        const double value = number;
        number = c.factor < 0.5 ? value + c.factor : value * c.factor;
        const Outcome r = check(wrong);
        EXPECT_EQ(r.code, 1) << at << r.out;
        EXPECT_NE(r.out.find("WRONG at "), std::string::npos) << at << r.out;
        EXPECT_NE(r.out.find(c.where), std::string::npos) << at << r.out;
    }
}

TEST_F(ScatteringVectors, AFileIsToldByItsKeys) {
    EXPECT_EQ(
        check({{"colours", 1}}).err,
        "nacre: 'v.json' has neither \"models\", groups of reflectance vectors by name, nor a "
        "known group of scattering vectors\n");
    const Outcome r = check({{"phase", {{"functions", {{{"name", "hg"}}}}}}});
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(r.err.starts_with("nacre: group 'phase' of 'v.json': ")) << r.err;
    EXPECT_EQ(check({{"phase", {{"functions", {{{"name", "hgg"}, {"param", 0}}}}}}}).err,
              "nacre: phase vectors: unknown function 'hgg'\n");
    EXPECT_TRUE(check({{"photon_beam_diffusion",
                        {{{"sigma_s", -1.}, {"sigma_a", 0.}, {"g", 0.}, {"eta", 1.3}}}}})
                    .err.starts_with("nacre: translucent medium: sigma_s = -1 must be"));
}

// Rings need not be multiples of the first: those of the file, some of them joined.
TEST_F(ScatteringVectors, RingsMayHaveAnyWidths) {
    json row = few()["monte_carlo"][0];
    const auto edges = row["r_edges"].get<std::vector<double>>();
    const auto mean = row["R_of_r_mean_per_area"].get<std::vector<double>>();
    const auto error = row["R_of_r_se"].get<std::vector<double>>();
    const std::vector<double> joined = {0., 1., 1.5, 4.};
    json means = json::array(), errors = json::array();
    for (std::size_t k = 0; k + 1 < joined.size(); ++k) {
        double sum = 0., square = 0., area = 0.;
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            if (edges[i] < joined[k] || edges[i + 1] > joined[k + 1]) continue;
            const double a = edges[i + 1] * edges[i + 1] - edges[i] * edges[i];
            sum += a * mean[i];
            square += a * a * error[i] * error[i];
            area += a;
        }
        ASSERT_NEAR(area, joined[k + 1] * joined[k + 1] - joined[k] * joined[k], 1e-12);
        means.push_back(sum / area);
        errors.push_back(std::sqrt(square) / area);
    }
    row["r_edges"] = joined;
    row["R_of_r_mean_per_area"] = means;
    row["R_of_r_se"] = errors;
    const Outcome r = check({{"monte_carlo", {row}}});
    EXPECT_EQ(r.code, 0) << r.out;
    row["R_of_r_mean_per_area"][1] = 1.1 * means[1].get<double>();
    EXPECT_EQ(check({{"monte_carlo", {row}}}).code, 1);
    row["r_edges"] = {0., 1., 0.5, 4.};
    EXPECT_EQ(check({{"monte_carlo", {row}}}).err,
              "nacre: monte_carlo vectors: \"r_edges\" must ascend\n");
}

// The whole file, of which everything but differential equations is answered.
TEST_F(ScatteringVectors, TheReferenceFileIsAnswered) {
    const std::string file = NACRE_SHARED_DIR "/reference/scattering_vectors.json";
    if (!fs::exists(file)) GTEST_SKIP() << "no shared reference data";
    const Outcome r = nacre(fmt::format("check --vectors '{}'", file));
    EXPECT_EQ(r.code, 0) << r.out;
    // A heading and 18 groups.
    EXPECT_EQ(std::count(r.out.begin(), r.out.end(), '\n'), 1 + 18) << r.out;
    EXPECT_TRUE(line_of("dipole", r.out).starts_with("dipole                      1188 ")) << r.out;
}

}  // namespace
}  // namespace nacre
