#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "dem2buildings/options.hpp"
#include "view/map_picture.hpp"
#include "write/file_target.hpp"

namespace d2b::view {

/// Texts of a page that the user chooses; "" for none.
struct PageWords {
    std::string title;
    std::string credit;
};
[[nodiscard]] PageWords page_words(const Options& options);

/// Arrangement of a map with its legend on a page.
struct PageLayout {
    PixelSize page;
    PixelSize map;
    double font = 0;
    double margin = 0;
    bool on_paper = false;  ///< the page has a fixed size
    std::string scale{};    ///< scale and paper, such as "1:1,000 on A3"; "" if there is none
};

/// Fits a page around the map. @param longest side of the page
[[nodiscard]] PageLayout plan_page(const MapArea& area, int longest, const PageWords& words = {});

/// Page of a fixed size, on which the map has a numeric scale.
struct PaperRequest {
    Paper paper = Paper::a4;
    bool landscape = false;
    std::optional<double> scale;  ///< denominator; by default a round one
};

/// Fits a map on paper. @throws OptionError if the area does not fit at the scale, or if the CRS has no known
/// unit
[[nodiscard]] PageLayout plan_paper(const MapArea& area, const PaperRequest& request,
                                    writing::PictureFormat format, const PageWords& words = {});

/// Draws a map with legend, scale bar, north arrow, number of buildings and source.
/// @param map has the size of the layout's map
/// @return content of the file @throws OutputError
[[nodiscard]] std::string draw_map_page(const MapPicture& map, writing::PictureFormat format,
                                        const PageLayout& layout, const PageWords& words = {});

/// Arrangement of trials on one page: number of trials, columns, and longest side of the page.
struct SheetPlan {
    std::size_t trials = 1;
    int columns = 1;
    int longest = 1;
    PageWords words{};
};

/// @param across preferred number of trials per row, used if they fit
[[nodiscard]] SheetPlan plan_sheet(std::size_t trials, std::size_t across, int longest, PageWords words = {});

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
