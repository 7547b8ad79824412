#pragma once
// The page of reports, as CMake found it in src/nacre/report/page.
#include <string_view>

namespace nacre {

extern const std::string_view page_html, page_style, page_script;

}  // namespace nacre
