#pragma once

#include <functional>
#include <string>
#include <vector>

#include "view/cairo.hpp"
#include "view/map_frame.hpp"
#include "view/map_picture.hpp"
#include "write/file_target.hpp"

namespace d2b::view {

struct FootprintDrawing::Impl {
    PixelSize size;
    double line_width;
    SurfacePtr surface;
    CairoPtr pen;
};

/// Paints over the whole map, whose upper left corner is the origin of the pen.
void paint(const FootprintDrawing& footprints, cairo_t* pen);

/// Downsampled relief. Each sample is the mean of a square of cells, sized for about one sample per pixel; if
/// pixels are smaller than cells, each cell is a sample.
struct Relief::Impl {
    explicit Impl(const MapFrame& map);

    void add_row(std::span<const float> row);
    /// Completes a row of samples.
    void end_row();
    /// Shades the row of samples `here`.
    void shade_row(const std::vector<double>& below);

    MapFrame frame;
    int step;  ///< side of a square in cells
    int cols;  ///< number of sample columns
    int rows;
    std::int32_t rows_read = 0;  ///< rows of cells
    int rows_shaded = 0;         ///< rows of samples
    std::vector<double> sums;    ///< sums of the current row of samples
    std::vector<double> counts;  ///< counts of valid cells, likewise
    std::vector<double> above;   ///< row of samples before `here`
    std::vector<double> here;
    SurfacePtr image;
};

/// Paints over the whole map, whose upper left corner is the origin of the pen.
void paint(const Relief& relief, cairo_t* pen);

/// Paints relief and footprints with a frame around them. @param place upper left corner @param font font
/// size of the page
void paint(const MapPicture& map, cairo_t* pen, PixelPoint place, double font);

enum class Align { left, middle, right };

struct TextStyle {
    double size = 12;  ///< font size in pixels
    Colour colour = ink;
    bool bold = false;
    Align align = Align::left;
    double max_width = 0;  ///< maximum width, beyond which the middle is ellipsised; 0: unlimited
};

/// Distance between lines of small text, in font sizes.
inline constexpr double line_spacing = 1.35;

/// Draws a line of text in any script. @param place top of the line; left end, middle or right end, depending
/// on the alignment @param text in UTF-8; invalid bytes are shown as such @throws OutputError
void draw_text(cairo_t* pen, PixelPoint place, const TextStyle& style, const std::string& text);

/// Round length of a scale bar.
struct ScaleBarLength {
    double metres = 1;  ///< 1, 2 or 5 times a power of ten
    int parts = 2;      ///< number of segments, each of a round length
};

/// Returns the longest round length up to a maximum.
[[nodiscard]] ScaleBarLength scale_length(double max_metres);
/// Returns text such as "200 m" or "5 km", or "200 units" if the metres are unknown.
[[nodiscard]] std::string length_text(double length, bool metres);

/// Returns true if lengths on the ground are known in metres.
[[nodiscard]] bool in_metres(const Crs& crs);

/// @param place upper left corner @param max_width of the bar including half of the last label
/// @param metres true if the units of the frame are metres
void draw_scale_bar(cairo_t* pen, PixelPoint place, double max_width, double font, double metres_per_pixel,
                    bool metres);

/// Text below a map, or below several maps of the same scale.
struct FooterText {
    std::string legend;              ///< title of the legend
    std::vector<std::string> lines;  ///< first line dark, last line small and faint
};

/// Legend, scale bar and north arrow, side by side if they fit, with lines of text below.
class Footer {
  public:
    /// @param width total width @param font font size @param line_count number of text lines, at least one
    Footer(double width, double font, int line_count);

    [[nodiscard]] double height() const;
    /// Returns the minimum width, which is that of the legend.
    [[nodiscard]] static double min_width(double font);
    /// @param place upper left corner @param frame of the map, or of one of several
    void draw(cairo_t* pen, PixelPoint place, const MapFrame& frame, const FooterText& text) const;

  private:
    [[nodiscard]] bool side_by_side() const;

    double width_;
    double font_;
    int lines_;
};

/// Draws a picture on white paper and returns the content of its file. Deterministic: the file has no date. A
/// pixel of a PDF is 1/96 inch.
/// @param draw gets a pen in pixel units, origin in the upper left corner @throws OutputError
[[nodiscard]] std::string draw_page(PixelSize size, writing::PictureFormat format,
                                    const std::function<void(cairo_t* pen)>& draw);

}  // namespace d2b::view
