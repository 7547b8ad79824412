#include "apps/cli/model_docs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/cli/finish_picture.h"
#include "apps/cli/model_page.h"
#include "apps/cli/plot.h"
#include "nacre/catalogue/describe.h"
#include "nacre/math/error.h"
#include "nacre/reflectance/registry.h"
#include "nacre/render/output.h"
#include "nacre/scene/load.h"
#include "nacre/text/whole_file.h"

namespace nacre::cli {
namespace {

namespace fs = std::filesystem;

/// A key light above on the left and an even grey sky that keeps shadows readable and metals
/// visible, so that the shape of the highlight is the model's own. The sky's 0.117 is the sRGB code
/// 96: a background without dither keeps the pictures small. Depth 2: one reflection.
constexpr const char* sphere_scene = R"(<scene version="3.0.0">
    <!-- The sphere of the models' pages: nacre render sphere.xml -D model=ward --denoise -o ward.png -->
    <default name="model" value="lambert"/>
    <integrator type="path"><integer name="max_depth" value="2"/></integrator>
    <sensor type="perspective">
        <float name="fov" value="18"/>
        <transform name="to_world"><lookat origin="0, 0, 8" target="0, 0, 0" up="0, 1, 0"/></transform>
        <sampler type="sobol"><integer name="sample_count" value="32"/></sampler>
        <film type="hdrfilm"><integer name="width" value="256"/><integer name="height" value="256"/></film>
    </sensor>
    <shape type="sphere"><bsdf type="$model"/></shape>
    <shape type="rectangle">
        <transform name="to_world">
            <scale value="1.2"/><lookat origin="-4, 5, 6" target="0, 0, 0" up="0, 1, 0"/>
        </transform>
        <emitter type="area"><rgb name="radiance" value="30, 28.5, 26"/></emitter>
    </shape>
    <emitter type="constant"><rgb name="radiance" value="0.117, 0.117, 0.117"/></emitter>
</scene>
)";

/// A text in a cell of a table, where a bar would end it.
std::string cell(std::string_view text) {
    std::string r;
    for (char c : text) r += c == '|' ? std::string("\\|") : std::string(1, c);
    return r;
}

/// What Markdown would take for emphasis, links or tags stays what it is.
std::string plain(std::string_view text) {
    std::string r;
    for (char c : text)
        r += std::string_view("\\*_[]<|`").find(c) == std::string_view::npos
                 ? std::string(1, c)
                 : std::string("\\") + c;
    return r;
}

std::string code(std::string_view text) { return fmt::format("`{}`", cell(text)); }

std::string codes(const std::vector<std::string_view>& words) {
    std::string r;
    for (std::string_view w : words) r += (r.empty() ? "" : ", ") + code(w);
    return r;
}

std::string parameters_text(const ModelDescription& m) {
    std::string text =
        "| parameter | meaning | kind | range | unit | default | also called |\n"
        "|---|---|---|---|---|---|---|\n";
    for (const Parameter& p : m.parameters)
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", code(p.name),
                            plain(p.meaning), kind_name(p.kind),
                            p.kind == ParameterKind::choice ? "see below" : range_text(p),
                            plain(p.unit), code(default_text(p)), codes(p.aliases));
    for (const SumBound& b : m.bounds)
        text += fmt::format("\n{} must not exceed 1.\n",
                            code(fmt::format("{}", fmt::join(b.parameters, " + "))));
    for (const Parameter& p : m.parameters) {
        if (p.kind != ParameterKind::choice) continue;
        text += fmt::format("\n### {}: {}\n\n", code(p.name), plain(p.meaning));
        for (const Choice& c : p.choices)
            text += fmt::format("- {}{}: {}{}\n", code(c.name),
                                c.name == default_text(p) ? " (default)" : "", plain(c.meaning),
                                c.aliases.empty() ? "" : "; also " + codes(c.aliases));
    }
    return text;
}

/// Options and conditions of a claim.
std::string with_text(const Behaviour& b) {
    const std::string condition = condition_text(b);
    std::string text = b.options.empty() ? "" : code(b.options);
    if (!condition.empty()) text += (text.empty() ? "for " : ", for ") + plain(condition);
    return text;
}

std::string behaviour_text(const ModelDescription& m) {
    std::string text = "| with | reciprocal | conserves energy | |\n|---|---|---|---|\n";
    for (const Behaviour& b : m.behaviours)
        text += fmt::format("| {} | {} | {} | {} |\n", with_text(b), b.reciprocal ? "yes" : "no",
                            b.energy == Energy::conserves ? "yes" : "no", plain(b.energy_note));
    text += fmt::format("\n- Isotropy: {}\n- Sampling: {}\n", plain(m.isotropy), plain(m.sampling));
    if (!m.albedo.empty()) text += fmt::format("- Albedo: {}\n", plain(m.albedo));
    return text + fmt::format("\n{} puts these claims to the test.\n",
                              code(fmt::format("nacre check {}", m.name)));
}

std::string list_text(const char* heading, const std::vector<std::string_view>& items) {
    if (items.empty()) return "";
    std::string text = fmt::format("\n## {}\n\n", heading);
    for (std::string_view i : items) text += fmt::format("- {}\n", plain(i));
    return text;
}

