#pragma once

#include <string_view>

namespace d2b {

/// What all pages have in common, made of the files in write/page when the library is built.
struct PageParts {
    std::string_view html;           ///< with @NAMES@ where something is put in
    std::string_view style;          ///< CSS
    std::string_view script;         ///< JavaScript, with three.js in it
    std::string_view style_sha256;   ///< in hexadecimal digits
    std::string_view script_sha256;  ///< likewise
    std::string_view licence;        ///< of three.js
};

/// nullptr where the library was built without them (D2B_BUILD_PAGE).
[[nodiscard]] const PageParts* page_parts();

}  // namespace d2b
