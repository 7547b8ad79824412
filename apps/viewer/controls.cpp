#include "apps/viewer/controls.h"

#include <fmt/format.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>

#include "nacre/math/error.h"
#include "nacre/optics/media.h"
#include "nacre/text/number.h"

namespace nacre::viewer {
namespace {

void explain(std::string_view text) {
    if (!text.empty() && ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28);
        ImGui::TextUnformatted(text.data(), text.data() + text.size());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
}

/// A list to choose from that opens when it is touched; returns whether another was chosen.
template <class Names>
bool choose(const char* label, const Names& names, std::size_t& chosen) {
    bool changed = false;
    const std::string current(names[chosen]);
    if (!ImGui::BeginCombo(label, current.c_str(), ImGuiComboFlags_HeightLarge)) return false;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (ImGui::Selectable(std::string(names[i]).c_str(), i == chosen) && i != chosen) {
            chosen = i;
            changed = true;
        }
        if (i == chosen) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
    return changed;
}

/// Puts what a typed value was refused for into the message.
template <class F>
void attempt(ControlState& controls, F&& f) {
    try {
        f();
        controls.message.clear();
    } catch (const InputError& error) {
        controls.message = error.what();
        controls.is_error = true;
    }
}

void draw_option(TechniqueChoice& choice, const Parameter& p, ControlState& controls) {
    const std::string name(p.name), now = option_of(choice, p);
    const auto set = [&](const std::string& value) {
        attempt(controls, [&] { set_option(choice, name, value); });
    };
    const std::string label = p.unit.empty() ? name : fmt::format("{} ({})", name, p.unit);
    if (p.kind == ParameterKind::choice) {
        std::vector<std::string_view> words;
        for (const Choice& c : p.choices) words.push_back(c.name);
        std::size_t at = std::size_t(std::ranges::find(words, now) - words.begin());
        if (at < words.size() && choose(label.c_str(), words, at)) set(std::string(words[at]));
        explain(p.meaning);
        return;
    }
    const double value = parse_number(now).value_or(p.otherwise);
    const bool bounded = std::isfinite(p.low) && std::isfinite(p.high);
    if (p.kind == ParameterKind::integer) {
        int whole = int(value);
        const bool changed = bounded
                                 ? ImGui::SliderInt(label.c_str(), &whole, int(p.low), int(p.high))
                                 : ImGui::DragInt(label.c_str(), &whole);
        if (changed) set(fmt::format("{}", whole));
    } else {
        float number = float(value);
        const float step = std::max(1e-3f, 0.01f * std::abs(number));
        const bool changed = bounded ? ImGui::SliderFloat(label.c_str(), &number, float(p.low),
                                                          float(p.high), "%.4g")
                                     : ImGui::DragFloat(label.c_str(), &number, step, 0, 0, "%.4g");
        if (changed) set(fmt::format("{:g}", number));
    }
    explain(p.meaning);
}

void draw_options(TechniqueChoice& choice, ControlState& controls) {
    ImGui::PushID(choice.technique.c_str());
    for (const Parameter& p : techniques().find(choice.technique).parameters)
        draw_option(choice, p, controls);
    if (!choice.options.empty() && ImGui::SmallButton("defaults")) choice.options.clear();
    ImGui::PopID();
}

void draw_techniques(ViewerState& state, ControlState& controls) {
    ImGui::PushID("technique");
    bool in_real_time = false;
    const auto all = viewer_techniques();
    for (const TechniqueDescription* t : all) {
        const bool is_first = t == all.front();
        if (is_first || in_real_time != bool(t->realtime))
            ImGui::TextDisabled("%s", t->realtime ? "in real time" : "refined in the background");
        in_real_time = bool(t->realtime);
        if (ImGui::RadioButton(std::string(t->title).c_str(), state.technique.technique == t->name))
            state.technique = {std::string(t->name)};
        explain(fmt::format("{}\n{}{}\n{}", t->name, t->authors,
                            t->year ? fmt::format(" {}", t->year) : "", t->how));
    }
    draw_options(state.technique, controls);
    ImGui::PopID();
}

void draw_split(ViewerState& state, ControlState& controls) {
    ImGui::PushID("split");
    ImGui::Checkbox("another technique on the right", &state.split);
    if (state.split) {
        std::vector<std::string_view> names;
        for (const TechniqueDescription* t : viewer_techniques()) names.push_back(t->name);
        std::size_t at =
            std::size_t(std::ranges::find(names, state.beside.technique) - names.begin());
        if (choose("technique", names, at)) state.beside = {std::string(names[at])};
        draw_options(state.beside, controls);
        float divider = float(state.divider);
        if (ImGui::SliderFloat("divider", &divider, 0.05f, 0.95f, "%.2f")) state.divider = divider;
    }
    ImGui::PopID();
}

void draw_material(MaterialEdit& m) {
    static constexpr std::string_view kinds[] = {"of the scene", "measured medium", "coefficients",
                                                 "colour and radius"};
    std::size_t kind = std::size_t(m.kind);
    if (choose("matter", std::span(kinds), kind)) m.kind = MaterialEdit::Kind(kind);
    if (m.kind == MaterialEdit::Kind::scene) return;
    if (m.kind == MaterialEdit::Kind::measured) {
        std::vector<std::string_view> names = measured_media().names();
        names.emplace_back("skin");
        const MeasuredMedium* known = measured_media().look(m.name);
        std::size_t at = known ? std::size_t(std::ranges::find(names, known->name) - names.begin())
                               : names.size() - 1;
        if (choose("medium", names, at)) m.name = std::string(names[at]);
        return;
    }
    const auto three = [](const char* label, Vec3f& v, float low) {
        float values[3] = {v.x, v.y, v.z};
        if (ImGui::DragFloat3(label, values, 0.01f * std::max({v.x, v.y, v.z, 0.1f}), low, 1e5f,
                              "%.4g", ImGuiSliderFlags_AlwaysClamp))
            v = {values[0], values[1], values[2]};
    };
    if (m.kind == MaterialEdit::Kind::coefficients) {
        three("sigma_s' (1/mm)", m.sigma_s, 0);
        three("sigma_a (1/mm)", m.sigma_a, 0);
    } else {
        float color[3] = {m.color.x, m.color.y, m.color.z};
        if (ImGui::ColorEdit3("colour", color, ImGuiColorEditFlags_Float))
            m.color = {color[0], color[1], color[2]};
        explain("of a thick body in even light, linear RGB");
        three("radius (mm)", m.radius, 1e-3f);
    }
    ImGui::SliderFloat("index", &m.eta, 1.f, 2.5f, "%.3f", ImGuiSliderFlags_AlwaysClamp);
    explain("of refraction, over air");
}

void draw_lights(const ViewerScene& scene, ViewerState& state, ControlState& controls) {
    if (scene.lights.empty()) {
        ImGui::TextUnformatted("none that could be changed");
        return;
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        names.push_back(fmt::format("{}: {}{}", i + 1, i == scene.key_light ? "key, " : "",
                                    scene.lights[i].name));
    choose("light", names, controls.light);
    LightEdit& edit = state.lights[controls.light];
    if (scene.lights[controls.light].turns) {
        float azimuth = float(std::remainder(edit.azimuth, 360)), elevation = float(edit.elevation);
        // Sliders round: what nobody touched stays what it is.
        if (ImGui::SliderFloat("azimuth", &azimuth, -180, 180, "%.0f deg")) edit.azimuth = azimuth;
        explain("from the front towards the right; Ctrl and drag in the picture");
        if (ImGui::SliderFloat("elevation", &elevation, -89, 89, "%.0f deg"))
            edit.elevation = elevation;
    }
    float brightness = float(edit.brightness);
    if (ImGui::SliderFloat("brightness", &brightness, 0.f, 20.f, "x %.3g",
                           ImGuiSliderFlags_Logarithmic))
        edit.brightness = brightness;
    if (ImGui::SmallButton("as in the scene"))
        edit = {scene.lights[controls.light].azimuth, scene.lights[controls.light].elevation, 1};
}

void draw_form(ViewerState& state) {
    static constexpr std::string_view kinds[] = {"none", "twist", "bend", "breathe"};
    using Kind = Deformation::Kind;
    std::size_t kind = std::size_t(state.deformation.kind);
    if (choose("form", std::span(kinds), kind)) {
        state.deformation = {Kind(kind), Kind(kind) == Kind::breathe ? 0.15f : 0.6f,
                             Kind(kind) == Kind::breathe ? 1.5707963f : 0.f};
        if (kind == 0) state.deformation = {};
    }
    if (state.deformation.kind == Kind::none) return;
    ImGui::SliderFloat("amount", &state.deformation.amount, -3.f, 3.f, "%.2f");
    float phase = std::remainder(state.deformation.phase, 6.2831853f);
    if (ImGui::SliderFloat("phase", &phase, -3.1415926f, 3.1415926f, "%.2f"))
        state.deformation.phase = phase;
    ImGui::Checkbox("swings", &state.animated);
}

/// The scale of false colours with its numbers.
void draw_legend(const Display& d) {
    constexpr int steps = 64;
    const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < steps; ++i) {
        const Vec3f c = false_color((float(i) + 0.5f) / steps);
        list.AddRectFilled({at.x + width * float(i) / steps, at.y},
                           {at.x + width * float(i + 1) / steps, at.y + height},
                           ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 1.f}));
    }
    ImGui::Dummy({width, height});
    const char* unit = d.quantity == Quantity::luminance ? "cd/m^2" : "lx";
    ImGui::TextUnformatted(fmt::format("{:g}", d.low).c_str());
    const std::string high = fmt::format("{:g} {}", d.high, unit);
    ImGui::SameLine(width - ImGui::CalcTextSize(high.c_str()).x);
    ImGui::TextUnformatted(high.c_str());
}

