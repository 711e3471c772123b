#include "preview/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "preview/letters.hpp"

namespace d2b {
namespace {

/// Where the rings cross the middle of a row of fine pixels, from left to right.
std::vector<double> crossings(std::span<const std::vector<Spot>> rings, double y) {
    std::vector<double> found;
    for (const auto& ring : rings)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Spot& a = ring[i];
            const Spot& b = ring[(i + 1) % ring.size()];
            if ((a.y <= y) != (b.y <= y))
                found.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
        }
    std::ranges::sort(found);
    return found;
}

/// The first pixel whose middle is not left of a place, within an image.
int first_pixel(double place, int width) {
    return static_cast<int>(std::clamp(std::ceil(place - 0.5), 0.0, static_cast<double>(width)));
}

}  // namespace

Canvas::Canvas(int width, int height, Colour paper)
    : fine_{width * fineness, height * fineness,
            std::vector<std::uint8_t>(static_cast<std::size_t>(width * fineness) *
                                      static_cast<std::size_t>(height * fineness) * 3)} {
    for (std::size_t i = 0; i < fine_.rgb.size(); ++i)
        fine_.rgb[i] = paper[i % 3];
}

void Canvas::set(int x, int y, Colour colour) {
    if (x < 0 || y < 0 || x >= fine_.width || y >= fine_.height)
        return;
    const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(fine_.width) +
                               static_cast<std::size_t>(x));
    std::ranges::copy(colour, fine_.rgb.begin() + static_cast<std::ptrdiff_t>(i));
}

void Canvas::dot(int x, int y, Colour colour) {
    box(x, y, 1, 1, colour);
}

void Canvas::box(int x, int y, int width, int height, Colour colour) {
    for (int v = y * fineness; v < (y + height) * fineness; ++v)
        for (int u = x * fineness; u < (x + width) * fineness; ++u)
            set(u, v, colour);
}

void Canvas::fill(std::span<const std::vector<Spot>> rings, Colour colour) {
    std::vector<std::vector<Spot>> fine(rings.begin(), rings.end());
    double low = fine_.height;
    double high = 0;
    for (auto& ring : fine)
        for (Spot& spot : ring) {
            spot = {spot.x * fineness, spot.y * fineness};
            low = std::min(low, spot.y);
            high = std::max(high, spot.y);
        }
    const int end = first_pixel(high, fine_.height);
    for (int y = first_pixel(low, fine_.height); y < end; ++y) {
        const std::vector<double> edges = crossings(fine, y + 0.5);
        for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
            for (int x = first_pixel(edges[i], fine_.width); x < first_pixel(edges[i + 1], fine_.width); ++x)
                set(x, y, colour);
    }
}

void Canvas::outline(const std::vector<Spot>& ring, Colour colour) {
    // No longer than what is seen of a line far outside.
    constexpr double most_steps = 1e5;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Spot& a = ring[i];
        const Spot& b = ring[(i + 1) % ring.size()];
        const double length = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)) * fineness;
        const auto steps = static_cast<int>(std::clamp(std::ceil(length), 1.0, most_steps));
        for (int step = 0; step < steps; ++step)
            set(static_cast<int>(std::floor((a.x + (b.x - a.x) * step / steps) * fineness)),
                static_cast<int>(std::floor((a.y + (b.y - a.y) * step / steps) * fineness)), colour);
    }
}

void Canvas::text(int x, int y, int size, std::string_view text, Colour colour) {
    for (const char letter : text) {
        const auto rows = letter_rows(letter);
        for (int row = 0; row < letter_height; ++row)
            for (int col = 0; col < letter_width; ++col)
                if ((rows[static_cast<std::size_t>(row)] >> (letter_width - 1 - col) & 1) != 0)
                    box(x + col * size, y + row * size, size, size, colour);
        x += (letter_width + 1) * size;
    }
}

Image Canvas::shown() const {
    Image image{width(), height(), {}};
    image.rgb.reserve(fine_.rgb.size() / fineness / fineness);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (std::size_t band = 0; band < 3; ++band) {
                int sum = 0;
                for (int v = 0; v < fineness; ++v)
                    for (int u = 0; u < fineness; ++u)
                        sum += fine_.at(x * fineness + u, y * fineness + v)[band];
                image.rgb.push_back(static_cast<std::uint8_t>(sum / (fineness * fineness)));
            }
    return image;
}

int text_width(int size, std::string_view text) {
    return static_cast<int>(text.size()) * (letter_width + 1) * size;
}

}  // namespace d2b
