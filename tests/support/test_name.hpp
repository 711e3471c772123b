#pragma once

#include <cctype>
#include <string>

namespace d2b::test {

/// The name of a test's case, which may have letters, figures and underscores alone. @param text such as a
/// path
inline std::string case_name(std::string text) {
    for (char& c : text)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0)
            c = '_';
    return text;
}

}  // namespace d2b::test
