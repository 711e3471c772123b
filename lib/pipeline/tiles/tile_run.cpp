#include "pipeline/tiles/tile_run.hpp"

#include <limits>
#include <string>
#include <utility>

#include "elevations/sift_rules.hpp"
#include "pipeline/find_buildings.hpp"

namespace d2b {

TileRun::TileRun(const TileWork& work, const Options& options, const Sources& sources, FeatureSink& features,
                 const Callbacks& callbacks)
    : work_(work),
      sources_(sources),
      context_(callbacks),
      setup_(set_up_run(options, sources.dem.info(), features, context_)),
      units_(unit_grid(setup_.plan, setup_.dem.window, setup_.cell, work.units)),
      tiles_(units_, work.side) {
    if (!work_.undeclared)
        work_.undeclared =
            undeclared_values(sources.dem, setup_.plan.asked,
                              d2b::sift_rules(setup_.plan.asked.read, false, setup_.dem, metres()),
                              setup_.cell_m(), nullptr, context_);
}

SiftRules TileRun::sift_rules() const {
    SiftRules rules =
        d2b::sift_rules(setup_.plan.asked.read, setup_.plan.detects_buildings(), setup_.dem, metres());
    rules.undeclared = undeclared().values();
    return rules;
}

FoundFacts TileRun::no_facts() const {
    return FoundFacts(sift_rules(), setup_.plan.asked.detect.min_height);
}

std::filesystem::path TileRun::file(TileStep step, std::int64_t tile) const {
    return folder(step) / std::to_string(tile);
}

Seal TileRun::frame_seal(TileStep step) const {
    return {step, work_.plan, std::numeric_limits<std::uint32_t>::max()};
}

FoundTile TileRun::load_found(std::int64_t tile) const {
    std::vector<Window> windows;
    for (const PlacedUnit& placed : tiles_.units_of(tile))
        windows.push_back(placed.unit.own);
    SealedFile file(this->file(TileStep::find, tile), seal(TileStep::find, tile));
    return load_body(file, [&](ByteReader& reader) { return load_found_tile(reader, no_facts(), windows); });
}

FoundFacts TileRun::load_frame() const {
    SealedFile file(frame_file(), frame_seal());
    return load_body(file, [&](ByteReader& reader) {
        FoundFacts facts = no_facts();
        facts.load(reader);
        return facts;
    });
}

std::vector<std::string> TileRun::take_warnings() const {
    std::vector<std::string> all;
    for (DemSource* source : {&sources_.dem, sources_.terrain, sources_.mask, sources_.ndvi})
        if (source != nullptr)
            for (std::string& text : source->take_warnings())
                all.push_back(std::move(text));
    if (sources_.parcels != nullptr)
        for (std::string& text : sources_.parcels->take_warnings())
            all.push_back(std::move(text));
    return all;
}

void require_tiles(const Options& options) {
    const auto refuse = [](bool asked, const std::string& option, const std::string& what) {
        if (asked)
            throw OptionError(option + " does not work in tiles: " + what +
                              "; leave it out, or run dem2buildings.");
    };
    const WriteOptions& write = options.write;
    refuse(!write.preview.empty(), "-preview", "a picture is drawn of the whole");
    refuse(!write.surfaces.empty(), "-surface", "a surface is made of the whole");
    refuse(!write.page.empty(), "-page", "a page is made of the whole");
    const std::string flow = "outlines are changed for the sake of others that may be far away";
    refuse(options.outline.flow_ready > 0, "-flow_ready", flow);
    refuse(options.outline.min_gap.has_value(), "-min_gap", flow);
    refuse(options.outline.min_wall.has_value(), "-min_wall", flow);
    // With -preset thesis the merge step has all contours.
    const bool found = detects_buildings(options);
    refuse(found && options.outline.simplify > 0, "-simplify",
           "borders are simplified that the whole shares");
    refuse(found && write.rejected, "-write_rejected", "what is dropped is kept in one run alone");
}

}  // namespace d2b