void draw_picture(ViewerState& state, ControlState& controls) {
    Display& d = state.display;
    ImGui::SliderFloat("exposure", &d.exposure, -8, 8, "%.2f stops");
    static constexpr std::string_view quantities[] = {"colour", "luminance, cd/m^2",
                                                      "illuminance of a pixel, lx"};
    std::size_t quantity = std::size_t(d.quantity);
    if (choose("shows", std::span(quantities), quantity)) {
        d.quantity = Quantity(quantity);
        if (d.quantity != Quantity::color) std::tie(d.low, d.high) = usual_scale(d.quantity);
    }
    if (d.quantity != Quantity::color) {
        float low = float(std::log10(d.low)), high = float(std::log10(d.high));
        if (ImGui::DragFloatRange2("10^", &low, &high, 0.05f, -12, 12, "%.1f") && low < high) {
            d.low = std::pow(10., low);
            d.high = std::pow(10., high);
        }
        draw_legend(d);
    }
    ImGui::Checkbox("average frames while nothing changes", &state.quality.average);
    ImGui::SliderInt("places on lamps", &state.quality.light_points, 1, 64);
    static constexpr std::string_view widths[] = {"64", "128", "256", "512", "1024", "2048"};
    std::size_t width = 0;
    while (width + 1 < std::size(widths) && (64 << width) < state.quality.light_view) ++width;
    if (choose("light's picture", std::span(widths), width)) state.quality.light_view = 64 << width;
    static constexpr std::string_view resolutions[] = {"full", "half", "a third", "a quarter"};
    std::size_t resolution = std::size_t(controls.resolution) - 1;
    if (choose("resolution", std::span(resolutions), resolution))
        controls.resolution = int(resolution) + 1;
}

