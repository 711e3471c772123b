#pragma once

#include <string_view>

namespace d2b::view {

/// Parts shared by all pages, embedded from view/page at build time.
struct PageParts {
    std::string_view html;           ///< page with placeholders such as @NAME@
    std::string_view style;          ///< CSS
    std::string_view script;         ///< JavaScript, including three.js
    std::string_view style_sha256;   ///< hexadecimal
    std::string_view script_sha256;  ///< hexadecimal
    std::string_view licence;        ///< licence of three.js
};

/// Returns nullptr if the library was built without them (D2B_BUILD_PAGE).
[[nodiscard]] const PageParts* page_parts();

}  // namespace d2b::view
