// nacre diff: how far a picture is from a reference, and how much of that is noise.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/number_option.h"
#include "apps/cli/output_file.h"
#include "apps/cli/verb.h"
#include "nacre/image/image.h"
#include "nacre/math/error.h"
#include "nacre/metrics/flip.h"
#include "nacre/metrics/metrics.h"
#include "nacre/spectrum/color.h"

namespace nacre::cli {
namespace {

using nlohmann::ordered_json;

struct DiffArguments {
    std::string picture, reference, mask, error_map;
    double pixels_per_degree = flip_pixels_per_degree;
    bool json = false;
};

struct Result {
    Metrics metrics;
    FlipResult flip;
    HdrFlipResult flip_hdr;
    bool picture_variance = false, reference_variance = false;
};

void check_size(const std::string& file, const Image& image, const std::string& other_file,
                const Image& other) {
    if (image.width != other.width || image.height != other.height)
        throw InputError(
            fmt::format("{}: has {} x {} pixels, but {} has {} x {}; compare pictures of one size",
                        file, image.width, image.height, other_file, other.width, other.height));
}

void write_error_map(const Result& r, const Image& picture, const Image& reference,
                     const std::filesystem::path& file) {
    const auto has_extension = [&](const char* a, const char* b) {
        return file.extension() == a || file.extension() == b;
    };
    if (!has_extension(".exr", ".EXR")) {
        Image map = r.flip.map;
        if (has_extension(".png", ".PNG"))
            for (float& v : map.data) v = srgb_decode(v);  // the stored code is the error
        return write_image(map, file);
    }
    const Image relative = signed_relative_error(picture, reference),
                squared = squared_relative_error(picture, reference);
    Image map(picture.width, picture.height,
              {"R", "G", "B", "squared.R", "squared.G", "squared.B", "flip", "flip_hdr"});
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                map.at(x, y, c) = relative.at(x, y, c);
                map.at(x, y, 3 + c) = squared.at(x, y, c);
            }
            map.at(x, y, 6) = r.flip.map.at(x, y, 0);
            map.at(x, y, 7) = r.flip_hdr.map.at(x, y, 0);
        }
    write_image(map, file);
}

ordered_json describe(const Metric& m) {
    ordered_json r{{"value", m.value}};
    if (m.noise) {
        r["noise"] = *m.noise;
        r["corrected"] = m.corrected();
    }
    if (m.standard_error) r["standard_error"] = *m.standard_error;
    return r;
}

void print_diff_json(const Result& r, const DiffArguments& o) {
    const Metrics& m = r.metrics;
    ordered_json percentiles = ordered_json::array();
    for (const auto& [percent, value] : m.percentiles)
        percentiles.push_back({{"percent", percent}, {"value", value}});
    ordered_json bias = describe(m.bias);
    for (const Metric& c : m.channel_bias) bias["channels"].push_back(describe(c));
    ordered_json rel_mse = describe(m.rel_mse);
    rel_mse["trimmed"] = m.rel_mse_trimmed;
    const auto side = [](const std::string& file, const std::array<double, 3>& mean,
                         bool variance) -> ordered_json {
        return {{"file", file}, {"mean", mean}, {"variance", variance}};
    };
    const FlipExposures& e = r.flip_hdr.exposures;
    const ordered_json json{
        {"picture", side(o.picture, m.mean_picture, r.picture_variance)},
        {"reference", side(o.reference, m.mean_reference, r.reference_variance)},
        {"pixels", m.pixels},
        {"bias", bias},
        {"mse", describe(m.mse)},
        {"rel_mse", rel_mse},
        {"mape", describe(m.mape)},
        {"smape", describe(m.smape)},
        {"blocks",
         {{"count", m.block.blocks},
          {"rms", m.block.rms()},
          {"mean_square", describe(m.block.mean_square)}}},
        {"percentiles", percentiles},
        {"flip", {{"mean", r.flip.mean}, {"pixels_per_degree", o.pixels_per_degree}}},
        {"flip_hdr",
         {{"mean", r.flip_hdr.mean},
          {"start_exposure", e.start},
          {"stop_exposure", e.stop},
          {"exposures", e.count}}}};
    fmt::print("{}\n", json.dump(2, ' ', false, ordered_json::error_handler_t::replace));
}

void print_metric(const char* name, const Metric& m) {
    fmt::print("{:<12} {:>12.6g}", name, m.value);
    if (m.noise && m.standard_error)
        fmt::print(" {:>12.6g} {:>14.6g} {:>15.3g}", *m.noise, m.corrected(), *m.standard_error);
    fmt::print("\n");
}

