#pragma once
// Reference values of tests/illumination/data/illumination_vectors.json, and how its names map to
// ours.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "nacre/illumination/m21_linear_transparency.h"
#include "nacre/illumination/models.h"

namespace nacre::illumination {

inline const nlohmann::json& reference() {
    static const nlohmann::json values = [] {
        std::ifstream file(NACRE_SOURCE_DIR "/tests/illumination/data/illumination_vectors.json");
        return nlohmann::json::parse(file);
    }();
    return values;
}

template <class D>
Vec3<D> vector(const nlohmann::json& v) {
    return {D(v[0].get<double>()), D(v[1].get<double>()), D(v[2].get<double>())};
}

inline Vec3d polar(double theta, double phi = 0.) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// A case of the reference file: model, parameters and situation in numbers of type D.
template <class D>
struct Case {
    const Description& model;
    Values<D> values = Values<D>::defaults(model);
    Lighting<D> at;
    D own = D(0), behind = D(0);  ///< I_r and I_t of model 21

    Case(const Description& m, const nlohmann::json& v)
        : model(m), at{.wi = vector<D>(v["wi"]), .wo = vector<D>(v["wo"])} {
        for (const auto& [name, value] : v["params"].items()) read(name, value);
    }
    D value() const {
        if (model.part != Part::transparency) return intensity(model, values, at);
        const D kt = transmittance(model, values, at.wo);
        return model.number == 21 ? blend(kt, own, behind) : kt;
    }

  private:
    void read(const std::string& name, const nlohmann::json& value) {
        static const std::map<std::string, D Lighting<D>::*> situation = {
            {"I_L", &Lighting<D>::light},          {"I", &Lighting<D>::ambient},
            {"dL", &Lighting<D>::light_distance},  {"dV", &Lighting<D>::viewer_distance},
            {"dOmega", &Lighting<D>::solid_angle}, {"lambda", &Lighting<D>::wavelength}};
        static const std::map<std::string, std::string> ours = {{"beta_deg", "beta"},
                                                                {"gamma_deg", "gamma"},
                                                                {"Datt", "distribution"},
                                                                {"Gatt", "geometry"}};
        static const std::map<std::string, std::string> words = {{"P", "phong"},
                                                                 {"TR", "trowbridge_reitz"},
                                                                 {"TS", "torrance_sparrow"},
                                                                 {"S", "sancer"}};
        if (situation.contains(name)) {
            const double micrometres = name == "lambda" ? 1000. : 1.;
            at.*situation.at(name) = D(value.get<double>() * micrometres);
        } else if (name == "Ir") {
            own = D(value.get<double>());
        } else if (name == "It") {
            behind = D(value.get<double>());
        } else {
            const std::string wanted = model.number == 5 && name == "k" ? "kd"
                                       : ours.contains(name)            ? ours.at(name)
                                                                        : name;
            for (std::size_t i = 0; i < model.parameters.size(); ++i) {
                const Parameter& p = model.parameters[i];
                if (p.name != wanted) continue;
                const double number = p.kind == ParameterKind::choice
                                          ? find_choice(model.name, p, words.at(value))
                                          : value.get<double>();
                check_range(model.name, p, number);
                values.set(model, i, number);
                return;
            }
            ADD_FAILURE() << model.name << " has no parameter " << name;
        }
    }
};

}  // namespace nacre::illumination
