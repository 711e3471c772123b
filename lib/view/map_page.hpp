#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "view/map_picture.hpp"
#include "write/file_target.hpp"

namespace d2b::view {

/// Returns the size of the map on a page. @param longest side of the page
[[nodiscard]] PixelSize map_size_on_page(const MapArea& area, int longest);

/// Draws a map with legend, scale bar, north arrow, number of buildings and source.
/// @param map has the size of map_size_on_page() @param parameters options that shaped the result
/// @param longest side of the page @return content of the file @throws OutputError
[[nodiscard]] std::string draw_map_page(const MapPicture& map, const std::string& parameters,
                                        writing::PictureFormat format, int longest);

/// Arrangement of trials on one page: number of trials, columns, and longest side of the page.
struct SheetPlan {
    std::size_t trials = 1;
    int columns = 1;
    int longest = 1;
};

/// @param across preferred number of trials per row, used if they fit
[[nodiscard]] SheetPlan plan_sheet(std::size_t trials, std::size_t across, int longest);

/// Returns the size of each map on the sheet.
[[nodiscard]] PixelSize map_size_on_sheet(const MapArea& area, const SheetPlan& plan);

struct TrialPicture {
    std::string caption;  ///< option values of the trial
    MapPicture map;       ///< has the size of map_size_on_sheet()
};

/// Draws maps row by row, each below its caption, with one shared legend. @param trials at least one
/// @return content of the file @throws OutputError
[[nodiscard]] std::string draw_contact_sheet(std::span<const TrialPicture> trials, const SheetPlan& plan,
                                             writing::PictureFormat format);

}  // namespace d2b::view
