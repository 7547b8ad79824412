#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "nacre/compare/measurement.h"
#include "nacre/math/error.h"

namespace nacre {
namespace {

using nlohmann::json;

const char* const channels[] = {"R", "G", "B"};

json numbers_of(const Measurement& m, const std::string& key) {
    json j{{"key", key},
           {"id", m.id},
           {"samples", m.samples},
           {"memory_mb", m.memory_mb},
           {"invalid_samples", m.invalid_samples}};
    for (const Timing& t : m.timings)
        j["timings"].push_back({t.frame, t.frame_cpu, t.precompute, t.precompute_cpu});
    j["program"] = m.program;
    j["command"] = m.command;
    j["notes"] = m.notes;
    j["statistics"] = json::array();
    for (const Statistic& s : m.statistics) j["statistics"].push_back({s.name, s.value, s.unit});
    return j;
}

void set_numbers(Measurement& m, const json& j) {
    m.id = j.at("id");
    m.samples = j.at("samples");
    m.memory_mb = j.at("memory_mb");
    m.invalid_samples = j.at("invalid_samples");
    m.program = j.at("program");
    m.command = j.at("command");
    m.notes = j.at("notes").get<std::vector<std::string>>();
    for (const json& t : j.at("timings")) m.timings.push_back({t[0], t[1], t[2], t[3]});
    for (const json& s : j.at("statistics")) m.statistics.push_back({s[0], s[1], s[2]});
}

/// Three channels of `from` times `scale`.
Image take(const Image& from, const std::string& prefix, float scale) {
    Image image(from.width, from.height);
    for (int c = 0; c < 3; ++c) {
        const int at = from.channel(prefix + channels[c]);
        if (at < 0) throw RunError(fmt::format("the channel {}{} is missing", prefix, channels[c]));
        for (int y = 0; y < from.height; ++y)
            for (int x = 0; x < from.width; ++x) image.at(x, y, c) = scale * from.at(x, y, at);
    }
    return image;
}

}  // namespace

void write_measurement(const Measurement& m, const std::string& key,
                       const std::filesystem::path& file) {
    std::vector<std::string> names;
    for (const char* prefix : {"", "variance.", "frame."})
        for (const char* c : channels) names.push_back(std::string(prefix) + c);
    Image image(m.mean.width, m.mean.height, names);
    const float samples = float(m.samples) * float(m.repeats());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) {
                image.at(x, y, c) = m.mean.at(x, y, c);
                image.at(x, y, 3 + c) = m.variance.at(x, y, c) * samples;
                image.at(x, y, 6 + c) = m.frame.at(x, y, c);
            }
    image.metadata = {{"nacre.measurement", numbers_of(m, key).dump()},
                      {"nacre.samples", fmt::to_string(m.samples * m.repeats())},
                      {"nacre.complete", "yes"}};
    write_image(image, file);
}

std::optional<Measurement> read_measurement(const std::string& key,
                                            const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return {};
    try {
        const Image image = read_image(file, {.any_channels = true});
        const auto text = image.metadata.find("nacre.measurement");
        if (text == image.metadata.end()) return {};
        const json numbers = json::parse(text->second);
        if (numbers.at("key") != key) return {};
        Measurement m;
        set_numbers(m, numbers);
        const float samples = float(m.samples) * float(m.repeats());
        m.mean = take(image, "", 1.f);
        m.variance = take(image, "variance.", 1.f / samples);
        m.frame = take(image, "frame.", 1.f);
        m.status = Measurement::Status::done;
        m.reused = true;
        return m;
    } catch (const std::exception&) {
        return {};  // damaged, or of another version: measured again
    }
}

}  // namespace nacre
