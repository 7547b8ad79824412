#include <gtest/gtest.h>

#include <fstream>

#include "nacre/math/error.h"
#include "nacre/optics/dispersion.h"
#include "nacre/optics/fresnel.h"
#include "nacre/optics/fresnel_moments.h"
#include "nacre/optics/media.h"
#include "tests/optics/reference.h"
#include "tests/support/error_of.h"

namespace nacre {

namespace {

bool starts_with(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}

}  // namespace

TEST(Media, Jensen2001AgreesWithTheReference) {
    int checked = 0;
    for (const auto& [name, row] : test::optics_reference()["materials_jensen2001"].items()) {
        const MeasuredMedium& m = measured_media().find(name);
        EXPECT_FLOAT_EQ(m.eta, float(row["eta"])) << name;
        ASSERT_TRUE(m.diffuse_reflectance) << name;
        for (std::size_t i = 0; i < 3; ++i, ++checked) {
            EXPECT_FLOAT_EQ(m.sigma_s_prime[i], float(row["sigma_s_prime"][i])) << name;
            EXPECT_FLOAT_EQ(m.sigma_a[i], float(row["sigma_a"][i])) << name;
            EXPECT_FLOAT_EQ((*m.diffuse_reflectance)[i], float(row["diffuse_reflectance"][i]));
        }
    }
    EXPECT_EQ(checked, 36);
}

TEST(Media, PublishedReflectanceFollowsFromTheCoefficients) {
    // Total of the classical dipole (Jensen 2001): R_d = alpha'/2 (1 + e^(-4/3 A s)) e^(-s), s =
    // sqrt(3 (1 - alpha')).
    for (const MeasuredMedium* m : measured_media()) {
        if (!m->diffuse_reflectance) continue;
        const double a = boundary_parameter(m->eta, BoundaryModel::fit);
        for (std::size_t i = 0; i < 3; ++i) {
            const double alpha = m->sigma_s_prime[i] / m->sigma_t_prime()[i];
            const double s = std::sqrt(3. * (1. - alpha));
            const double total = 0.5 * alpha * (1. + std::exp(-4. / 3. * a * s)) * std::exp(-s);
            EXPECT_NEAR(total, (*m->diffuse_reflectance)[i], 0.03) << m->name << ' ' << i;
        }
    }
}

TEST(Media, AgreeWithTheSharedTable) {
    std::ifstream file(NACRE_SHARED_DIR "/data/tables/sss_measured_media.csv");
    if (!file) GTEST_SKIP() << "the shared table of measured media is not here";
    std::string line;
    std::getline(file, line);
    std::size_t rows = 0;
    while (std::getline(file, line)) {
        const std::size_t quote = line.find('"', 1);
        const MeasuredMedium& m = measured_media().find(line.substr(1, quote - 1));
        float v[6];
        ASSERT_EQ(std::sscanf(line.c_str() + line.find(',', quote + 2), ",%f,%f,%f,%f,%f,%f", v,
                              v + 1, v + 2, v + 3, v + 4, v + 5),
                  6)
            << line;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(m.sigma_s_prime[i], v[i]) << line;
            EXPECT_EQ(m.sigma_a[i], v[i + 3]) << line;
        }
        ++rows;
    }
    EXPECT_EQ(rows, measured_media().size());
}

TEST(Media, AreFoundRegardlessOfCaseAndSpaces) {
    EXPECT_EQ(measured_media().size(), 47u);
    EXPECT_EQ(measured_media().find("skim milk").name, "Skimmilk");
    EXPECT_EQ(measured_media().find("HEAD & shoulders_shampoo").name, "Head & Shoulders Shampoo");
    EXPECT_TRUE(starts_with(test::error_of([] { measured_media().find("marbel"); }),
                            "unknown measured medium 'marbel'; did you mean 'Marble'?"));
    EXPECT_TRUE(starts_with(test::error_of([] { measured_media().find("plutonium"); }),
                            "unknown measured medium 'plutonium'; known are: Apple, "));
}

TEST(Dielectrics, NamedIndices) {
    EXPECT_FLOAT_EQ(dielectric_index("bk7"), 1.5046f);
    EXPECT_FLOAT_EQ(dielectric_index("Water"), 1.333f);
    EXPECT_FLOAT_EQ(dielectric_index("diamond"), 2.419f);
    EXPECT_FLOAT_EQ(dielectric_index("carbon_tetrachloride"), 1.461f);
    EXPECT_EQ(dielectric_names().size(), 23u);
    EXPECT_TRUE(starts_with(test::error_of([] { dielectric_index("diamnd"); }),
                            "unknown dielectric 'diamnd'; did you mean 'diamond'?"));
}

