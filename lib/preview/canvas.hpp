#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace d2b {

using Colour = std::array<std::uint8_t, 3>;

/// Red, green and blue of every pixel, row by row from the top.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;

    [[nodiscard]] Colour at(int x, int y) const {
        const std::size_t i =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
        return {rgb[i], rgb[i + 1], rgb[i + 2]};
    }
};

/// In pixels of the image, from its upper left corner.
struct Spot {
    double x = 0;
    double y = 0;
};

/// A picture that is drawn on twice as finely as it is shown, so that its lines are smooth.
class Canvas {
  public:
    static constexpr int fineness = 2;

    Canvas(int width, int height, Colour paper);

    [[nodiscard]] int width() const { return fine_.width / fineness; }
    [[nodiscard]] int height() const { return fine_.height / fineness; }

    /// One pixel of the shown picture.
    void dot(int x, int y, Colour colour);
    /// What an odd number of the rings goes round. @param rings not closed by a repeated spot
    void fill(std::span<const std::vector<Spot>> rings, Colour colour);
    /// A closed line, half a pixel wide.
    void outline(const std::vector<Spot>& ring, Colour colour);
    void box(int x, int y, int width, int height, Colour colour);
    /// In capitals of `size` pixels a dot (letters are 3 dots wide and 5 high), left-aligned.
    void text(int x, int y, int size, std::string_view text, Colour colour);

    [[nodiscard]] Image shown() const;

  private:
    void set(int x, int y, Colour colour);

    Image fine_;
};

/// How wide a text is.
[[nodiscard]] int text_width(int size, std::string_view text);

}  // namespace d2b
