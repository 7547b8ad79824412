// Real measurements, where they are at hand.
#include <fstream>
#include <numbers>
#include <sstream>

#include "nacre/math/random.h"
#include "nacre/measured/half_angle.h"
#include "nacre/measured/klems.h"
#include "nacre/measured/rgl.h"
#include "tests/measured/made_files.h"

namespace nacre {
namespace {

constexpr const char* rgl_names[] = {"cc_ibiza_sunset_rgb", "cc_iris_purple_gem_rgb",
                                     "colodur_napoli_4f_rgb", "paper_white_rgb",
                                     "satin_rosaline_rgb"};

/// A network that was trained on one measured material by others (A. Sztrajman et al. 2021, Neural
/// BRDF Representation and Importance Sampling): 6 numbers to 21 to 21 to red, green and blue.
class NeuralBrdf {
  public:
    NeuralBrdf(const std::filesystem::path& table, const std::string& material) {
        std::ifstream file(table);
        std::string line, word;
        while (std::getline(file, line)) {
            if (line.substr(0, line.find(',')) != material) continue;
            std::istringstream words(line);
            std::getline(words, word, ',');
            while (std::getline(words, word, ',')) w_.push_back(std::stod(word));
        }
    }
    bool found() const { return w_.size() == 675; }
    Vec3d eval(const Vec3d& wi, const Vec3d& wo) const {
        const HalfAngle a = to_half_angle(wi, wo);
        const double s = std::sin(a.theta_d);
        const std::vector<double> in{std::sin(a.theta_h),   0.,
                                     std::cos(a.theta_h),   s * std::cos(a.phi_d),
                                     s * std::sin(a.phi_d), std::cos(a.theta_d)};
        const double* at = w_.data();
        const auto layer = [&](const std::vector<double>& x, std::size_t n) {
            std::vector<double> y(at + x.size() * n, at + x.size() * n + n);
            for (std::size_t i = 0; i < x.size(); ++i)
                for (std::size_t j = 0; j < n; ++j) y[j] += x[i] * at[i * n + j];
            at += x.size() * n + n;
            return y;
        };
        const auto positive = [](std::vector<double> x) {
            for (double& v : x) v = std::max(v, 0.);
            return x;
        };
        const std::vector<double> y = layer(positive(layer(positive(layer(in, 21)), 21)), 3);
        return {std::exp(y[0]) - 1., std::exp(y[1]) - 1., std::exp(y[2]) - 1.};
    }

  private:
    std::vector<double> w_;
};

/// The share of the light from wi that comes back.
std::vector<double> albedo_of(const Measured& m, const Vec3d& wi) {
    constexpr int rows = 60, columns = 120;
    std::vector<double> sum(std::size_t(m.info().channels));
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const double z = std::sqrt((y + 0.5) / rows);  // equal projected solid angles
            const auto v = test::value_at(
                m, wi, test::towards(std::acos(z) * 180. / std::numbers::pi, 360. * x / columns));
            for (std::size_t c = 0; c < v.size(); ++c)
                sum[c] += v[c] * std::numbers::pi / (rows * columns);
        }
    return sum;
}

}  // namespace

#define NACRE_NEEDS_MEASURED_DATA()                      \
    if (!std::filesystem::exists(test::measured_data())) \
    GTEST_SKIP() << "no measured data at " << test::measured_data()

TEST(MeasuredFiles, AllLoad) {
    NACRE_NEEDS_MEASURED_DATA();
    struct File {
        const char *path, *format;
        std::size_t samples, missing, negative;
    };
    for (const File& f : {File{"merl/pink-felt.nbrdf.binary", "merl", 1458000, 361784, 0},
                          {"merl/pink-felt-1d.alta", "alta", 90, 0, 0},
                          {"retro/retro-3M-jaune.dat", "alta", 7397, 86, 0},
                          {"retro/retro-gray-tape.dat", "alta", 7405, 0, 0},
                          {"cornell/acryl_blue.brdf", "cornell", 1439, 0, 0},
                          {"cornell/cayman.brdf", "cornell", 1439, 0, 0},
                          {"cornell/garnet_red.brdf", "cornell", 1439, 0, 0},
                          {"cornell/krylon_blue.brdf", "cornell", 1439, 0, 0},
                          {"bsdf-xml/klemsfull.xml", "klems", 4 * 145 * 145, 0, 0},
                          {"bsdf-xml/aerc6216_kf.xml", "klems", 3 * 145 * 145, 0, 0}}) {
        const auto m = read_measured(test::measured_data() / f.path);
        EXPECT_EQ(m->info().format, f.format) << f.path;
        EXPECT_EQ(m->info().samples, f.samples) << f.path;
        EXPECT_EQ(m->info().missing, f.missing) << f.path;
        EXPECT_EQ(m->info().negative, f.negative) << f.path;
    }
}

