#include "nacre/vectors/measured.h"

#include "nacre/math/error.h"
#include "nacre/measured/factor/matrix.h"
#include "nacre/measured/factor/partial_svd.h"
#include "nacre/measured/half_angle.h"
#include "nacre/measured/merl.h"
#include "nacre/vectors/file.h"

namespace nacre {
namespace {

using nlohmann::json;
using Answers = std::map<std::string, double>;

constexpr std::size_t plane =
    std::size_t(MerlBrdf::theta_h_count) * MerlBrdf::theta_d_count * MerlBrdf::phi_d_count;

/// The numbers of a list as name_0, name_1, ...
void put_list(json& values, const std::string& name, const json& list) {
    for (std::size_t i = 0; i < list.size(); ++i) values[fmt::format("{}_{}", name, i)] = list[i];
}

json merl_vectors(const json& group) {
    json vectors = json::array();
    json header{{"id", "merl"}, {"values", json::object()}};
    for (const char* list : {"scale", "dims"})
        if (group.contains(list)) put_list(header["values"], list, group[list]);
    vectors.push_back(std::move(header));
    for (const json& v : group.at("vectors")) {
        json numbers = v;
        for (const char* name : {"id", "wi", "wo"}) numbers.erase(name);
        vectors.push_back(
            {{"id", v.at("id")}, {"wi", v.at("wi")}, {"wo", v.at("wo")}, {"values", numbers}});
    }
    return {{"vectors", vectors}};
}
Answers merl(const json& v) {
    if (!v.contains("wi"))
        return {{"scale_0", MerlBrdf::scale[0]},     {"scale_1", MerlBrdf::scale[1]},
                {"scale_2", MerlBrdf::scale[2]},     {"dims_0", MerlBrdf::theta_h_count},
                {"dims_1", MerlBrdf::theta_d_count}, {"dims_2", MerlBrdf::phi_d_count}};
    const Vec3d wi = direction_of(v.at("wi")), wo = direction_of(v.at("wo"));
    const HalfAngle a = to_half_angle(wi, wo);
    const MerlNode node = MerlBrdf::node_below(wi, wo);
    return {{"theta_h", a.theta_h},
            {"phi_h", a.phi_h},
            {"theta_d", a.theta_d},
            {"phi_d", a.phi_d},
            {"i_theta_h", node.theta_h},
            {"i_theta_d", node.theta_d},
            {"i_phi_d", node.phi_d},
            {"index", double(node.position)},
            {"index_green", double(node.position + plane)},
            {"index_blue", double(node.position + 2 * plane)}};
}

constexpr int sigmas = 4;
constexpr int ranks[] = {1, 2, 4};

json svd_vectors(const json& group) {
    json vectors = json::array();
    for (const json& v : group.at("vectors")) {
        json changed = v;
        changed["values"] = json::object();
        put_list(changed["values"], "sigma", v.at("sigma_1_4"));
        put_list(changed["values"], "error", v.at("rel_frobenius_error_J1_J2_J4"));
        vectors.push_back(std::move(changed));
    }
    return {{"vectors", vectors}};
}
/// The model that the vectors call so.
AnyModel model_of_svd(const json& v) {
    const std::string name = v.at("brdf").get<std::string>();
    const GroupModel who = model_of_group(name == "ward" ? "ward_aniso" : name);
    if (!who.evaluator)
        throw InputError(fmt::format("svd vectors: there is no model of a group '{}'", name));
    return model_of_vector(who, v.at("params"));
}
Answers svd(const json& v) {
    const FactorGrid grid{FactorParameters::in_out, v.at("R").get<int>()};
    const FactorMatrix m =
        sample_matrix(ModelTarget(model_of_svd(v), v.value("id", "svd vectors")), grid);
    const Svd svd = partial_svd(m.values[0], grid.count(), sigmas);
    Answers r;
    double all = 0.;
    for (double f : m.values[0]) all += f * f;
    for (std::size_t j = 0; j < svd.sigma.size(); ++j) r[fmt::format("sigma_{}", j)] = svd.sigma[j];
    for (int i = 0; i < 3; ++i) {
        double left = all;
        for (int j = 0; j < ranks[i]; ++j) left -= svd.sigma[j] * svd.sigma[j];
        r[fmt::format("error_{}", i)] = std::sqrt(left / all);
    }
    return r;
}

}  // namespace

std::vector<MeasuredVectors> measured_vectors(const json& all, const std::string& path) {
    std::vector<MeasuredVectors> r;
    const auto add = [&](const char* name, json (*vectors)(const json&), AnsweredGroup answered) {
        if (!all.contains(name)) return;
        try {
            r.push_back({name, vectors(all[name]), std::move(answered)});
        } catch (const json::exception& error) {
            throw InputError(fmt::format("group '{}' of '{}': {}", name, path, error.what()));
        }
    };
    add("merl", merl_vectors, {"half-angle coordinates", merl});
    add("svd", svd_vectors, {"partial SVD", svd});
    return r;
}

}  // namespace nacre
