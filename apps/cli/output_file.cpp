#include "apps/cli/output_file.h"

#include <fmt/format.h>

#include "nacre/math/error.h"

namespace nacre::cli {

namespace fs = std::filesystem;

void refuse_input_as_output(const fs::path& output, const std::vector<fs::path>& inputs) {
    std::error_code error;
    for (const fs::path& input : inputs)
        if (!input.empty() && fs::equivalent(output, input, error))
            throw InputError(fmt::format(
                "{}: is read as well: it would be overwritten; name another output by -o",
                output.string()));
}

fs::path unused_name(const fs::path& file) {
    std::error_code error;
    fs::path name = file;
    for (int i = 2; fs::exists(name, error); ++i)
        name = file.parent_path() /
               fmt::format("{}-{}{}", file.stem().string(), i, file.extension().string());
    return name;
}

}  // namespace nacre::cli
