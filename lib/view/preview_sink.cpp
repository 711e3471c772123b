#include "view/preview_sink.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "core/height_classes.hpp"

namespace d2b::view {
namespace {

std::optional<std::size_t> field_of(const LayerSpec& layer, const std::string& name) {
    const auto field = std::ranges::find(layer.fields, name, &FieldSpec::name);
    if (field == layer.fields.end())
        return std::nullopt;
    return static_cast<std::size_t>(field - layer.fields.begin());
}

const double* number_in(const Feature& feature, std::size_t field) {
    return field < feature.values.size() ? std::get_if<double>(&feature.values[field]) : nullptr;
}

/// Returns a key that equals that of the same outline on another map of the same frame.
std::string key_of(std::size_t layer, const FirstOutlines::Rings& rings) {
    std::string key = std::to_string(layer);
    const auto append = [&key](double number) {
        std::array<char, sizeof number> bytes{};
        std::memcpy(bytes.data(), &number, sizeof number);
        key.append(bytes.data(), bytes.size());
    };
    for (const auto& ring : rings) {
        append(static_cast<double>(ring.size()));
        for (const PixelPoint& pixel : ring) {
            append(pixel.x);
            append(pixel.y);
        }
    }
    return key;
}

}  // namespace

void FirstOutlines::add(std::size_t layer, Rings rings) {
    std::string key = key_of(layer, rings);
    outlines_.emplace(std::move(key), Outline{layer, std::move(rings)});
}

bool FirstOutlines::find(std::size_t layer, const Rings& rings) {
    const auto found = outlines_.find(key_of(layer, rings));
    if (found == outlines_.end())
        return false;
    found->second.seen = true;
    return true;
}

std::vector<FirstOutlines::Outline> FirstOutlines::take_missing() {
    std::vector<Outline> missing;
    for (auto& [key, outline] : outlines_)
        if (!std::exchange(outline.seen, false))
            missing.push_back(outline);
    return missing;
}

PreviewSink::PreviewSink(FeatureSink& features, const MapFrame& frame, writing::PictureFormat format,
                         OnMap on_map, std::shared_ptr<FirstOutlines> first)
    : features_(features),
      on_map_(std::move(on_map)),
      first_(std::move(first)),
      relief_(std::make_shared<Relief>(frame)),
      map_{frame, relief_, FootprintDrawing(frame, format), "", {}} {}

void PreviewSink::begin(std::span<const LayerSpec> layers, const Provenance& provenance) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const LayerStyle& style = layers[i].style;
        const auto height = field_of(layers[i], style.colour);
        if (!height)
            continue;
        const DrawnLayer drawn{i, *height, field_of(layers[i], style.certainty), style.certain};
        if (filled_layer_) {
            stroked_layer_ = drawn;
            continue;
        }
        filled_layer_ = drawn;
        map_.legend = style.title;
    }
    const Crs& crs = map_.frame.area().crs;
    const Crs written(provenance.crs_wkt);
    if (written.kind() != Crs::Kind::none && written.wkt() != crs.wkt())
        to_dem_.emplace(written, crs, std::span<const Position>());
    features_.begin(layers, provenance);
}

std::optional<Colour> PreviewSink::colour_of(const Feature& feature, const DrawnLayer& drawn) {
    const double* height = number_in(feature, drawn.height);
    if (height == nullptr)
        return std::nullopt;
    const Colour colour = height_classes()[height_class_of(*height)].colour;
    const double* certainty = drawn.certainty ? number_in(feature, *drawn.certainty) : nullptr;
    if (certainty == nullptr || !(*certainty < drawn.certain))
        return colour;
    map_.counts.paler = true;
    return blend(colour, paper, overlay_opacity(*certainty, drawn.certain));
}

void PreviewSink::draw(const WorldPolygon& polygon, const DrawnLayer& drawn, Colour colour) {
    std::vector<std::vector<PixelPoint>> rings;
    const auto add_ring = [&](WorldRing ring) {
        if (to_dem_)
            to_dem_->apply(ring);
        auto& pixels = rings.emplace_back();
        for (const Position& position : ring)
            pixels.push_back(map_.frame.pixel(position));
    };
    add_ring(polygon.exterior);
    for (const WorldRing& interior : polygon.interiors)
        add_ring(interior);
    if (stroked_layer_ && drawn.layer == stroked_layer_->layer)
        map_.footprints.stroke(rings);
    else
        map_.footprints.fill(rings, colour);
    if (first_)
        compare(drawn.layer, rings);
}

void PreviewSink::compare(std::size_t layer, const FirstOutlines::Rings& rings) {
    if (!first_->is_complete())
        first_->add(layer, rings);
    else if (!first_->find(layer, rings))
        added_.push_back({layer, rings});
}

void PreviewSink::mark_differences() {
    if (!first_)
        return;
    if (!first_->is_complete()) {
        first_->complete();
        return;
    }
    const std::vector<FirstOutlines::Outline> missing = first_->take_missing();
    for (const FirstOutlines::Outline& outline : missing)
        map_.footprints.mark(outline.rings, true);
    for (const FirstOutlines::Outline& outline : added_)
        map_.footprints.mark(outline.rings, false);
    // The contours of a building are marked but not counted, because the counts stand beside that of
    // buildings.
    const auto count = [this](const std::vector<FirstOutlines::Outline>& outlines) {
        return std::ranges::count_if(
            outlines, [this](const auto& outline) { return outline.layer == filled_layer_->layer; });
    };
    map_.counts.added = count(added_);
    map_.counts.missing = count(missing);
}

void PreviewSink::add(std::size_t layer, const Feature& feature) {
    for (const std::optional<DrawnLayer>& drawn : {filled_layer_, stroked_layer_})
        if (drawn && drawn->layer == layer)
            if (const auto colour = colour_of(feature, *drawn))
                for (const WorldPolygon& part : feature.parts)
                    draw(part, *drawn, *colour);
    features_.add(layer, feature);
}

void PreviewSink::take_report(const RunReport& report) {
    PictureCounts& counts = map_.counts;
    counts.contours_only = report.layers == Layers::contours;
    counts.number = counts.contours_only ? report.contours : report.buildings;
    counts.stacked = report.contours > 0;
    counts.rmse_m = report.stack_rmse_m;
    features_.take_report(report);
}

void PreviewSink::prepare(CommitList& commit) {
    mark_differences();
    on_map_(std::move(map_));
    features_.prepare(commit);
}

}  // namespace d2b::view
