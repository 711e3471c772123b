#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace d2b {

/// One of GDAL's own switches, which all its programs have.
struct GdalSwitch {
    std::string_view synopsis;
    std::string_view help;
};
[[nodiscard]] const std::vector<GdalSwitch>& gdal_switches();
/// The section about them in --help and in a man page.
[[nodiscard]] std::string gdal_help();
[[nodiscard]] std::string gdal_man_section();

/// Sentence for the texts of all tools.
inline constexpr const char* options_anywhere =
    "Options may stand anywhere and begin with one dash or two; values follow after a blank or an equals "
    "sign.";

/// Breaks a text at blanks into lines, each after an indent. A word that is too long has a line of its own.
[[nodiscard]] std::string wrap(std::string_view text, std::size_t indent, std::size_t width = 80);

/// An option and its help: "  -lod <n>                How many thresholds." The help begins a line of its own
/// where the option is long.
[[nodiscard]] std::string help_entry(const std::string& option, const std::string& help);

}  // namespace d2b
