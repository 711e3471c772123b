#include "preview/preview_sink.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/height_classes.hpp"
#include "core/number_text.hpp"
#include "preview/letters.hpp"
#include "preview/relief.hpp"

namespace d2b {
namespace {

constexpr Colour paper{255, 255, 255};
constexpr Colour ink{40, 40, 40};
constexpr Colour edge{70, 45, 35};
constexpr int margin = 6;

/// Dots a letter: captions can be read on small pictures, too.
int letter_size(int width) {
    constexpr int a_size = 400;
    return std::clamp(width / a_size, 1, 3);
}

int caption_height(int width) {
    return letter_height * letter_size(width) + 2 * margin;
}

std::string one_decimal(double value) {
    constexpr double tenth = 10;
    return number_text(std::round(value * tenth) / tenth);
}

}  // namespace

PreviewSink::PreviewSink(FeatureSink& features, DemSource& dem, Crs crs, PreviewLook look, Taken taken)
    : features_(features),
      dem_(dem),
      crs_(std::move(crs)),
      look_(std::move(look)),
      taken_(std::move(taken)),
      frame_(dem.info(), look_.longest),
      canvas_(frame_.width(), frame_.height() + 2 * caption_height(frame_.width()), paper) {}

void PreviewSink::begin(std::span<const LayerSpec> layers, const Provenance& provenance) {
    const AffineTransform& g = dem_.info().transform;
    const double unit = crs_.horizontal_unit() ? crs_.horizontal_unit()->metres : 1;
    // A degree is so long that its slopes would not be seen; there a cell is taken for a metre.
    const double cell_m = crs_.kind() == Crs::Kind::geographic ? 1 : std::hypot(g[1], g[4]) * unit;
    draw_relief(dem_, frame_, look_.vertical_metres / cell_m, canvas_);
    // The contours follow the buildings; without them the buildings are the first layer.
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (!layers[i].style.order.empty())
            layer_ = i;
    const auto& fields = layers[layer_].fields;
    height_ = static_cast<std::size_t>(
        std::ranges::find(fields, layers[layer_].style.colour, &FieldSpec::name) - fields.begin());
    const Crs written(provenance.crs_wkt);
    if (written.kind() != Crs::Kind::none && written.wkt() != crs_.wkt())
        to_dem_.emplace(written, crs_, std::span<const Position>());
    features_.begin(layers, provenance);
}

void PreviewSink::draw(const WorldPolygon& polygon, Colour colour) {
    std::vector<std::vector<Spot>> rings;
    const auto add_ring = [&](WorldRing ring) {
        if (to_dem_)
            to_dem_->apply(ring);
        auto& spots = rings.emplace_back();
        for (const Position& position : ring)
            spots.push_back(frame_.spot(position));
    };
    add_ring(polygon.exterior);
    for (const WorldRing& interior : polygon.interiors)
        add_ring(interior);
    canvas_.fill(rings, colour);
    for (const auto& ring : rings)
        canvas_.outline(ring, edge);
}

void PreviewSink::add(std::size_t layer, const Feature& feature) {
    if (layer == layer_ && height_ < feature.values.size())
        if (const auto* height = std::get_if<double>(&feature.values[height_]))
            for (const WorldPolygon& part : feature.parts)
                draw(part, height_classes()[height_class_of(*height)].colour);
    features_.add(layer, feature);
}

void PreviewSink::write_caption(const RunReport& report) {
    const int size = letter_size(frame_.width());
    const int strip = caption_height(frame_.width());
    // What the features lie over at the edges goes under the caption.
    canvas_.box(0, frame_.height(), frame_.width(), 2 * strip, paper);
    std::string text = look_.heading + (look_.heading.empty() ? "" : ": ") +
                       std::to_string(report.buildings) + " buildings, " + std::to_string(report.vertices) +
                       " points";
    if (report.contours > 0)
        text += ", rmse " + one_decimal(report.stack_rmse_m) + " m";
    canvas_.text(margin, frame_.height() + margin, size, text, ink);
    int x = margin;
    const int y = frame_.height() + strip;
    for (std::size_t i = 0; i < height_classes().size(); ++i) {
        const std::string from = number_text(height_classes()[i].from) + (i == 0 ? " m" : "");
        canvas_.box(x, y, letter_height * size, letter_height * size, height_classes()[i].colour);
        canvas_.text(x + (letter_height + 1) * size, y, size, from, ink);
        x += (letter_height + 4) * size + text_width(size, from);
    }
}

void PreviewSink::take_report(const RunReport& report) {
    write_caption(report);
    features_.take_report(report);
}

void PreviewSink::finish() {
    taken_(canvas_.shown());
    features_.finish();
}

}  // namespace d2b