void print_diff_plain(const Result& r, const DiffArguments& o) {
    const Metrics& m = r.metrics;
    const auto side = [](const char* name, const std::string& file,
                         const std::array<double, 3>& mean, bool variance) {
        fmt::print("{:<10} {}: mean RGB {:.6g} {:.6g} {:.6g}, variance {}\n", name, file, mean[0],
                   mean[1], mean[2], variance ? "known" : "not known");
    };
    side("picture", o.picture, m.mean_picture, r.picture_variance);
    side("reference", o.reference, m.mean_reference, r.reference_variance);
    fmt::print("{:<10} {}\n\n", "pixels", m.pixels);

    fmt::print("{:<12} {:>12}", "", "value");
    if (m.mse.noise)
        fmt::print(" {:>12} {:>14} {:>15}", "of it noise", "without noise", "standard error");
    fmt::print("\n");
    print_metric("bias", m.bias);
    const char* names[] = {"bias of R", "bias of G", "bias of B"};
    for (int c = 0; c < 3; ++c) print_metric(names[c], m.channel_bias[c]);
    print_metric("MSE", m.mse);
    print_metric("relMSE", m.rel_mse);
    print_metric("MAPE", m.mape);
    print_metric("SMAPE", m.smape);
    fmt::print("\n{:<40} {:.6g}\n", "relMSE without the worst 0.1 %", m.rel_mse_trimmed);
    if (m.block.blocks)
        fmt::print("{:<40} {:.6g}\n", "RMS relative error of 16 x 16 blocks", m.block.rms());
    for (const auto& [percent, value] : m.percentiles)
        fmt::print("{:<40} {:.6g}\n", fmt::format("relative error of a pixel, {} %", percent),
                   value);
    const FlipExposures& e = r.flip_hdr.exposures;
    fmt::print("{:<40} {:.6g}\n", fmt::format("FLIP, {:.4g} pixels a degree", o.pixels_per_degree),
               r.flip.mean);
    fmt::print(
        "{:<40} {:.6g}\n",
        fmt::format("HDR-FLIP, exposures: {} from {:.2f} to {:.2f}", e.count, e.start, e.stop),
        r.flip_hdr.mean);
}

int run(const DiffArguments& o) {
    if (!o.error_map.empty()) {
        check_image_output(o.error_map);
        refuse_input_as_output(o.error_map, {o.picture, o.reference, o.mask});
    }
    const Image picture = read_image(o.picture), reference = read_image(o.reference);
    check_size(o.reference, reference, o.picture, picture);
    PixelMask mask;
    if (!o.mask.empty()) {
        const Image image = read_image(o.mask);
        check_size(o.mask, image, o.picture, picture);
        mask = PixelMask(image);
    }
    const auto picture_variance = variance_of_mean(picture),
               reference_variance = variance_of_mean(reference);
    Result r;
    r.picture_variance = picture_variance.has_value();
    r.reference_variance = reference_variance.has_value();
    r.metrics = compare({picture, picture_variance ? &*picture_variance : nullptr},
                        {reference, reference_variance ? &*reference_variance : nullptr}, mask);
    r.flip = flip(picture, reference, mask, o.pixels_per_degree);
    r.flip_hdr = flip_hdr(picture, reference, mask, o.pixels_per_degree);
    if (!o.error_map.empty()) write_error_map(r, picture, reference, o.error_map);
    o.json ? print_diff_json(r, o) : print_diff_plain(r, o);
    return success;
}

}  // namespace

Action set_up_diff(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<DiffArguments>();
    app.add_option("picture", o->picture, "image: .exr, .pfm, .hdr, .png, .jpg")->required();
    app.add_option("reference", o->reference, "image of the same size")->required();
    app.add_option("--mask", o->mask, "image whose green is above 0.5 where a pixel counts");
    app.add_option("--error-map", o->error_map,
                   "image to write: .exr with the signed relative error in R, G, B, and squared.*, "
                   "flip and flip_hdr; other formats with FLIP as grey, white for 1");
    add_number(app, "--ppd", o->pixels_per_degree, {1, 10000},
               "pixels per degree of the viewer's eye, for FLIP (67.02: 3840 pixels on 0.7 m "
               "at 0.7 m)");
    app.add_flag("--json", o->json, "for programs");
    return [o] { return run(*o); };
}

}  // namespace nacre::cli
