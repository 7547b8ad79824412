#include "nacre/scene/xml/find_file.h"

#include <fmt/format.h>

#include "nacre/image/image.h"
#include "nacre/math/error.h"

namespace nacre {

std::filesystem::path find_file(const std::string& name,
                                const std::vector<std::filesystem::path>& folders,
                                const std::string& where) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (name.empty()) throw InputError(fmt::format("{}: the file name is empty", where));
    if (fs::path(name).is_absolute()) {
        if (fs::is_regular_file(without_layer(name), ignored)) return name;
        throw InputError(fmt::format("{}: cannot find '{}'", where, name));
    }
    std::string searched;
    for (const fs::path& folder : folders) {
        const fs::path candidate = folder / name;
        if (fs::is_regular_file(without_layer(candidate), ignored)) return candidate;
        searched += (searched.empty() ? "" : ", ") + (folder.empty() ? "." : folder.string());
    }
    throw InputError(fmt::format("{}: cannot find '{}'; searched in: {}", where, name, searched));
}

}  // namespace nacre
