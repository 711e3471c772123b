#include "pipeline/made_town.hpp"

#include <gtest/gtest.h>

namespace d2b::test {
namespace {

/// Counts the edges to the right of it.
bool inside(const WorldRing& ring, double x, double y) {
    bool odd = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& a = ring[i];
        const Position& b = ring[(i + 1) % ring.size()];
        if ((a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
            odd = !odd;
    }
    return odd;
}

bool inside(const Feature& feature, double x, double y) {
    for (const WorldPolygon& part : feature.parts) {
        bool in = inside(part.exterior, x, y);
        for (const WorldRing& ring : part.interiors)
            in = in && !inside(ring, x, y);
        if (in)
            return true;
    }
    return false;
}

}  // namespace

double overlap(const Feature& feature, const Box& box, const AffineTransform& transform) {
    int both = 0;
    int either = 0;
    for (int r = 0; r < MadeTown::rows; ++r)
        for (int c = 0; c < MadeTown::cols; ++c) {
            const bool one = box.holds(r, c);
            const bool other = inside(feature, transform[0] + (c + 0.5) * transform[1],
                                      transform[3] + (r + 0.5) * transform[5]);
            both += one && other ? 1 : 0;
            either += one || other ? 1 : 0;
        }
    return static_cast<double>(both) / either;
}

std::size_t TownRun::at(const Box& box, std::size_t layer, double least) const {
    std::size_t best = 0;
    double most = 0;
    for (std::size_t i = 0; i < count(layer); ++i)
        if (const double share = overlap(sink.features[layer][i], box, dem.info().transform); share > most) {
            most = share;
            best = i;
        }
    EXPECT_GE(most, least) << "at row " << box.row << ", column " << box.col;
    if (count(layer) == 0)
        throw std::runtime_error("the layer is empty");
    return best;
}

}  // namespace d2b::test
