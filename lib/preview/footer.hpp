#pragma once

#include <optional>
#include <string>
#include <vector>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// What stands below a map, or below several of one scale.
struct FooterText {
    std::string legend;              ///< title of the legend
    std::vector<std::string> lines;  ///< the first in dark letters, the last in small faint ones
};

/// Legend, scale bar and north arrow, side by side where there is room, and lines of text.
class Footer {
  public:
    /// @param width of the whole @param font size of its letters @param lines of text, at least one
    Footer(double width, double font, int lines);

    [[nodiscard]] double height() const;
    /// Narrower than this the legend has no room.
    [[nodiscard]] static double least_width(double font);
    /// @param place upper left corner @param frame of the map, or of one of several
    void draw(cairo_t* pen, Spot place, const MapFrame& frame, const FooterText& text) const;

  private:
    [[nodiscard]] bool side_by_side() const;

    double width_;
    double font_;
    int lines_;
};

}  // namespace d2b
