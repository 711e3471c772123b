#pragma once

#include <string_view>

namespace d2b {

/// How every page of ours begins, so that no other HTML is taken for one and replaced.
inline constexpr std::string_view page_mark = "<!DOCTYPE html>\n<!-- A page of dem2buildings -->\n";

/// Whether a file begins as a page of ours does.
[[nodiscard]] inline bool begins_a_page(std::string_view beginning) {
    return beginning.starts_with(page_mark);
}

}  // namespace d2b