bool section(const char* title, bool open = true) {
    return ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

}  // namespace

void draw_timings(const ControlState& controls) {
    double sum = 0, most = 1e-6;
    for (const PassTime& p : controls.passes) {
        sum += p.ms;
        most = std::max(most, p.ms);
    }
    const std::vector<float> history(controls.frame_ms.begin(), controls.frame_ms.end());
    const float last = history.empty() ? 0.f : history.back();
    ImGui::PlotLines("##frames", history.data(), int(history.size()), 0,
                     fmt::format("frame {:.2f} ms, passes {:.2f} ms", last, sum).c_str(), 0.f,
                     FLT_MAX, {ImGui::GetContentRegionAvail().x, 3 * ImGui::GetFontSize()});
    for (const PassTime& p : controls.passes)
        ImGui::ProgressBar(float(p.ms / most), {-1, 0},
                           fmt::format("{} {:.3f} ms", p.name, p.ms).c_str());
    ImGui::Text("device memory %.1f MB", double(controls.bytes) * 1e-6);
}

void draw_controls(const ViewerScene& scene, const ViewerFrames& frames, ViewerState& state,
                   ControlState& controls, Requests& requests) {
    ImGui::PushItemWidth(ImGui::GetFontSize() * 12);
    ImGui::TextWrapped("%s", controls.device.c_str());
    for (const auto& side : frames.sides())
        ImGui::TextWrapped(
            "%s: %s", side.technique.c_str(),
            side.waits ? "preparing"
                       : fmt::format("{} {}", side.samples,
                                     is_realtime({side.technique}) ? "frames" : "samples a pixel")
                             .c_str());
    if (!controls.message.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, controls.is_error ? ImVec4(1, 0.55f, 0.45f, 1)
                                                               : ImVec4(0.6f, 1, 0.6f, 1));
        ImGui::TextWrapped("%s", controls.message.c_str());
        ImGui::PopStyleColor();
    }
    if (ImGui::Button("help (F1)")) controls.help = !controls.help;
    ImGui::SameLine();
    if (ImGui::Button("PNG")) requests.png = true;
    ImGui::SameLine();
    if (ImGui::Button("EXR")) requests.exr = true;
    ImGui::SameLine();
    if (ImGui::Button("scene")) requests.save = true;
    explain("save what is shown as a scene file");
    if (section("technique")) draw_techniques(state, controls);
    if (section("side by side")) draw_split(state, controls);
    if (section("material")) draw_material(state.material);
    if (section("lights")) draw_lights(scene, state, controls);
    if (section("form", false)) draw_form(state);
    if (section("picture", false)) draw_picture(state, controls);
    controls.timings = section("times");
    if (controls.timings) draw_timings(controls);
    ImGui::PopItemWidth();
}

