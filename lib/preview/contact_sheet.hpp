#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "preview/map_picture.hpp"

namespace d2b {

/// Trials on one page: how many, in how many columns, and the longest side of the page.
struct SheetPlan {
    std::size_t trials = 1;
    int columns = 1;
    int longest = 1;
};

/// @param across trials that belong into one row where there is room for them
[[nodiscard]] SheetPlan plan_sheet(std::size_t trials, std::size_t across, int longest);

/// Of each map on the sheet.
[[nodiscard]] PixelSize map_on_sheet(const MapGround& ground, const SheetPlan& plan);

struct TrialPicture {
    std::string caption;  ///< what was tried
    MapPicture map;       ///< of the size of map_on_sheet()
};

/// Maps side by side, each below its caption, row by row, with one legend. @param trials at least one
/// @return the file @throws OutputError
[[nodiscard]] std::string draw_contact_sheet(std::span<const TrialPicture> trials, const SheetPlan& plan,
                                             PictureFormat format);

}  // namespace d2b
