#include "apps/viewer/window.h"

// GLFW's own OpenGL headers would come between epoxy and the library.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/controls.h"
#include "apps/viewer/save_scene.h"
#include "apps/viewer/script.h"
#include "nacre/math/error.h"

namespace nacre::viewer {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const std::string& what) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw RunError(
        fmt::format("{}{}{}; without a window, 'nacre view SCENE --screenshot out.png' makes "
                    "pictures of the same",
                    what, reason ? ": " : "", reason ? reason : ""));
}

/// GLFW, its window and its context, which is current.
class GlWindow {
  public:
    GlWindow(int width, int height, double ui_scale, const std::string& title) {
        if (!glfwInit()) fail("no window can be opened");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
        glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_FALSE);
        window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
        if (!window_) {
            const char* reason = nullptr;
            glfwGetError(&reason);
            const std::string text = reason ? reason : "";
            glfwTerminate();
            fail(fmt::format("no window with OpenGL 4.5 can be opened{}{}",
                             text.empty() ? "" : ": ", text));
        }
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
        glfwSetWindowUserPointer(window_, this);
        glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
            if (action == GLFW_PRESS)
                static_cast<GlWindow*>(glfwGetWindowUserPointer(window))->keys_.push_back(key);
        });
        float x = 1, y = 1;
        glfwGetWindowContentScale(window_, &x, &y);
        scale = ui_scale > 0 ? float(ui_scale) : std::max(1.f, x);
    }
    ~GlWindow() {
        glfwDestroyWindow(window_);
        glfwTerminate();
    }
    GlWindow(const GlWindow&) = delete;
    GlWindow& operator=(const GlWindow&) = delete;
    GLFWwindow* get() const { return window_; }
    /// Keys that went down since the last call. In slow frames they are up again when ImGui looks.
    std::vector<int> take_keys() { return std::exchange(keys_, {}); }

    float scale = 1;  // of letters and controls

  private:
    GLFWwindow* window_ = nullptr;
    std::vector<int> keys_;
};

/// Dear ImGui in that window.
class Controls {
  public:
    explicit Controls(const GlWindow& window) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        ImFontConfig font;
        // The built-in letters are drawn for 13 pixels, and sharp at whole multiples of that.
        font.SizePixels = std::floor(13 * std::max(1.f, window.scale));
        io.Fonts->AddFontDefault(&font);
        ImGui::StyleColorsDark();
        ImGui::GetStyle().ScaleAllSizes(window.scale);
        ImGui_ImplGlfw_InitForOpenGL(window.get(), true);
        ImGui_ImplOpenGL3_Init("#version 450 core");
    }
    ~Controls() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    Controls(const Controls&) = delete;
    Controls& operator=(const Controls&) = delete;
};

/// "view-1.png", or the first such name that is free.
std::filesystem::path free_name(const std::string& stem, const std::string& extension) {
    for (int i = 1;; ++i)
        if (std::filesystem::path name = fmt::format("{}-{}{}", stem, i, extension);
            !std::filesystem::exists(name))
            return name;
}

constexpr int panel_width = 340;   // at a scale of 1
constexpr int most_frames = 4096;  // of an average

class ViewerWindow {
  public:
    ViewerWindow(const ViewerScene& scene, const ViewOptions& options)
        : scene_(scene),
          options_(options),
          window_(int(panel_width * std::max(1., options.ui_scale)) + options.width,
                  std::max(options.height, 480), options.ui_scale, "nacre: " + scene.name),
          ui_(window_),
          frames_(gpu_, scene, Patience::none),
          first_(scene.state()) {
        controls_.light = scene.key_light;
        controls_.device = gpu_.device().text();
        options.say("device: " + controls_.device);
        // A processor draws a hundredth of what a GPU does: frames come first.
        if (gpu_.device().software) {
            first_.quality.light_points = 2;
            first_.quality.light_view = 256;
            controls_.resolution = 2;
        }
        if (options.light_view) first_.quality.light_view = checked_light_view(options.light_view);
        if (options.light_points) first_.quality.light_points = options.light_points;
        state_ = first_;
        if (!options.script.empty())
            for (const ScriptLine& line : read_script(options.script, scene))
                if (obey(line.text, scene, state_).kind != Step::Kind::change)
                    throw InputError(fmt::format(
                        "{}:{}: in a window scripts only change what is shown; give --screenshot",
                        options.script.string(), line.number));
        good_ = state_;
    }

    void run() {
        while (!glfwWindowShouldClose(window_.get())) {
            // A still picture that is as good as it gets waits for the user.
            if (idle_)
                glfwWaitEventsTimeout(0.1);
            else
                glfwPollEvents();
            frame();
        }
    }