std::string page_text(const ModelDescription& m) {
    std::string page = fmt::format("# {}\n\n{}, {}. {}.", plain(m.title), plain(m.authors), m.year,
                                   plain(m.paper));
    if (!m.equations.empty()) page += fmt::format(" Equations: {}.", plain(m.equations));
    page += fmt::format(
        "\n\n| lit sphere | lobes in the plane of incidence |\n|---|---|\n"
        "| ![sphere]({0}-sphere.png) | ![lobes]({0}-lobe.svg) |\n\n"
        "Both with the default parameters. The sphere is [sphere.xml](sphere.xml), denoised; the "
        "lobes "
        "are the BRDF at 550 nm, with the light on the left at the angles of the key.\n",
        m.name);
    page += fmt::format("\n## Formula\n\nBRDF in sr^-1, without the cosine.\n\n```text\n{}\n```\n",
                        m.formula);
    page += fmt::format("\n## Parameters\n\nOf {} and of {}.\n\n{}",
                        code(fmt::format("<bsdf type=\"{}\">", m.name)),
                        code(fmt::format("nacre eval {} --set name=value", m.name)),
                        parameters_text(m));
    page += "\n## Behaviour\n\n" + behaviour_text(m);
    page += list_text("Errata of the literature", m.errata);
    page += list_text("References", m.references);
    return page + "\n[All models](README.md)\n";
}

/// "yes", "no", or by which option it depends.
template <class F>
std::string over_behaviours(const ModelDescription& m, F&& holds) {
    const auto count = std::count_if(m.behaviours.begin(), m.behaviours.end(), holds);
    if (count == 0) return "no";
    return std::size_t(count) == m.behaviours.size() ? "yes" : "by option";
}

std::string index_text() {
    std::string page =
        "# Reflectance models\n\n"
        "Each model in its original form, with its variants and errata as named options. Made from "
        "the models' own descriptions by `nacre models docs docs/models`; `nacre models show NAME` "
        "prints the same in the terminal.\n\n"
        "| | name | model | authors, year | reciprocal | conserves energy |\n"
        "|---|---|---|---|---|---|\n";
    for (const ModelDescription* m : models())
        page += fmt::format(
            "| <img src=\"{0}-sphere.png\" alt=\"{0}\" width=\"96\"> | [{0}]({0}.md) | {1} | {2}, "
            "{3} | {4} | {5} |\n",
            m->name, plain(m->title), plain(m->authors), m->year,
            over_behaviours(*m, [](const Behaviour& b) { return b.reciprocal; }),
            over_behaviours(*m, [](const Behaviour& b) { return b.energy == Energy::conserves; }));
    return page;
}

/// The BRDF over the viewer's angle, the light at three angles on the other side of the normal.
Table model_lobe_table(const AnyModel& model) {
    constexpr double incidences[] = {0., 30., 60.};
    const auto in_plane = [](double degrees) {
        const double a = degrees * std::numbers::pi / 180.;
        return Vec3d{std::sin(a), 0., std::cos(a)};
    };
    Table t{fmt::format("{}: default parameters", model.description().name),
            {"theta_o_deg"},
            {},
            PlotKind::polar,
            "BRDF / sr⁻¹, as distance from the origin; light from the left"};
    t.names = {""};
    for (double a : incidences) {
        t.columns.push_back(fmt::format("theta_i={:g}", a));
        t.names.push_back(fmt::format("incidence {:g}°", a));
    }
    // A step of one and a half degrees follows these lobes, meets their mirror directions, and
    // keeps the picture small.
    for (int i = -59; i <= 59; ++i) {
        const double out = 1.5 * i;
        std::vector<double> row{out};
        for (double a : incidences) row.push_back(model.eval(in_plane(-a), in_plane(out)));
        t.rows.push_back(std::move(row));
    }
    return t;
}

void write_pictures(const ModelDescription& m, const fs::path& folder,
                    const Invocation& invocation) {
    const std::string name(m.name);
    draw_table(model_lobe_table(make_model(name)), folder / (name + "-lobe.svg"));
    LoadOptions options;
    options.defines = {{"model", name}};
    const fs::path file = folder / "sphere.xml";
    const Scene scene = load_scene(file, options);
    RenderOptions halves;
    halves.halves = true;
    const RenderResult result = render(scene, halves);
    Image picture =
        render_image(result, scene, {invocation.command_line, version, file.filename().string()});
    FinishOptions finish;
    finish.denoise = true;
    const std::atomic<bool> never{false};  // Ctrl-C ends the program, and leaves no picture noisy
    finish_picture(picture, result, scene, finish, 0, never);
    write_image(picture, folder / (name + "-sphere.png"));
}

}  // namespace

int write_model_docs(const fs::path& folder, DocsPart part, const Invocation& invocation) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw RunError(
            fmt::format("cannot make the folder '{}': {}", folder.string(), error.message()));
    write_whole_file(folder / "README.md", index_text());
    write_whole_file(folder / "sphere.xml", sphere_scene);
    for (const ModelDescription* m : models()) {
        write_whole_file(folder / fmt::format("{}.md", m->name), page_text(*m));
        if (part == DocsPart::all) write_pictures(*m, folder, invocation);
    }
    return success;
}

}  // namespace nacre::cli
