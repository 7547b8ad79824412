#include "nacre/reflectance/lafortune.h"

namespace nacre {
namespace {

/// What the reference vectors call the eight parameters of a lobe.
struct LobeKeys {
    std::string of[8][3];
};

LobeKeys keys_of(int lobe) {
    const std::string key = fmt::format("lobes_{}_", lobe);
    const auto alone = [&](const char* name) { return std::string(lobe == 0 ? name : ""); };
    return {{{key + "ks"},
             {key + "C_0", key + "M_0_0", alone("C_0")},
             {key + "C_1", key + "M_1_1", alone("C_1")},
             {key + "C_2", key + "M_2_2", alone("C_2")},
             {key + "M_0_1", key + "M_1_0"},
             {key + "M_0_2", key + "M_2_0"},
             {key + "M_1_2", key + "M_2_1"},
             {key + "n"}}};
}

constexpr std::string_view meanings[8] = {"weight of the lobe; 0: none",
                                          "coefficient of wi.x wo.x",
                                          "coefficient of wi.y wo.y",
                                          "coefficient of wi.z wo.z",
                                          "coefficient of wi.x wo.y + wi.y wo.x",
                                          "coefficient of wi.x wo.z + wi.z wo.x",
                                          "coefficient of wi.y wo.z + wi.z wo.y",
                                          "exponent"};

void add_lobe(std::vector<Parameter>& parameters, int lobe, const LobeKeys& keys) {
    constexpr double defaults[8] = {0., -1., -1., 1., 0., 0., 0., 20.};
    for (int i = 0; i < 8; ++i) {
        Parameter p{.name = lafortune_names[lobe][i],
                    .meaning = meanings[i],
                    .low = -10.,
                    .high = 10.,
                    .otherwise = defaults[i]};
        for (const std::string& alias : keys.of[i])
            if (!alias.empty()) p.aliases.push_back(alias);
        if (i == 0) {
            p.kind = ParameterKind::spectrum;
            p.low = 0.;
            p.high = 1000.;
            if (lobe == 0) p.otherwise = 0.4;
        } else if (i == 7) {
            p.low = 0.;
            p.high = 1e4;
        }
        parameters.push_back(std::move(p));
    }
}

/// The largest |M w| over unit vectors w: |M^k|^(1/k) for k = 2^40, by squaring.
double longest_axis(double (&m)[3][3]) {
    double log_length = 0., share = 1.;
    for (int step = 0; step < 40; ++step) {
        double largest = 0., square[3][3] = {};
        for (const auto& row : m)
            for (double x : row) largest = std::max(largest, std::abs(x));
        if (!(largest > 0.)) return 0.;
        for (auto& row : m)
            for (double& x : row) x /= largest;
        log_length += share * std::log(largest);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 3; ++k) square[i][j] += m[i][k] * m[k][j];
        std::copy(&square[0][0], &square[0][0] + 9, &m[0][0]);
        share *= 0.5;
    }
    return std::exp(log_length);
}

/// Shortens the axes to |M w| <= 1 and lowers the weights to kd + ks + ks2 + ks3 <= 1.
void bring_lobes_within(NamedNumbers& numbers) {
    const auto number = [&](std::string_view name) -> double& {
        return std::find_if(numbers.begin(), numbers.end(),
                            [&](const auto& n) { return n.first == name; })
            ->second;
    };
    double sum = number("kd");
    for (const auto& names : lafortune_names) {
        sum += number(names[0]);
        const auto c = [&](int i) -> double& { return number(names[i]); };
        double m[3][3] = {{c(1), c(4), c(5)}, {c(4), c(2), c(6)}, {c(5), c(6), c(3)}};
        const double length = longest_axis(m) * (1. + 1e-12);
        for (int i = 1; i < 7; ++i)
            if (length > 1.) c(i) /= length;
    }
    for (std::string_view name : {"kd", "ks", "ks2", "ks3"})
        if (sum > 1.) number(name) /= sum * (1. + 1e-12);
}

}  // namespace

