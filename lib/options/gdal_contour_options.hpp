#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace d2b {

/// Treatment of an option of gdal_contour, 3.6 to 3.11.
enum class OptionSupport {
    same,     ///< same meaning as there
    ignored,  ///< accepted without effect
    refused
};
inline constexpr std::array<std::string_view, 3> option_support_names{"same", "accepted", "refused"};

struct GdalContourOption {
    std::string_view name;      ///< without dash
    std::string_view synopsis;  ///< synopsis in the documentation of gdal_contour
    OptionSupport fate = OptionSupport::same;
    std::string_view note;  ///< reason for the treatment, as a clause; "" if it is the same
};

[[nodiscard]] std::span<const GdalContourOption> gdal_contour_options();

/// Returns the message for a refused option; "" for any other name. @param name without dashes
[[nodiscard]] std::string gdal_contour_refusal(std::string_view name);

}  // namespace d2b
