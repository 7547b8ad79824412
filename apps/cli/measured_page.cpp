#include "apps/cli/measured_page.h"

#include <nlohmann/json.hpp>

#include "nacre/math/error.h"
#include "nacre/measured/open_measured.h"
#include "nacre/reflectance/registry.h"

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

std::string channels_in_words(const MeasuredInfo& info) {
    if (!info.wavelengths.empty())
        return fmt::format("{} wavelengths, {:g} to {:g} nm", info.wavelengths.size(),
                           info.wavelengths.front(), info.wavelengths.back());
    return info.channels == 1 ? "grey" : "linear red, green, blue";
}

ordered_json sides(const MeasuredInfo& info) {
    ordered_json list = ordered_json::array();
    if (info.reflection_front) list.push_back("reflection front");
    if (info.transmission_front) list.push_back("transmission front");
    if (info.reflection_back) list.push_back("reflection back");
    if (info.transmission_back) list.push_back("transmission back");
    return list;
}

double to_tenth(double degrees) { return std::round(10. * degrees) / 10.; }

}  // namespace

bool has_measured_extension(const std::filesystem::path& file) {
    for (const MeasuredFormat* format : measured_formats())
        if (file.extension() == format->ending && file.extension() != ".xml") return true;
    return false;
}

ordered_json describe_measured(const std::filesystem::path& file, const Measured& data) {
    const MeasuredInfo& i = data.info();
    const MeasuredFormat* format = measured_formats().look(i.format);  // none of folders
    ordered_json json{{"file", file.string()},
                      {"kind", "measured reflectance"},
                      {"format", format ? std::string(format->title) : i.format}};
    if (!i.description.empty()) json["description"] = i.description;
    json["channels"] = channels_in_words(i);
    if (!i.wavelengths.empty()) json["wavelengths"] = i.wavelengths;
    json["parameterisation"] = i.parameterisation;
    json["isotropic"] = i.isotropic;
    json["stored"] = i.cosine ? "BSDF times cosine" : "BSDF";
    json["scale"] = i.scale;
    json["sides"] = sides(i);
    json["samples"] = i.samples;
    json["missing"] = i.missing;
    json["negative"] = i.negative;
    json["largest_incidence"] = to_tenth(i.largest_incidence);
    json["largest_exit"] = to_tenth(i.largest_exit);
    if (!i.notes.empty()) json["notes"] = i.notes;
    return json;
}

void refuse_data_as_model(const std::string& name, std::string_view instead) {
    std::error_code ignored;
    if (!models().look(name) && std::filesystem::exists(name, ignored))
        throw InputError(
            fmt::format("'{}' is data, not the name of a model; use nacre data {}", name, instead));
}

ordered_json describe_measured(const std::filesystem::path& file) {
    return describe_measured(file, *open_measured(file));
}

}  // namespace nacre::cli
