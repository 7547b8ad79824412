#pragma once
// Runs the program in a folder of its own, as a user does.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace nacre::test {

namespace fs = std::filesystem;

/// A sphere of a diffuse material in a constant light: a quick scene without other files.
inline constexpr const char* quick_scene = R"(<scene version="3.0.0">
    <default name="spp" value="2"/>
    <integrator type="path"/>
    <sensor type="perspective">
        <transform name="to_world">
            <lookat origin="0, 0, 5" target="0, 0, 0" up="0, 1, 0"/>
        </transform>
        <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
        <film type="hdrfilm">
            <integer name="width" value="24"/>
            <integer name="height" value="16"/>
            <rfilter type="box"/>
        </film>
    </sensor>
    <emitter type="constant"><rgb name="radiance" value="0.5, 0.5, 0.5"/></emitter>
    <shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="1, 1, 1"/></bsdf></shape>
</scene>
)";

struct Outcome {
    int code = -1;
    std::string out, err;
};

class CommandLine : public testing::Test {
  protected:
    void SetUp() override {
        if (!fs::exists(NACRE_BINARY)) GTEST_SKIP() << "no program at " << NACRE_BINARY;
        folder_ = fs::path(testing::TempDir()) /
                  fmt::format("nacre_cli_{}_{}", getpid(),
                              testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
        std::ofstream(folder_ / "quick.xml") << quick_scene;
        std::ofstream(folder_ / "flat.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    }
    void TearDown() override {
        if (!folder_.empty()) fs::remove_all(folder_);
    }

    std::string read(const fs::path& file) const {
        std::ifstream in(file);
        return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    }
    /// Runs `nacre arguments` in the test's folder.
    Outcome nacre(const std::string& arguments) const {
        const fs::path out = folder_ / "stdout", err = folder_ / "stderr";
        const std::string line = fmt::format("cd '{}' && '{}' {} >stdout 2>stderr",
                                             folder_.string(), program_, arguments);
        const int status = std::system(line.c_str());
        Outcome r{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(err)};
        fs::remove(out);
        fs::remove(err);
        return r;
    }
    /// Starts `nacre words` in the folder, standard error in the file `log`.
    pid_t start(std::vector<std::string> words, const std::string& log) const {
        words.insert(words.begin(), NACRE_BINARY);
        std::vector<char*> arguments;
        for (std::string& w : words) arguments.push_back(w.data());
        arguments.push_back(nullptr);
        const pid_t child = fork();
        if (child != 0) return child;
        signal(SIGHUP, SIG_DFL);
        if (chdir(folder_.c_str()) != 0 || !freopen(log.c_str(), "w", stderr)) _exit(99);
        execv(NACRE_BINARY, arguments.data());
        _exit(98);
    }
    /// Waits until a line of progress says that the work has begun.
    void wait_for(const std::string& log, const std::string& what) const {
        for (int i = 0; i < 600 && read(folder_ / log).find(what) == std::string::npos; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    /// Files beyond those that SetUp made.
    std::vector<std::string> written() const {
        std::vector<std::string> r;
        for (const auto& f : fs::directory_iterator(folder_))
            if (f.path().filename() != "quick.xml" && f.path().filename() != "flat.obj")
                r.push_back(f.path().filename().string());
        std::sort(r.begin(), r.end());
        return r;
    }
    fs::path folder_;
    std::string program_ = NACRE_BINARY;
};

}  // namespace nacre::test
