#include "nacre/scene/xml/find_file.h"

#include <fmt/format.h>

#include "nacre/image/image.h"
#include "nacre/math/error.h"

namespace nacre {

std::filesystem::path find_file(const std::string& name,
                                const std::vector<std::filesystem::path>& folders,
                                const std::string& where, FindWhat what) {
    namespace fs = std::filesystem;
    const auto is_there = [what](const fs::path& path) {
        std::error_code ignored;
        return fs::is_regular_file(without_layer(path), ignored) ||
               (what == FindWhat::file_or_folder && fs::is_directory(path, ignored));
    };
    if (name.empty()) throw InputError(fmt::format("{}: the file name is empty", where));
    if (fs::path(name).is_absolute()) {
        if (is_there(name)) return name;
        throw InputError(fmt::format("{}: cannot find '{}'", where, name));
    }
    std::string searched;
    for (const fs::path& folder : folders) {
        const fs::path candidate = folder / name;
        if (is_there(candidate)) return candidate;
        searched += (searched.empty() ? "" : ", ") + (folder.empty() ? "." : folder.string());
    }
    throw InputError(fmt::format("{}: cannot find '{}'; searched in: {}", where, name, searched));
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) return {path};
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, ignored))
        if (entry.is_regular_file(ignored)) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

}  // namespace nacre