// The manual page of lafortune.h, apart from it for length.
const ModelDescription& lafortune_description() {
    static constexpr JointCondition within{"kd + ks + ks2 + ks3 up to 1 and |M w| up to |w|",
                                           bring_lobes_within};
    static const LobeKeys keys[3] = {keys_of(0), keys_of(1), keys_of(2)};
    static const ModelDescription description = [] {
        ModelDescription d{
            .name = "lafortune",
            .title = "Lafortune",
            .authors = "E. P. F. Lafortune, S.-C. Foo, K. E. Torrance, D. P. Greenberg",
            .year = 1997,
            .paper = "Non-Linear Approximation of Reflectance Functions, SIGGRAPH 97",
            .equations = "the generalised cosine lobe and its special cases, section 4",
            .formula =
                "f = kd/pi + sum over three lobes of ks N max(0, wi^T M wo)^n\n"
                "M = (cx cxy cxz; cxy cy cyz; cxz cyz cz)\n"
                "none: N = 1;  normal: N = (n+2)/(2 pi);  density: N = (n+1)/(2 pi)\n"
                "and a mirror of weight mirror (ks - E), E the albedo of the first lobe",
            .parameters = {choice_parameter(
                               "norm", "the factor N of the lobes",
                               {{"normal",
                                 "(n+2)/(2 pi): ks is the albedo at normal incidence of "
                                 "a lobe with cz = 1"},
                                {"density", "(n+1)/(2 pi): the whole lobe holds ks"},
                                {"none", "1: as published fits are given"}}),
                           diffuse_parameter(0.4),
                           {.name = "mirror",
                            .meaning = "share of what the first lobe lacks of ks that is mirrored "
                                       "without blur; for normal and density",
                            .kind = ParameterKind::spectrum}},
            .behaviours =
                // A cosine lobe holds the most light, 2 pi/(n+2), when its axis is the normal.
            {{.options = "norm=normal",
              .energy_note = "reached at normal incidence, by a lobe with cz = 1",
              .joint = within,
              .examples =
                  {"kd=0 ks=1 n=20", "kd=0 ks=1 n=5 cz=0.7",
                   "kd=0.3 ks=0.6 n=8 cx=0.9 cy=0.9 cz=0.9", "kd=0 ks=1 cx=0 cy=0 n=1.5",
                   "kd=0.2 ks=0.5 cx=-0.6 cxy=0.2 cxz=0.1 cz=0.8 n=6 ks2=0.3 n2=40 mirror=0.5",
                   "kd=0 ks=0.4 ks2=0.3 ks3=0.3 cx2=-0.8 cy3=-0.7 n3=3"}},
             {.options = "norm=density",
              .energy_note = "as normal; ks (n+1)/(n+2) at normal incidence",
              .joint = within,
              .examples = {"kd=0 ks=1 n=20 mirror=1"}},
             {.options = "norm=none",
              .energy = Energy::exceeds,
              .energy_note = "up to the fit: ks |M w|^n 2 pi/(n+1) bounds the albedo",
              .witness = "kd=0 ks=1 cx=-1.1 cy=-1.1 cz=1.1 n=20",
              .examples = {"kd=0.1 ks=1 cx=-0.95 cy=-0.95 cz=0.9 n=12"}}},
            .isotropy = "isotropic for cx = cy, cxy = cxz = cyz = 0, else anisotropic",
            .sampling =
                "one-sample mixture of the cosine and, for each lobe, (n+1)/(2 pi) cos^n "
                "about M wo, by the energy that they hold",
            .albedo =
                "all: kd + sum ks N l^n I(a), l = |M wi|, a its angle with the normal, I(a) = "
                "B((n+3)/2, 1/2) (cos(a) int_{-pi/2}^{pi/2-a} cos^{n+1} + "
                "sin^{n+2}(a)/(n+1)); diffuse falloff: ks cos^n",
            .errata =
                {"The mirror remainder is printed without the cosine that a Dirac delta over solid "
                 "angle needs; here it is a share of the light.",
                 "With (n+1)/(2 pi), printed for the remainder, the lobe holds ks (n+1)/(n+2) at "
                 "normal incidence, so that a mirror is left there; with (n+2)/(2 pi) none is.",
                 "The principal axes of M are not the surface's unless M is diagonal; both "
                 "directions are rotated into them.",
                 "A matrix that is not symmetric, offered as a generalisation, is not reciprocal; "
                 "it is not offered here."},
            .references = {"E. P. F. Lafortune et al. 1997, SIGGRAPH 97, 117-126"},
        };
        for (int lobe = 0; lobe < 3; ++lobe) add_lobe(d.parameters, lobe, keys[lobe]);
        return d;
    }();
    return description;
}

}  // namespace nacre