TEST(Dielectrics, DispersionHasThePublishedIndexAndAbbeNumber) {
    // Catalogue: n_d (587.6 nm) and V_d = (n_d - 1) / (n_F - n_C), F 486.1 nm, C 656.3 nm.
    struct Row {
        const char* name;
        float n, abbe, n_tolerance, abbe_tolerance;
    };
    for (const Row& r :
         {Row{"bk7", 1.51680f, 64.17f, 1e-5f, 0.01f}, Row{"n-sf11", 1.78472f, 25.68f, 1e-5f, 0.01f},
          Row{"fused quartz", 1.45846f, 67.82f, 1e-5f, 0.02f},
          Row{"diamond", 2.4175f, 55.3f, 1e-3f, 1.5f},
          Row{"water", 1.33300f, 55.74f, 1e-4f, 0.3f}}) {
        const DielectricIndex index = dispersive_dielectric(r.name);
        EXPECT_NEAR(index.at(587.5618f), r.n, r.n_tolerance) << r.name;
        EXPECT_NEAR((index.at(587.5618f) - 1.f) / (index.at(486.1327f) - index.at(656.2725f)),
                    r.abbe, r.abbe_tolerance)
            << r.name;
        EXPECT_TRUE(index.is_dispersive());
        EXPECT_EQ(index.eval(Wavelengths::rgb_bands())[1], index.at(sodium_d));
        EXPECT_EQ(index.eval(Wavelengths::at(450.f))[3], index.at(450.f));
    }
}

TEST(Dielectrics, FormulasAndTables) {
    EXPECT_FLOAT_EQ(DielectricIndex::cauchy(1.5f, 0.004f, 0.0001f).at(500.f),
                    1.5f + 0.016f + 0.0016f);
    const DielectricIndex table = DielectricIndex::tabulated({400.f, 600.f}, {1.6f, 1.5f});
    EXPECT_FLOAT_EQ(table.at(450.f), 1.575f);
    EXPECT_FLOAT_EQ(table.at(300.f), 1.6f);
    EXPECT_FLOAT_EQ(table.at(800.f), 1.5f);
    EXPECT_FALSE(DielectricIndex(1.3f).is_dispersive());
    EXPECT_FLOAT_EQ(DielectricIndex(1.3f).eval(Wavelengths::at(500.f))[2], 1.3f);
    EXPECT_EQ(test::error_of([] { DielectricIndex(0.f); }),
              "index of refraction: n = 0 must be positive");
    EXPECT_EQ(test::error_of([] { DielectricIndex::cauchy(-1.f, 0.f); }),
              "index of refraction: Cauchy's formula at 360 nm gives -1 must be positive");
    EXPECT_EQ(test::error_of([] {
                  DielectricIndex::tabulated({500.f, 400.f}, {1.5f, 1.5f});
              }),
              "index of refraction: wavelength 400 nm follows 500 nm; sort by wavelength");
}

TEST(Conductors, ReflectLikeTheMetalsTheyAre) {
    const auto reflectance = [](const char* name, float nm) {
        const ConductorIndex metal = conductor_index(name);
        const Wavelengths w = Wavelengths::at(nm);
        return fresnel_conductor(1.f, metal.eta->eval(w), metal.k->eval(w))[0];
    };
    // Johnson and Christy's silver at 582.1 nm: n = 0.05, k = 3.858.
    EXPECT_NEAR(reflectance("Ag", 582.1f), 0.98754f, 1e-4f);
    EXPECT_NEAR(reflectance("Au", 659.5f), 0.9627f, 1e-3f);  // n = 0.14, k = 3.697
    EXPECT_LT(reflectance("Au", 450.f), 0.45f);              // gold is yellow
    EXPECT_LT(reflectance("Cu", 500.f), 0.65f);              // copper red
    EXPECT_GT(reflectance("Cu", 650.f), 0.9f);
    EXPECT_NEAR(reflectance("Al", 550.f), 0.915f, 0.01f);  // handbook
    EXPECT_NEAR(reflectance("Hg", 550.f), 0.78f, 0.03f);
    for (const char* grey : {"Cr", "Fe", "Ni"}) {
        EXPECT_GT(reflectance(grey, 550.f), 0.5f) << grey;
        EXPECT_LT(reflectance(grey, 550.f), 0.7f) << grey;
    }
    for (const std::string_view name : conductor_names()) {
        const ConductorIndex metal = conductor_index(name);
        EXPECT_EQ(metal.perfect, name == "none");
        if (metal.perfect) continue;
        // Covers the whole visible range, and is positive in every band.
        EXPECT_GT(metal.k->eval(Wavelengths::at(360.f))[0], 1.f) << name;
        EXPECT_GT(metal.k->eval(Wavelengths::at(830.f))[0], 1.f) << name;
        EXPECT_GT(metal.eta->rgb().x, 0.f) << name;
    }
    EXPECT_TRUE(starts_with(test::error_of([] { conductor_index("Pb"); }),
                            "unknown conductor 'Pb'; known are: Ag, Al, Au, "));
}

}  // namespace nacre