  private:
    void frame() {
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        Requests requests;
        keys(requests);
        const float panel = controls_.hidden ? 0.f : panel_width * window_.scale;
        if (!controls_.hidden) draw_panel(panel, requests);
        draw_picture(panel);
        if (controls_.help) draw_help(controls_, window_.scale);
        ImGui::Render();
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_.get(), &width, &height);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        glfwSwapBuffers(window_.get());
        follow(requests);
    }

    void draw_panel(float width, Requests& requests) {
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({width, ImGui::GetIO().DisplaySize.y});
        ImGui::Begin("panel", nullptr,
                     ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings);
        draw_controls(scene_, frames_, state_, controls_, requests);
        ImGui::End();
    }

    void draw_picture(float left) {
        const ImVec2 all = ImGui::GetIO().DisplaySize;
        const ImVec2 size{std::max(all.x - left, 16.f), std::max(all.y, 16.f)};
        render(size);
        ImGui::SetNextWindowPos({left, 0});
        ImGui::SetNextWindowSize(size);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
        ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
        ImGui::Begin("picture", nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                         ImGuiWindowFlags_NoScrollWithMouse);
        if (shown_) ImGui::Image(ImTextureID(std::intptr_t(shown_)), size);
        ImGui::SetCursorPos({0, 0});
        ImGui::InvisibleButton("picture", size,
                               ImGuiButtonFlags_MouseButtonLeft |
                                   ImGuiButtonFlags_MouseButtonRight |
                                   ImGuiButtonFlags_MouseButtonMiddle);
        pointer(left, size);
        ImGui::End();
        ImGui::PopStyleVar(2);
    }

    /// One frame more, unless everything is as good as it gets.
    void render(const ImVec2& size) {
        const Clock::time_point now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - last_frame_).count();
        last_frame_ = now;
        if (state_.animated && state_.deformation.kind != Deformation::Kind::none)
            state_.deformation.phase += swing_per_second * float(std::min(seconds, 0.25));
        const int width = std::max(1, int(size.x) / controls_.resolution),
                  height = std::max(1, int(size.y) / controls_.resolution);
        const bool changed = !(state_ == rendered_) || width != width_ || height != height_;
        const bool enough = std::ranges::all_of(frames_.sides(), [](const auto& side) {
            return is_realtime({side.technique}) && side.samples >= most_frames;
        });
        if (!changed && (!frames_.goes_on() || enough)) {
            idle_ = true;
            return;
        }
        idle_ = false;
        try {
            if (controls_.timings) gpu_.begin_timing();
            frames_.render(state_, width, height);
            shown_ = frames_.shown(state_).name();
            if (controls_.timings) controls_.passes = gpu_.end_timing();
            good_ = state_;
        } catch (const InputError& error) {
            gpu_.end_timing();
            controls_.message = error.what();
            controls_.is_error = true;
            // Back to what worked. What is refused late was refused by a technique in the
            // background; what never worked is told to the caller.
            if (state_ == good_) {
                state_.split = false;
                state_.technique = first_.technique;
                if (state_ == good_) throw;
                good_ = state_;
            }
            state_ = good_;
            return;
        }
        rendered_ = state_;
        // What comes from the background need not be asked for all the time.
        idle_ = std::ranges::none_of(
            frames_.sides(), [](const auto& side) { return is_realtime({side.technique}); });
        width_ = width;
        height_ = height;
        controls_.bytes = frames_.bytes();
        controls_.frame_ms.push_back(
            std::chrono::duration<float, std::milli>(Clock::now() - now).count());
        if (controls_.frame_ms.size() > 120) controls_.frame_ms.pop_front();
        const std::string title =
            fmt::format("nacre: {} - {}{}", scene_.name, state_.technique.technique,
                        state_.split ? " | " + state_.beside.technique : "");
        if (title != title_) glfwSetWindowTitle(window_.get(), title.c_str());
        title_ = title;
    }

    void pointer(float left, const ImVec2& size) {
        const ImGuiIO& io = ImGui::GetIO();
        const float line = left + float(state_.divider) * size.x;
        const bool on_line = state_.split && std::abs(io.MousePos.x - line) < 5 * window_.scale;
        if (ImGui::IsItemHovered() && on_line) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        if (ImGui::IsItemActivated()) drags_line_ = on_line && ImGui::IsMouseDown(0);
        if (ImGui::IsItemHovered() && io.MouseWheel != 0)
            state_.camera.zoom(std::pow(0.9, double(io.MouseWheel)));
        // What the pointer did before it was pressed, it did for others.
        if (!ImGui::IsItemActive() || ImGui::IsItemActivated() ||
            (io.MouseDelta.x == 0 && io.MouseDelta.y == 0))
            return;
        const double dx = double(io.MouseDelta.x), dy = double(io.MouseDelta.y);
        // Once across the picture is half a turn.
        const double degrees = 180. / double(size.y);
        if (drags_line_) {
            state_.divider = std::clamp(double(io.MousePos.x - left) / double(size.x), 0.02, 0.98);
        } else if (io.KeyCtrl) {
            if (!scene_.lights.empty() && scene_.lights[controls_.light].turns) {
                LightEdit& edit = state_.lights[controls_.light];
                edit.azimuth += dx * degrees;
                edit.elevation = std::clamp(edit.elevation - dy * degrees, -89., 89.);
            }
        } else if (io.KeyShift || ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2)) {
            state_.camera.pan(dx / double(size.y), -dy / double(size.y));
        } else {
            state_.camera.turn(-dx * degrees, dy * degrees);
        }
    }

    void keys(Requests& requests) {
        const ImGuiIO& io = ImGui::GetIO();
        const std::vector<int> down = window_.take_keys();
        if (io.WantTextInput) return;
        const auto pressed = [&](int key) { return std::ranges::find(down, key) != down.end(); };
        for (const ImWchar c : io.InputQueueCharacters) {
            if (c == '?') controls_.help = !controls_.help;
            if (c == '+' || c == '=') state_.display.exposure += 0.25f;
            if (c == '-') state_.display.exposure -= 0.25f;
        }
        if (pressed(GLFW_KEY_F1)) controls_.help = !controls_.help;
        const auto all = viewer_techniques();
        for (int i = 0; i < std::min(9, int(all.size())); ++i)
            if (pressed(GLFW_KEY_1 + i))
                state_.technique = {std::string(all[std::size_t(i)]->name)};
        if (pressed(GLFW_KEY_SPACE)) state_.split = !state_.split;
        if (pressed(GLFW_KEY_L) && !scene_.lights.empty())
            controls_.light = (controls_.light + 1) % scene_.lights.size();
        if (pressed(GLFW_KEY_D)) state_.animated = !state_.animated;
        if (pressed(GLFW_KEY_A)) state_.quality.average = !state_.quality.average;
        if (pressed(GLFW_KEY_F)) {
            Display& d = state_.display;
            d.quantity = Quantity((int(d.quantity) + 1) % 3);
            if (d.quantity != Quantity::color) std::tie(d.low, d.high) = usual_scale(d.quantity);
        }
        if (pressed(GLFW_KEY_R)) state_.camera = first_.camera;
        if (pressed(GLFW_KEY_H)) controls_.hidden = !controls_.hidden;
        requests.png |= pressed(GLFW_KEY_S);
        requests.exr |= pressed(GLFW_KEY_E);
        requests.save |= pressed(GLFW_KEY_W);
        if (pressed(GLFW_KEY_ESCAPE)) {
            if (controls_.help)
                controls_.help = false;
            else
                glfwSetWindowShouldClose(window_.get(), GLFW_TRUE);
        }
    }

    void follow(const Requests& requests) {
        if (!requests.png && !requests.exr && !requests.save) return;
        idle_ = false;
        const std::string stem = std::filesystem::path(scene_.name).stem().string();
        try {
            std::vector<std::string> written, left_out;
            for (const auto& [wanted, extension] :
                 {std::pair{requests.png, ".png"}, {requests.exr, ".exr"}}) {
                if (!wanted) continue;
                written.push_back(free_name(stem, extension).string());
                write_screenshot(frames_, state_, options_, written.back());
            }
            if (requests.save) {
                const SavedScene saved =
                    save_scene(scene_, state_, width_, height_, free_name(stem, ".xml"));
                for (const auto& file : saved.files) written.push_back(file.string());
                left_out = saved.left_out;
            }
            controls_.message =
                fmt::format("wrote {}{}{}", fmt::join(written, ", "),
                            left_out.empty() ? "" : "; left out: ", fmt::join(left_out, "; "));
            controls_.is_error = false;
        } catch (const std::runtime_error& error) {  // of the user's folder, or of the scene
            controls_.message = error.what();
            controls_.is_error = true;
        }
    }

    const ViewerScene& scene_;
    const ViewOptions& options_;
    GlWindow window_;
    Controls ui_;
    Gpu gpu_;
    ViewerFrames frames_;
    ViewerState first_, state_, good_, rendered_;
    ControlState controls_;
    Clock::time_point last_frame_ = Clock::now();
    std::string title_;
    std::uint32_t shown_ = 0;  // texture
    int width_ = 0, height_ = 0;
    bool idle_ = false, drags_line_ = false;
};

}  // namespace

void view_in_window(const ViewerScene& scene, const ViewOptions& options) {
    ViewerWindow(scene, options).run();
}

}  // namespace nacre::viewer
