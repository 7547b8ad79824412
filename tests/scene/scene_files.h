#pragma once
// Scene files for tests, in a folder of their own that goes away again.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "nacre/math/error.h"
#include "nacre/scene/load.h"

namespace nacre {

class SceneFiles : public testing::Test {
  protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ =
            std::filesystem::path(testing::TempDir()) /
            fmt::format("nacre_scene_{}_{}_{}", getpid(), info->test_suite_name(), info->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    SceneNodePtr read(const std::string& body, std::map<std::string, std::string> defines = {}) {
        search_path_.clear();
        return read_scene_xml(
            write("scene.xml", "<scene version=\"3.0.0\">\n" + body + "\n</scene>\n"), defines,
            search_path_);
    }
    /// The message with which `action` throws an InputError, without the folder.
    template <class F>
    std::string error_of(F&& action) const {
        try {
            action();
        } catch (const InputError& e) {
            std::string text = e.what();
            for (const std::string& prefix : {folder_.string() + "/", folder_.string()})
                for (std::size_t i = text.find(prefix); i != text.npos; i = text.find(prefix))
                    text.erase(i, prefix.size());
            return text;
        }
        return "no error";
    }

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> search_path_;
};

}  // namespace nacre