/// What a file of the RGL database holds is f cos, of the light that it says: no surface sends out
/// more than it gets, the mean of the table over the square is what comes out, and the networks
/// that others trained on the database's BRDF values know the same surfaces.
TEST(MeasuredFiles, RglValuesAreBrdfTimesCosine) {
    NACRE_NEEDS_MEASURED_DATA();
    const auto folder = test::measured_data() / "rgl";
    for (const std::string name : rgl_names) {
        const auto m = read_measured(folder / (name + ".bsdf"));
        const RglTables& t = dynamic_cast<const RglMeasured&>(*m).brdf().tables();
        EXPECT_EQ(m->info().samples, 8192u);
        EXPECT_EQ(m->info().negative > 0, name.starts_with("cc_")) << name;
        // The second and fifth incidence, 28 and 62 degrees.
        for (const std::size_t slice : {1u, 4u}) {
            const double theta = t.incidence.fast()[slice];
            const auto albedo = albedo_of(*m, {std::sin(theta), 0., std::cos(theta)});
            for (int c = 0; c < 3; ++c) {
                EXPECT_GT(albedo[c], 0.);
                EXPECT_LT(albedo[c], 1.);
                double mean = 0.;
                for (int i = 0; i < 32 * 32; ++i)
                    mean += t.spectra[(slice * 1024 + i) * 3 + c] / 1024.;
                // But for what the warp leads below the horizon.
                EXPECT_NEAR(albedo[c], mean, 0.08 * mean + 0.004) << name << " " << slice;
            }
        }
        const NeuralBrdf network(folder / "rgl_isotropic_nbrdf_weights.csv", name);
        ASSERT_TRUE(network.found());
        Random random(stream_key(27, 11));
        double ours = 0., theirs = 0.;
        for (int i = 0; i < 4000; ++i) {
            const double zi = 0.2 + 0.8 * random.next(), zo = 0.2 + 0.8 * random.next();
            const Vec3d wi{std::sqrt(1. - zi * zi), 0., zi};
            const double so = std::sqrt(1. - zo * zo), p = 6.2831853 * random.next();
            const Vec3d wo{so * std::cos(p), so * std::sin(p), zo};
            const auto v = test::value_at(*m, wi, wo);
            const Vec3d n = network.eval(wi, wo);
            for (int c = 0; c < 3; ++c) {
                ours += v[c];
                theirs += n[c];
            }
        }
        // They know nothing negative, which noise makes of the darkest bands; f cos would be a third
        // less.
        EXPECT_NEAR(ours / theirs, 1., 0.05) << name;
    }
}

TEST(MeasuredFiles, CornellReturnsEveryMeasuredNumber) {
    NACRE_NEEDS_MEASURED_DATA();
    for (const char* name : {"acryl_blue", "cayman", "garnet_red", "krylon_blue"}) {
        const auto file = test::measured_data() / "cornell" / (std::string(name) + ".brdf");
        const auto m = read_measured(file);
        EXPECT_EQ(m->info().wavelengths.size(), 31u);
        // From the text itself: angles in radians and 31 numbers in lines of 35.
        std::ifstream text(file);
        std::string line;
        int compared = 0;
        while (std::getline(text, line)) {
            std::istringstream words(line.substr(0, line.find('#')));
            std::vector<double> x;
            for (double v; words >> v;) x.push_back(v);
            if (x.size() != 35) continue;
            const double degree = 180. / std::numbers::pi;
            const auto v = test::value_at(*m, test::towards(x[0] * degree, x[1] * degree),
                                          test::towards(x[2] * degree, x[3] * degree));
            ASSERT_EQ(v, std::vector<double>(x.begin() + 4, x.end())) << name << " " << compared;
            ++compared;
        }
        EXPECT_EQ(compared, 1439);
    }
}

/// Tape throws light back to where it comes from; of the two ALTA files one holds f cos.
TEST(MeasuredFiles, RetroReflectorsReflectBack) {
    NACRE_NEEDS_MEASURED_DATA();
    for (const char* name : {"retro-3M-jaune.dat", "retro-gray-tape.dat"}) {
        const auto m = read_measured(test::measured_data() / "retro" / name);
        EXPECT_EQ(m->info().cosine, std::string(name) == "retro-3M-jaune.dat");
        const Vec3d wi = test::towards(30., 0.);
        const double back = test::value_at(*m, wi, wi)[0];
        EXPECT_GT(back, 5. * test::value_at(*m, wi, test::towards(60., 0.))[0]) << name;
        EXPECT_GT(back, 5. * test::value_at(*m, wi, test::towards(30., 90.))[0]) << name;
    }
}

/// A window pane of clear glass without walls: all light goes straight through.
TEST(MeasuredFiles, KlemsMatricesKeepEnergy) {
    NACRE_NEEDS_MEASURED_DATA();
    for (const char* name : {"klemsfull.xml", "aerc6216_kf.xml"}) {
        const auto m = read_measured(test::measured_data() / "bsdf-xml" / name);
        const auto& k = dynamic_cast<const KlemsMeasured&>(*m);
        for (int i = 0; i < 145; ++i)
            for (const auto& [through, back] :
                 {std::pair{KlemsMeasured::transmission_front, KlemsMeasured::reflection_front},
                  {KlemsMeasured::transmission_back, KlemsMeasured::reflection_back}}) {
                double sum = 0.;
                for (const auto d : {through, back}) {
                    const KlemsMatrix& matrix = k.matrix(d);
                    for (std::size_t o = 0; o < matrix.value.size() / 145; ++o)
                        sum += matrix.value[o * 145 + i] * matrix.out.projected_solid_angle(int(o));
                }
                EXPECT_LT(sum, 1.001) << name << " " << i;
                EXPECT_GT(sum, 0.) << name << " " << i;
            }
    }
    const auto pane = read_measured(test::measured_data() / "bsdf-xml/klemsfull.xml");
    const Vec3d w = test::towards(20., 20.);
    EXPECT_GT(test::value_at(*pane, w, -w)[0],
              100. * test::value_at(*pane, w, -test::towards(20., 60.))[0]);
}

}  // namespace nacre