void draw_help(ControlState& controls, float scale) {
    static constexpr std::pair<const char*, const char*> lines[] = {
        {"drag", "turn the object"},
        {"right drag, Shift+drag", "move it"},
        {"wheel", "nearer, farther"},
        {"Ctrl+drag", "turn the chosen light"},
        {"drag the line", "between two techniques"},
        {"1 to 9", "technique of the list"},
        {"Space", "side by side on and off"},
        {"L", "next light"},
        {"D", "swing of the form on and off"},
        {"A", "average of frames on and off"},
        {"+ -", "exposure by a quarter of a stop"},
        {"F", "false colours: off, cd/m^2, lx"},
        {"R", "the camera as it was at first"},
        {"S, E", "picture as PNG, as EXR"},
        {"W", "save as a scene file"},
        {"H", "hide and show the controls"},
        {"F1, ?", "this list"},
        {"Esc", "close"}};
    ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x / 2, ImGui::GetIO().DisplaySize.y / 2},
                            ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({460 * scale, 0});
    ImGui::SetNextWindowBgAlpha(1);
    if (ImGui::Begin("keys and pointer", &controls.help, ImGuiWindowFlags_NoResize)) {
        if (ImGui::BeginTable("keys", 2)) {
            for (const auto& [key, what] : lines) {
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(key);
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(what);
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

}  // namespace nacre::viewer
