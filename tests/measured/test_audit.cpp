#include "nacre/measured/audit.h"

#include <cmath>

#include "nacre/measured/audit_verdict.h"
#include "nacre/measured/convert.h"
#include "nacre/measured/number_text.h"
#include "nacre/measured/views.h"
#include "tests/measured/made_files.h"
#include "tests/measured/made_source.h"
#include "tests/support/constants.h"

namespace nacre {
namespace {

/// A table of CSV on a grid of 10 degrees, whose entries can be changed.
struct MadeTable {
    std::function<double(const Vec3d& wi, const Vec3d& wo)> value;
    std::function<double(int theta_i, int theta_o, int phi, double f)> change =
        [](int, int, int, double f) { return f; };

    std::unique_ptr<Measured> data() const {
        std::string text = "theta_i,phi_i,theta_o,phi_o,r,g,b\n";
        for (int i = 0; i <= 80; i += 10)
            for (int o = 0; o <= 80; o += 10)
                for (int phi = 0; phi <= 180; phi += 15) {
                    const double f =
                        change(i, o, phi, value(test::towards(i, 0.), test::towards(o, phi)));
                    text += fmt::format("{},0,{},{},{},{},{}\n", i, o, phi, f, 0.5 * f, 0.25 * f);
                }
        return test::parsed(text);
    }
};

/// A matte surface with a soft highlight: reciprocal, smooth.
MadeTable smooth_table() {
    return {[](const Vec3d& i, const Vec3d& o) {
        const Vec3d h = normalize(i + o);
        return 0.5 / pi + 0.1 * std::pow(h.z, 20.);
    }};
}

bool says(const std::vector<std::string>& sentences, std::string_view words) {
    for (const std::string& s : sentences)
        if (s.find(words) != s.npos) return true;
    return false;
}

}  // namespace

TEST(Audit, AMatteTableHasItsAlbedo) {
    const MadeTable matte{[](const Vec3d&, const Vec3d&) { return 0.6 / pi; }};
    const Audit a = audit(*matte.data());
    ASSERT_EQ(a.albedo.size(), 18u);
    for (const AuditAlbedo& x : a.albedo) {
        // Exits are known to half a step beyond 80 degrees.
        const double known = std::pow(std::sin(85. * pi / 180.), 2.);
        EXPECT_NEAR(x.known_reflected, known, 4e-3) << x.theta;
        EXPECT_NEAR(x.reflected.x, 0.6 * x.known_reflected, 1e-9) << x.theta;
        EXPECT_NEAR(x.reflected.z, 0.15 * x.known_reflected, 1e-9) << x.theta;
        EXPECT_EQ(x.known_transmitted, 0.);
    }
}

/// Of f = k cos(theta_o) the integral of f cos is 2 pi k / 3.
TEST(Audit, AlbedoOfClosedForm) {
    const test::MadeSource source(
        [](int c, const Vec3d&, const Vec3d& o) { return 0.1 * (c + 1) * o.z; });
    for (const AuditAlbedo& x : audit(source).albedo)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(x.reflected[c], 2. * pi * 0.1 * (c + 1) / 3., 1e-3 * (c + 1)) << x.theta;
}

TEST(Audit, NothingIsFoundOnACleanTable) {
    const Audit a = audit(*smooth_table().data());
    EXPECT_EQ(a.reciprocity.apart, 0u);
    EXPECT_GT(a.reciprocity.pairs, 5000u);
    EXPECT_LT(a.reciprocity.largest, 0.02);
    EXPECT_EQ(a.outliers.count, 0u);
    EXPECT_EQ(a.outliers.looked_at, 9u * 9u * 13u);
    EXPECT_TRUE(says(a.trusted, "reciprocal: "));
    EXPECT_TRUE(says(a.trusted, "no value is negative"));
    EXPECT_TRUE(says(a.trusted, "no sample lies far"));
    EXPECT_TRUE(says(a.trusted, "no more light leaves than comes in"));
    ASSERT_EQ(a.doubtful.size(), 1u);
    EXPECT_TRUE(says(a.doubtful, "beyond 80 degrees"));
}

TEST(Audit, OneEntryThatIsNotReciprocalIsFound) {
    MadeTable table = smooth_table();
    table.change = [](int i, int o, int phi, double f) {
        return i == 30 && o == 50 && phi == 60 ? 1.4 * f : f;
    };
    const Audit a = audit(*table.data());
    ASSERT_GE(a.reciprocity.apart, 1u);
    EXPECT_LT(a.reciprocity.apart, a.reciprocity.pairs / 100);
    // 1.4 against 1, over 1.2.
    EXPECT_NEAR(a.reciprocity.largest, 0.4 / 1.2, 1e-9);
    EXPECT_EQ(place_in_words(a.reciprocity.worst.front()).substr(0, 29),
              "theta_i 30.0, theta_o 50.0, p");
    EXPECT_TRUE(says(a.doubtful, "reciprocal in the mean alone"));
    EXPECT_EQ(a.outliers.count, 0u);
}

TEST(Audit, OneOutlierIsFound) {
    for (const double factor : {5., 0.1}) {
        MadeTable table = smooth_table();
        table.change = [&](int i, int o, int phi, double f) {
            return i == 40 && o == 20 && phi == 90 ? factor * f : f;
        };
        const Audit a = audit(*table.data());
        ASSERT_EQ(a.outliers.count, 1u) << factor;
        EXPECT_EQ(place_in_words(a.outliers.worst[0]),
                  "theta_i 40.0, theta_o 20.0, phi 90.0 degrees");
        EXPECT_NEAR(a.outliers.worst[0].value / a.outliers.worst[0].other, factor, 0.1 * factor);
        EXPECT_TRUE(says(a.doubtful, "1 of 1053 samples lie far from their neighbours")) << factor;
    }
}

TEST(Audit, MoreLightThanComesInIsFound) {
    MadeTable table{[](const Vec3d& i, const Vec3d&) { return (i.z < 0.4 ? 1.1 : 0.5) / pi; }};
    const Audit a = audit(*table.data());
    EXPECT_TRUE(says(a.doubtful, "more light leaves than comes in at 4 of 18 incidences"));
    double most = 0.;
    for (const AuditAlbedo& x : a.albedo) most = std::max(most, x.largest);
    EXPECT_NEAR(most, 1.1, 0.015);
    EXPECT_FALSE(says(a.trusted, "no more light leaves"));
}

TEST(Audit, NegativeValuesAndGapsAreSaid) {
    MadeTable table = smooth_table();
    table.change = [](int i, int o, int phi, double f) {
        if (o > 40) return nan;
        return i == 20 && o == 20 && phi == 15 ? -0.01 : f;
    };
    const Audit a = audit(*table.data());
    EXPECT_EQ(a.range.most_negative, -0.01);
    EXPECT_TRUE(says(a.doubtful, "1 of 1053 samples are negative, down to -0.01 sr^-1"));
    EXPECT_TRUE(
        says(a.doubtful, "of pairs of directions within 80 degrees of the normal are known"));
    EXPECT_TRUE(says(a.doubtful, "nothing is known beyond 40.0 degrees of exit"));
}

/// Light that goes through counts with what is reflected; from behind by itself.
TEST(Audit, TransmissionCounts) {
    test::MadeSource pane(
        [](int, const Vec3d&, const Vec3d& o) { return (o.z > 0. ? 0.25 : 0.5) / pi; });
    pane.info_to_change().transmission_front = true;
    const Audit a = audit(pane);
    ASSERT_EQ(a.albedo.size(), 18u);
    for (const AuditAlbedo& x : a.albedo) {
        EXPECT_NEAR(x.reflected.y, 0.25, 1e-3);
        EXPECT_NEAR(x.transmitted.y, 0.5, 2e-3);
        EXPECT_NEAR(x.largest, 0.75, 3e-3);
        EXPECT_EQ(x.known_transmitted, 1.);
    }
}

}  // namespace nacre
