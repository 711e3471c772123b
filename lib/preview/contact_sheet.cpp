#include "preview/contact_sheet.hpp"

#include <algorithm>

namespace d2b {

Image contact_sheet(const std::vector<Image>& pictures, int columns) {
    constexpr int gap = 4;
    constexpr std::uint8_t between = 120;
    if (pictures.empty() || columns < 1)
        return {};
    const int width = pictures.front().width;
    const int height = pictures.front().height;
    const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
    Image sheet{columns * (width + gap) - gap, rows * (height + gap) - gap, {}};
    const auto line = static_cast<std::size_t>(sheet.width) * 3;
    sheet.rgb.assign(line * static_cast<std::size_t>(sheet.height), between);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const auto row = i / static_cast<std::size_t>(columns) * static_cast<std::size_t>(height + gap);
        const auto col = i % static_cast<std::size_t>(columns) * static_cast<std::size_t>(width + gap);
        const auto across = static_cast<std::size_t>(width) * 3;
        for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
            std::copy_n(pictures[i].rgb.begin() + static_cast<std::ptrdiff_t>(y * across), across,
                        sheet.rgb.begin() + static_cast<std::ptrdiff_t>((row + y) * line + col * 3));
    }
    return sheet;
}

}  // namespace d2b
