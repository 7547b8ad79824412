#include "nacre/measured/open_measured.h"

#include "nacre/measured/factor/factored_measured.h"
#include "nacre/measured/factor/textures.h"

namespace nacre {

std::unique_ptr<Measured> open_measured(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        return std::make_unique<FactoredMeasured>(read_factors(path));
    return read_measured(path);
}

}  // namespace nacre
