#pragma once

#include <optional>
#include <string>
#include <vector>

#include "preview/cairo_handles.hpp"
#include "preview/map_frame.hpp"

namespace d2b {

/// Text below a map, or below several maps of the same scale.
struct FooterText {
    std::string legend;              ///< title of the legend
    std::vector<std::string> lines;  ///< first line dark, last line small and faint
};

/// Legend, scale bar and north arrow, side by side if they fit, with lines of text below.
class Footer {
  public:
    /// @param width total width @param font font size @param lines number of text lines, at least one
    Footer(double width, double font, int lines);

    [[nodiscard]] double height() const;
    /// Returns the minimum width, which is that of the legend.
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
