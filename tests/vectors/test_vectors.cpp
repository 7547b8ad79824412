// Every model against the reference vectors, in double and in single precision, one direction and
// packs.
#include <fstream>

#include "nacre/reflectance/albedo.h"
#include "nacre/vectors/file.h"

namespace nacre {
namespace {

const nlohmann::json& data() {
    static const nlohmann::json all = nlohmann::json::parse(
        std::ifstream(NACRE_SOURCE_DIR "/tests/reflectance/data/vectors.json"));
    return all;
}

/// Calls visit(group name, who, vector) for all vectors that some model answers.
template <class F>
void for_each_vector(F&& visit) {
    for (const auto& [name, group] : data()["models"].items()) {
        const GroupModel who = model_of_group(name);
        if (!who.evaluator) continue;
        for (const auto& v : group["vectors"]) visit(name, who, v);
    }
}

}  // namespace

TEST(ReferenceVectors, AgreeInDoublePrecision) {
    int count = 0;
    for_each_vector([&](const std::string&, const GroupModel& who, const nlohmann::json& v) {
        const AnyModel model = model_of_vector(who, v["params"]);
        const double expected = v["value"].get<double>();
        const double value = answer(who, model, direction_of(v["wi"]), direction_of(v["wo"]));
        EXPECT_LE(relative_deviation(value, expected), who.group->tolerance)
            << v["id"] << ": " << value << " instead of " << expected;
        ++count;
    });
    EXPECT_GE(count, 17 * 12);
}

TEST(ReferenceVectors, AgreeInSinglePrecision) {
    for_each_vector([](const std::string&, const GroupModel& who, const nlohmann::json& v) {
        if (who.group->pdf) return;
        const AnyModel model = model_of_vector(who, v["params"]);
        const Vec3f wi(direction_of(v["wi"])), wo(direction_of(v["wo"]));
        const double expected = v["value"].get<double>();
        EXPECT_LE(relative_deviation(model.eval(wi, wo), expected), 2e-5) << v["id"];
        const Spectral four = model.eval(wi, wo, Wavelengths::at(Spectral(550.f)));
        for (int i = 0; i < 4; ++i)
            EXPECT_LE(relative_deviation(four[i], expected), 2e-5) << v["id"] << " lane " << i;
    });
}

TEST(ReferenceVectors, AgreeInPacks) {
    for_each_vector([](const std::string&, const GroupModel& who, const nlohmann::json& v) {
        if (who.group->pdf) return;
        const AnyModel model = model_of_vector(who, v["params"]);
        // A length that is no multiple of the pack's; every third direction is below the horizon.
        std::vector<Vec3f> wi(37, Vec3f(direction_of(v["wi"]))),
            wo(37, Vec3f(direction_of(v["wo"])));
        for (std::size_t i = 2; i < wi.size(); i += 3) wi[i].z = -wi[i].z;
        std::vector<float> out(37, -1.f);
        model.eval_many(wi, wo, out);
        for (std::size_t i = 0; i < out.size(); ++i)
            EXPECT_LE(relative_deviation(out[i], i % 3 == 2 ? 0. : v["value"].get<double>()), 3e-5)
                << v["id"] << " at " << i;
    });
}

TEST(ReferenceVectors, AreExactlyZeroBelowTheHorizon) {
    int below = 0;
    for_each_vector([&](const std::string& name, const GroupModel& who, const nlohmann::json& v) {
        const Vec3d wi = direction_of(v["wi"]), wo = direction_of(v["wo"]);
        const AnyModel model = model_of_vector(who, v["params"]);
        const Vec3d down{wo.x, wo.y, -std::abs(wo.z)};
        EXPECT_EQ(model.eval(wi, down), 0.) << name;
        EXPECT_EQ(model.eval(down, wi), 0.) << name;
        EXPECT_EQ(model.eval(down, down), 0.) << name;
        below += wo.z < 0.;
    });
    EXPECT_GE(below, 14);
}

TEST(ReferenceVectors, AlbedosAgree) {
    int count = 0;
    for (const auto& row : data()["albedos"]) {
        std::string name = row["model"].get<std::string>();
        name = name.substr(0, name.find(" ("));
        const GroupModel who = model_of_group(name);
        if (!who.evaluator) continue;
        const AnyModel model = model_of_vector(who, row["params"]);
        for (const auto& [degrees, entry] : row["albedo"].items()) {
            const double theta = std::stod(degrees) * std::numbers::pi / 180.;
            const Albedo e = directional_albedo(model, {std::sin(theta), 0., std::cos(theta)});
            // The table has 6 to 9 decimals.
            const double tolerance = entry["abs_err"].get<double>() + 5e-7 + e.error;
            EXPECT_NEAR(e.value, entry["value"].get<double>(), tolerance)
                << row["model"] << row["params"] << " at " << degrees;
            EXPECT_LT(e.error, 1e-5);
            ++count;
        }
    }
    EXPECT_GE(count, 60);
}

TEST(ReferenceVectors, EveryModelAnswersAGroup) {
    for (const ModelDescription* m : models()) {
        // The reference has no Poulin-Fournier: tests/reflectance casts rays at the cylinders instead.
        EXPECT_EQ(groups_of(m->name).empty(), m->name == "poulin_fournier") << m->name;
        for (const ReferenceGroup& g : groups_of(m->name))
            EXPECT_TRUE(data()["models"].contains(g.name) || g.albedos_only) << g.name;
    }
}

}  // namespace nacre
