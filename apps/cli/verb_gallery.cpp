// nacre gallery: the pictures that answer the figures of the classic papers.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/cli/finish_picture.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/number_option.h"
#include "apps/cli/progress_bar.h"
#include "apps/cli/streams.h"
#include "apps/cli/verb.h"
#include "nacre/math/error.h"
#include "nacre/render/output.h"
#include "nacre/scene/load.h"
#include "nacre/techniques/missing_light.h"
#include "nacre/text/names.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

struct GalleryArguments {
    std::vector<std::string> names;
    std::string folder, scenes;
    double scale = 1;
    int spp = 0, threads = 0;
    FinishOptions finish;
    bool quiet = false;
};

/// One picture: a scene, or the scenes of a contact sheet.
struct Plate {
    std::string name;
    std::vector<fs::path> scenes;
    bool sheet = false;
};

constexpr int sheet_columns = 6;

std::vector<fs::path> scenes_in(const fs::path& folder, const std::function<bool(char)>& first) {
    std::vector<fs::path> r;
    for (const auto& f : fs::directory_iterator(folder))
        if (f.path().extension() == ".xml" && first(f.path().filename().string()[0]))
            r.push_back(f.path());
    std::sort(r.begin(), r.end());
    return r;
}

/// The scenes that come with the program: beside it where it is installed, else in the source tree.
fs::path shipped_scenes() {
    std::error_code none;
    const fs::path installed =
        fs::read_symlink("/proc/self/exe", none).parent_path().parent_path() /
        NACRE_INSTALLED_GALLERY;
    return fs::is_directory(installed) ? installed : fs::path(NACRE_GALLERY);
}

/// Every scene of the folder is a picture; of its subfolders those that number their scenes
/// (01_name.xml) are contact sheets, the others hold parts.
std::vector<Plate> find_plates(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw InputError(
            fmt::format("no gallery at '{}'; give the folder gallery of the source tree: --scenes",
                        folder.string()));
    std::vector<Plate> r;
    for (const fs::path& f : scenes_in(folder, [](char) { return true; }))
        r.push_back({f.stem().string(), {f}});
    for (const auto& d : fs::directory_iterator(folder)) {
        if (!d.is_directory()) continue;
        auto scenes = scenes_in(d.path(), [](char c) { return c >= '0' && c <= '9'; });
        if (!scenes.empty()) r.push_back({d.path().filename().string(), std::move(scenes), true});
    }
    if (r.empty()) throw InputError(fmt::format("'{}' holds no scenes", folder.string()));
    std::sort(r.begin(), r.end(), [](auto& a, auto& b) { return a.name < b.name; });
    return r;
}

std::vector<Plate> choose(const std::vector<Plate>& all, const std::vector<std::string>& names) {
    if (names.empty()) return all;
    std::vector<std::string> known;
    for (const Plate& p : all) known.push_back(p.name);
    std::vector<Plate> r;
    for (const std::string& name : names) {
        const auto it = std::find(known.begin(), known.end(), name);
        if (it == known.end())
            throw InputError(
                fmt::format("no picture '{}' in the gallery{}", name, suggestion(name, known)));
        r.push_back(all[static_cast<std::size_t>(it - known.begin())]);
    }
    return r;
}

/// The comment at the head of a scene file, on one line.
std::string caption(const fs::path& file) {
    const std::string text = read_whole_file(file).value_or("");
    constexpr std::string_view open = "<!--", close = "-->";
    if (!text.starts_with(open)) return {};
    std::istringstream words(text.substr(open.size(), text.find(close) - open.size()));
    std::string r, word;
    while (words >> word) r += (r.empty() ? "" : " ") + word;
    return r;
}

Scene load(const fs::path& file, const GalleryArguments& o) {
    LoadOptions sized;
    if (o.scale != 1) {  // the camera depends on the size, so it is read again
        const FilmSettings film = load_scene(file).film;
        const auto scaled = [&](int n) {
            return std::max(1, static_cast<int>(std::lround(n * o.scale)));
        };
        sized.width = scaled(film.width);
        sized.height = scaled(film.height);
    }
    Scene scene = load_scene(file, sized);
    if (o.spp) scene.sampler.samples = o.spp;
    return scene;
}

