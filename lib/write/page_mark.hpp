#pragma once

#include <string_view>

namespace d2b {

/// Marker at the begin of our pages, so that no other HTML file is replaced.
inline constexpr std::string_view page_mark = "<!DOCTYPE html>\n<!-- A page of dem2buildings -->\n";

/// True if a file begins like one of our pages.
[[nodiscard]] inline bool begins_a_page(std::string_view beginning) {
    return beginning.starts_with(page_mark);
}

}  // namespace d2b
