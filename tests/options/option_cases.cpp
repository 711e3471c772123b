#include "options/option_cases.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "dem2buildings/command_line.hpp"
#include "dem2buildings/error.hpp"

namespace d2b::test {
namespace {

/// Values that show on the scene, of the options whose words the table does not list.
const std::map<std::string, std::vector<Texts>>& values() {
    static const std::map<std::string, std::vector<Texts>> all{
        {"b", {{"2"}}},
        {"oo", {{"NUM_THREADS=1"}}},
        {"if", {{"GTiff"}}},
        {"a_srs", {{"+proj=tmerc +lon_0=15 +k=0.9996 +x_0=500001 +ellps=GRS80 +type=crs"}}},
        {"snodata", {{"16"}}},
        {"srcwin", {{"0", "0", "105", "70"}}},
        {"projwin", {{"391005", "5820000", "391100", "5819905"}}},
        {"te", {{"391000", "5819907", "391098", "5820000"}}},
        {"cutline", {{"/vsimem/scene/areas.gpkg"}}},
        {"cutline_layer", {{"north"}}},
        {"zunit", {{"ft"}}},
        {"zrange", {{"0", "9"}}},
        {"max_building_width", {{"5"}}},
        {"min_height", {{"4"}}},
        {"min_building_height", {{"4.85"}}},
        {"min_confidence", {{"0"}, {"0.97"}}},
        {"mask", {{"/vsimem/scene/masks.gpkg"}}},
        {"mask_layer", {{"middle"}}},
        {"exclude", {{"/vsimem/scene/exclusions.gpkg"}}},
        {"exclude_layer", {{"ships"}}},
        {"exclude_buffer", {{"3"}}},
        {"corrections", {{"/vsimem/scene/corrections.gpkg"}}},
        {"corrections_layer", {{"points"}}},
        {"ndvi", {{"/vsimem/scene/ndvi.tif"}}},
        {"split_height", {{"3"}}},
        {"split_by", {{"/vsimem/scene/parcels.gpkg"}}},
        {"split_layer", {{"halves"}}},
        {"split_field", {{"owner"}}},
        {"split_width", {{"30"}}},
        {"footprints", {{"/vsimem/scene/footprints.gpkg"}}},
        {"footprints_layer", {{"high"}}},
        {"ground", {{"none"}, {"/vsimem/scene/dtm.tif"}}},
        {"lod", {{"2"}}},
        {"detail", {{"6"}, {"0"}}},
        {"fl", {{"6", "9"}}},
        {"i", {{"2.5"}}},
        {"off", {{"1"}}},
        {"nf", {{"50"}}},
        {"min_area", {{"150"}}},
        {"regularize_tolerance", {{"0.5"}}},
        {"wall_inset", {{"0.1"}}},
        {"simplify", {{"1.2"}}},
        {"flow_ready", {{"5"}}},
        {"min_gap", {{"30"}}},
        {"min_wall", {{"4"}}},
        {"storey_height", {{"2"}}},
        {"t_srs", {{"EPSG:25832"}}},
        {"f", {{"GPKG"}}},
        {"dsco", {{"VERSION=1.3"}}},
        {"lco", {{"FID=fid"}}},
        {"nln", {{"roofs"}}},
        {"roof_min_area", {{"200"}}},
        {"write_ground", {{"g.tif"}}},
        {"write_height", {{"h.tif"}}},
        {"write_canopy", {{"c.tif"}}},
        {"surface", {{"s.obj"}}},
        {"surface_solids", {{"one"}}},
        {"surface_origin", {{"391000", "5820000", "7"}}},
        {"page", {{"p.html"}}},
        {"preview", {{"p.png"}}},
        {"preview_size", {{"800"}}},
        {"preview_scale", {{"5000"}}},
        {"title", {{"Old town"}}},
        {"credit", {{"City of Old Town, CC BY 4.0"}}},
        {"sweep", {{"lod=1..2"}, {"nf=5..10"}, {"detail=0..2"}, {"min_area=10..50..40"}}},
        {"threads", {{"1"}}},
    };
    return all;
}

const std::map<std::string, Texts>& needs() {
    static const std::map<std::string, Texts> all{
        {"roof_min_area", {"-roofs"}},
        {"surface_of", {"-surface", "s.obj"}},
        {"surface_roof", {"-surface", "s.obj"}},
        {"surface_solids", {"-surface", "s.obj"}},
        {"surface_origin", {"-surface", "s.obj"}},
        {"write_problems", {"-surface", "s.obj"}},
        // It names problems that it does not change.
        {"min_gap", {"-surface", "s.obj", "-write_problems"}},
        {"cutline_layer", {"-cutline", "/vsimem/scene/areas.gpkg"}},
        {"preview_size", {"-preview", "p.png"}},
        {"preview_paper", {"-preview", "p.png"}},
        {"preview_scale", {"-preview", "p.png", "-preview_paper", "A4"}},
        {"landscape", {"-preview", "p.png", "-preview_paper", "A4"}},
        {"title", {"-preview", "p.png"}},
        {"credit", {"-preview", "p.png"}},
        {"mask_layer", {"-mask", "/vsimem/scene/masks.gpkg"}},
        {"exclude_layer", {"-exclude", "/vsimem/scene/exclusions.gpkg"}},
        {"exclude_buffer", {"-exclude", "/vsimem/scene/exclusions.gpkg"}},
        {"corrections_layer", {"-corrections", "/vsimem/scene/corrections.gpkg"}},
        {"split_layer", {"-split_by", "/vsimem/scene/parcels.gpkg"}},
        {"split_field", {"-split_by", "/vsimem/scene/parcels.gpkg"}},
        {"split_width", {"-split_by", "/vsimem/scene/parcels.gpkg"}},
        {"footprints_layer", {"-footprints", "/vsimem/scene/footprints.gpkg"}},
        {"off", {"-i", "2.5"}}};
    return all;
}

std::vector<Texts> values_of(const OptionRow& row) {
    if (row.arity == Arity::none)
        return {{}};
    if (const auto listed = values().find(row.name); listed != values().end())
        return listed->second;
    std::vector<Texts> words;
    for (const std::string& word : row.choices)
        words.push_back({word});
    return words;
}

}  // namespace

Texts OptionCase::words() const {
    Texts words = with;
    words.push_back("-" + name);
    words.insert(words.end(), values.begin(), values.end());
    return words;
}

std::string OptionCase::text() const {
    std::string text;
    for (const std::string& word : words())
        text += (text.empty() ? "" : " ") + word;
    return text;
}

bool OptionCase::is_given_with(const OptionCase& other) const {
    return std::ranges::find(with, "-" + other.name) != with.end();
}

std::vector<OptionCase> option_cases() {
    const Request standard;
    std::vector<OptionCase> cases;
    for (const OptionRow& row : option_table()) {
        Request request;
        if (row.arity == Arity::none)
            row.apply(request, {});
        if (row.hidden || request.tool.prints_text())
            continue;
        for (const Texts& texts : values_of(row)) {
            const auto needed = needs().find(row.name);
            cases.push_back({row.name, texts, needed == needs().end() ? Texts{} : needed->second});
        }
    }
    return cases;
}

bool shapes_the_result(const std::string& name) {
    static const std::set<std::string> others{
        "oo", "if", "f", "dsco", "lco", "nln", "q", "json", "overwrite", "append", "sweep", "threads",
        "preview", "preview_size", "preview_paper", "preview_scale", "landscape", "title", "credit",
        // The sinks of these tests take one part at a time.
        "surface_solids"};
    return !others.contains(name);
}

std::string refusal_of(const Texts& words) {
    Texts all = words;
    const bool sweeps = std::ranges::find(words, "-sweep") != words.end();
    all.insert(all.end(), {"--", "in.tif"});
    if (!sweeps)
        all.emplace_back("out.gpkg");
    try {
        static_cast<void>(parse_command_line(all));
        return "";
    } catch (const OptionError& error) {
        return error.what();
    }
}

}  // namespace d2b::test