/// Pictures side by side, row by row; rows and columns are as large as their largest picture.
Image compose(const std::vector<Image>& tiles) {
    int width = 0, height = 0;
    for (const Image& t : tiles) {
        width = std::max(width, t.width);
        height = std::max(height, t.height);
    }
    const int count = static_cast<int>(tiles.size()), columns = std::min(count, sheet_columns);
    Image sheet(width * columns, height * ((count + columns - 1) / columns));
    for (int i = 0; i < count; ++i) {
        const Image& t = tiles[static_cast<std::size_t>(i)];
        const int left = i % columns * width, top = i / columns * height;
        for (int y = 0; y < t.height; ++y)
            for (int x = 0; x < t.width; ++x) {
                const Vec3f c = t.rgb(x, y);
                sheet.at(left + x, top + y, 0) = c.x;
                sheet.at(left + x, top + y, 1) = c.y;
                sheet.at(left + x, top + y, 2) = c.z;
            }
    }
    return sheet;
}

/// Empty if Ctrl-C came before the picture was complete.
std::optional<Image> picture(const fs::path& file, const GalleryArguments& o,
                             const Invocation& invocation) {
    const Scene scene = load(file, o);
    check_samples(o.finish, scene.sampler.samples);
    const RenderPlan plan = plan_of(scene);
    for (const std::string& w : warnings_of(scene, plan)) say("nacre: warning: {}\n", w);
    ProgressBar bar(o.quiet);
    RenderOptions options;
    options.threads = o.threads;
    options.stop = &interrupt_flag();
    options.halves = o.finish.denoise;
    options.progress = [&](const RenderProgress& p) { bar.show(p); };
    const RenderResult result = render(scene, plan, FrameSettings::of(scene), options);
    if (!result.complete) return {};
    Image image =
        render_image(result, scene, {invocation.command_line, version, file.filename().string()});
    const Finish finish =
        finish_picture(image, result, scene, o.finish, o.threads, interrupt_flag());
    if (o.finish.denoise && !finish.denoised) return {};
    return image;
}

int run(const GalleryArguments& o, const Invocation& invocation) {
    if (o.spp) check_samples(o.finish, o.spp);
    const fs::path scenes = o.scenes.empty() ? shipped_scenes() : fs::path(o.scenes);
    const std::vector<Plate> plates = choose(find_plates(scenes), o.names);
    make_output_folder(o.folder);
    for (const Plate& plate : plates)
        check_image_output(fs::path(o.folder) / (plate.name + ".png"));
    for (const Plate& plate : plates) {
        const fs::path file = fs::path(o.folder) / (plate.name + ".png");
        std::vector<Image> tiles;
        for (const fs::path& scene : plate.scenes) {
            std::optional<Image> tile = picture(scene, o, invocation);
            if (!tile) {
                say("nacre: interrupted; {} was not written\n", file.string());
                return interrupted;
            }
            tiles.push_back(std::move(*tile));
        }
        write_image(plate.sheet ? compose(tiles) : tiles.front(), file);
        fmt::print("{}\n", file.string());
        for (const fs::path& scene : plate.scenes) fmt::print("  {}\n", caption(scene));
        std::fflush(stdout);
    }
    return success;
}

}  // namespace

Action set_up_gallery(CLI::App& app, const Invocation& invocation) {
    auto o = std::make_shared<GalleryArguments>();
    app.add_option("names", o->names, "pictures (default: all)");
    app.add_option("-o,--output", o->folder, "folder for the pictures")->required();
    add_number(app, "--scale", o->scale, {0, 16, true},
               "size of the pictures, times that of the scenes")
        ->default_str("1");
    add_samples(app, o->spp, "samples a pixel, instead of the scenes'");
    app.add_flag("--denoise", o->finish.denoise, "take the noise out (biased)");
    app.add_option("--scenes", o->scenes,
                   "folder of the scenes (default: those that come with nacre)");
    add_threads(app, o->threads);
    app.add_flag("--quiet", o->quiet, "no progress, only warnings and errors");
    return [o, invocation] { return run(*o, invocation); };
}

}  // namespace nacre::cli
