#include "nacre/optics/media.h"

#include <array>

#include "nacre/math/error.h"
#include "nacre/text/names.h"

namespace nacre {

namespace {

constexpr std::string_view jensen = "Jensen et al. 2001", narasimhan = "Narasimhan et al. 2006";

// name, source, reduced scattering, absorption, index, diffuse reflectance
constexpr MeasuredMedium media[] = {
    {"Apple", jensen, Vec3f(2.29f, 2.39f, 1.97f), Vec3f(0.003f, 0.0034f, 0.046f), 1.3f,
     Vec3f(0.85f, 0.84f, 0.53f)},
    {"Chicken1", jensen, Vec3f(0.15f, 0.21f, 0.38f), Vec3f(0.015f, 0.077f, 0.19f), 1.3f,
     Vec3f(0.31f, 0.15f, 0.1f)},
    {"Chicken2", jensen, Vec3f(0.19f, 0.25f, 0.32f), Vec3f(0.018f, 0.088f, 0.2f), 1.3f,
     Vec3f(0.32f, 0.16f, 0.1f)},
    {"Cream", jensen, Vec3f(7.38f, 5.47f, 3.15f), Vec3f(0.0002f, 0.0028f, 0.0163f), 1.3f,
     Vec3f(0.98f, 0.9f, 0.73f)},
    {"Ketchup", jensen, Vec3f(0.18f, 0.07f, 0.03f), Vec3f(0.061f, 0.97f, 1.45f), 1.3f,
     Vec3f(0.16f, 0.01f, 0.f)},
    {"Marble", jensen, Vec3f(2.19f, 2.62f, 3.f), Vec3f(0.0021f, 0.0041f, 0.0071f), 1.5f,
     Vec3f(0.83f, 0.79f, 0.75f)},
    {"Potato", jensen, Vec3f(0.68f, 0.7f, 0.55f), Vec3f(0.0024f, 0.009f, 0.12f), 1.3f,
     Vec3f(0.77f, 0.62f, 0.21f)},
    {"Skimmilk", jensen, Vec3f(0.7f, 1.22f, 1.9f), Vec3f(0.0014f, 0.0025f, 0.0142f), 1.3f,
     Vec3f(0.81f, 0.81f, 0.69f)},
    {"Skin1", jensen, Vec3f(0.74f, 0.88f, 1.01f), Vec3f(0.032f, 0.17f, 0.48f), 1.3f,
     Vec3f(0.44f, 0.22f, 0.13f)},
    {"Skin2", jensen, Vec3f(1.09f, 1.59f, 1.79f), Vec3f(0.013f, 0.07f, 0.145f), 1.3f,
     Vec3f(0.63f, 0.44f, 0.34f)},
    {"Spectralon", jensen, Vec3f(11.6f, 20.4f, 14.9f), Vec3f(0.f, 0.f, 0.f), 1.3f,
     Vec3f(1.f, 1.f, 1.f)},
    {"Wholemilk", jensen, Vec3f(2.55f, 3.21f, 3.77f), Vec3f(0.0011f, 0.0024f, 0.014f), 1.3f,
     Vec3f(0.91f, 0.88f, 0.76f)},
    {"Lowfat Milk", narasimhan, Vec3f(0.89187f, 1.5136f, 2.532f),
     Vec3f(0.002875f, 0.00575f, 0.0115f), 1.33f, std::nullopt},
    {"Reduced Milk", narasimhan, Vec3f(2.4858f, 3.1669f, 4.5214f),
     Vec3f(0.0025556f, 0.0051111f, 0.012778f), 1.33f, std::nullopt},
    {"Regular Milk", narasimhan, Vec3f(4.5513f, 5.8294f, 7.136f),
     Vec3f(0.0015333f, 0.0046f, 0.019933f), 1.33f, std::nullopt},
    {"Espresso", narasimhan, Vec3f(0.72378f, 0.84557f, 1.0247f), Vec3f(4.7984f, 6.5751f, 8.8493f),
     1.33f, std::nullopt},
    {"Mint Mocha Coffee", narasimhan, Vec3f(0.31602f, 0.38538f, 0.48131f),
     Vec3f(3.772f, 5.8228f, 7.82f), 1.33f, std::nullopt},
    {"Lowfat Soy Milk", narasimhan, Vec3f(0.30576f, 0.34233f, 0.61664f),
     Vec3f(0.0014375f, 0.0071875f, 0.035937f), 1.33f, std::nullopt},
    {"Regular Soy Milk", narasimhan, Vec3f(0.59223f, 0.73866f, 1.4693f),
     Vec3f(0.0019167f, 0.0095833f, 0.065167f), 1.33f, std::nullopt},
    {"Lowfat Chocolate Milk", narasimhan, Vec3f(0.64925f, 0.83916f, 1.1057f),
     Vec3f(0.0115f, 0.0368f, 0.1564f), 1.33f, std::nullopt},
    {"Regular Chocolate Milk", narasimhan, Vec3f(1.4585f, 2.1289f, 2.9527f),
     Vec3f(0.010063f, 0.043125f, 0.14375f), 1.33f, std::nullopt},
    {"Coke", narasimhan, Vec3f(8.9053e-05f, 8.372e-05f, 0.f), Vec3f(0.10014f, 0.16503f, 0.2468f),
     1.33f, std::nullopt},
    {"Pepsi", narasimhan, Vec3f(6.1697e-05f, 4.2564e-05f, 0.f),
     Vec3f(0.091641f, 0.14158f, 0.20729f), 1.33f, std::nullopt},
    {"Sprite", narasimhan, Vec3f(6.0306e-06f, 6.4139e-06f, 6.5504e-06f),
     Vec3f(0.001886f, 0.0018308f, 0.0020025f), 1.33f, std::nullopt},
    {"Gatorade", narasimhan, Vec3f(0.0024574f, 0.003007f, 0.0037325f),
     Vec3f(0.024794f, 0.019289f, 0.008878f), 1.33f, std::nullopt},
    {"Chardonnay", narasimhan, Vec3f(1.7982e-05f, 1.3758e-05f, 1.2023e-05f),
     Vec3f(0.010782f, 0.011855f, 0.023997f), 1.33f, std::nullopt},
    {"White Zinfandel", narasimhan, Vec3f(1.7501e-05f, 1.9069e-05f, 1.288e-05f),
     Vec3f(0.012072f, 0.016184f, 0.019843f), 1.33f, std::nullopt},
    {"Merlot", narasimhan, Vec3f(2.1129e-05f, 0.f, 0.f), Vec3f(0.11632f, 0.25191f, 0.29434f), 1.33f,
     std::nullopt},
    {"Budweiser Beer", narasimhan, Vec3f(2.4356e-05f, 2.4079e-05f, 1.0564e-05f),
     Vec3f(0.011492f, 0.024911f, 0.057786f), 1.33f, std::nullopt},
    {"Coors Light Beer", narasimhan, Vec3f(5.0922e-05f, 4.301e-05f, 0.f),
     Vec3f(0.006164f, 0.013984f, 0.034983f), 1.33f, std::nullopt},
    {"Clorox", narasimhan, Vec3f(0.0024035f, 0.0031373f, 0.003991f),
     Vec3f(0.0033542f, 0.014892f, 0.026297f), 1.33f, std::nullopt},
    {"Apple Juice", narasimhan, Vec3f(0.00013612f, 0.00015836f, 0.000227f),
     Vec3f(0.012957f, 0.023741f, 0.052184f), 1.33f, std::nullopt},
    {"Cranberry Juice", narasimhan, Vec3f(0.00010402f, 0.00011646f, 7.8139e-05f),
     Vec3f(0.039437f, 0.094223f, 0.12426f), 1.33f, std::nullopt},
    {"Grape Juice", narasimhan, Vec3f(5.382e-05f, 0.f, 0.f), Vec3f(0.10404f, 0.23958f, 0.29325f),
     1.33f, std::nullopt},
    {"Ruby Grapefruit Juice", narasimhan, Vec3f(0.011002f, 0.010927f, 0.011036f),
     Vec3f(0.085867f, 0.18314f, 0.25262f), 1.33f, std::nullopt},
    {"White Grapefruit Juice", narasimhan, Vec3f(0.22826f, 0.23998f, 0.32748f),
     Vec3f(0.0138f, 0.018831f, 0.056781f), 1.33f, std::nullopt},
    {"Shampoo", narasimhan, Vec3f(0.0007176f, 0.0008303f, 0.0009016f),
     Vec3f(0.014107f, 0.045693f, 0.061717f), 1.33f, std::nullopt},
    {"Strawberry Shampoo", narasimhan, Vec3f(0.00015671f, 0.00015947f, 1.518e-05f),
     Vec3f(0.01449f, 0.05796f, 0.075823f), 1.33f, std::nullopt},
    {"Head & Shoulders Shampoo", narasimhan, Vec3f(0.023805f, 0.028804f, 0.034306f),
     Vec3f(0.084621f, 0.15688f, 0.20365f), 1.33f, std::nullopt},
    {"Lemon Tea Powder", narasimhan, Vec3f(0.040224f, 0.045264f, 0.051081f),
     Vec3f(2.4288f, 4.5757f, 7.2127f), 1.33f, std::nullopt},
    {"Orange Powder", narasimhan, Vec3f(0.00015617f, 0.00017482f, 0.0001762f),
     Vec3f(0.001449f, 0.003441f, 0.007863f), 1.33f, std::nullopt},
    {"Pink Lemonade Powder", narasimhan, Vec3f(0.00012103f, 0.00013073f, 0.00012528f),
     Vec3f(0.001165f, 0.002366f, 0.003195f), 1.33f, std::nullopt},
    {"Cappuccino Powder", narasimhan, Vec3f(1.8436f, 2.5851f, 2.1662f),
     Vec3f(35.844f, 49.547f, 61.084f), 1.33f, std::nullopt},
    {"Salt Powder", narasimhan, Vec3f(0.027333f, 0.032451f, 0.031979f),
     Vec3f(0.28415f, 0.3257f, 0.34148f), 1.33f, std::nullopt},
    {"Sugar Powder", narasimhan, Vec3f(0.00022272f, 0.00025513f, 0.000271f),
     Vec3f(0.012638f, 0.031051f, 0.050124f), 1.33f, std::nullopt},
    {"Suisse Mocha Powder", narasimhan, Vec3f(2.7979f, 3.5452f, 4.3365f),
     Vec3f(17.502f, 27.004f, 35.433f), 1.33f, std::nullopt},
    {"Pacific Ocean Surface Water", narasimhan, Vec3f(0.0001764f, 0.00032095f, 0.00019617f),
     Vec3f(0.031845f, 0.031324f, 0.030147f), 1.33f, std::nullopt},
};

constexpr auto names = [] {
    std::array<std::string_view, std::size(media)> n;
    for (std::size_t i = 0; i < n.size(); ++i) n[i] = media[i].name;
    return n;
}();

}  // namespace

std::span<const MeasuredMedium> measured_media() { return media; }

const MeasuredMedium& measured_medium(std::string_view name) {
    const int i = find_name(name, names);
    if (i < 0) throw InputError(unknown_name("measured medium", name, names));
    return media[i];
}

}  // namespace nacre
