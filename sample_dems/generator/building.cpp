#include "building.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace d2b::sample {

namespace {

constexpr std::array<std::string_view, 7> roof_names{"flat", "shed", "gabled", "hipped",
                                                     "cone", "dome", "mansard"};

/// How far up the slope a point is, 0 at the eave to 1 at the ridge.
double share_of_rise(const RoofPart& part, const Position& local) {
    // x runs along the ridge, y across; both from 0 at one wall.
    double x = local.x - part.rect.x0;
    double y = local.y - part.rect.y0;
    double length = part.rect.width();
    double span = part.rect.depth();
    if (!part.ridge_along_x) {
        std::swap(x, y);
        std::swap(length, span);
    }
    const double across = std::min(y, span - y) / (span / 2);
    switch (part.roof) {
        case Roof::flat:
            return 0;
        case Roof::shed:
            return y / span;
        case Roof::gabled:
            return across;
        case Roof::hipped:
            return std::min(across, std::min(x, length - x) / (span / 2));
        case Roof::mansard: {
            const double way = std::min(across, std::min(x, length - x) / (span / 2));
            return way < mansard_way
                       ? way * mansard_rise / mansard_way
                       : mansard_rise + (way - mansard_way) * (1 - mansard_rise) / (1 - mansard_way);
        }
        default: {
            const double u = 2 * x / length - 1;
            const double v = 2 * y / span - 1;
            const double square = u * u + v * v;
            return part.roof == Roof::cone ? 1 - std::sqrt(square) : std::sqrt(std::max(0.0, 1 - square));
        }
    }
}

}  // namespace

std::string_view roof_name(Roof roof) {
    return roof_names[static_cast<std::size_t>(roof)];
}

double roof_height(const RoofPart& part, const Position& local) {
    return part.eave + (part.top - part.eave) * std::clamp(share_of_rise(part, local), 0.0, 1.0);
}

double Building::eave() const {
    return std::min_element(parts.begin(), parts.end(),
                            [](const auto& a, const auto& b) { return a.eave < b.eave; })
        ->eave;
}

double Building::top() const {
    return std::max_element(parts.begin(), parts.end(),
                            [](const auto& a, const auto& b) { return a.top < b.top; })
        ->top;
}

const RoofPart& Building::main_part() const {
    return *std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
        return a.rect.width() * a.rect.depth() < b.rect.width() * b.rect.depth();
    });
}

std::optional<double> Building::elevation_at(const Position& p) const {
    if (!contains(footprint, p))
        return std::nullopt;
    const Position local = frame.to_local(p);
    double height = -std::numeric_limits<double>::infinity();
    for (const RoofPart& part : parts) {
        // The footprint is in scene coordinates: a point just inside may be a rounding error outside its
        // part.
        if (part.rect.grown(1e-6).contains(local))
            height = std::max(height, roof_height(part, local));
    }
    return ground + height;
}

}  // namespace d2b::sample
