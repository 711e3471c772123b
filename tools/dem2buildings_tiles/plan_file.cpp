#include "dem2buildings_tiles/plan_file.hpp"

#include <cerrno>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <nlohmann/json.hpp>

#include "dem2buildings/error.hpp"
#include "dem2buildings/version.hpp"
#include "dem2buildings_tiles/source_mosaic.hpp"
#include "write/staging.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view program = "dem2buildings_tiles";
constexpr std::array<std::string_view, 3> layer_words{"both", "buildings", "contours"};
constexpr std::int64_t most_cells = std::numeric_limits<std::int32_t>::max();  // in a row or a column
constexpr std::int64_t max_whole = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t min_whole = std::numeric_limits<std::int64_t>::min();

std::filesystem::path path_of(const std::filesystem::path& work) {
    return work / "plan.json";
}

/// Names of files may be no UTF-8, which JSON would not hold: their bytes go into it as letters of Latin-1.
std::string to_json(const std::string& bytes) {
    std::string text;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            text += c;
        } else {
            text += static_cast<char>(0xc0 | (byte >> 6));
            text += static_cast<char>(0x80 | (byte & 0x3f));
        }
    }
    return text;
}

std::string from_json(const std::string& text) {
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (byte >= 0x80 && i + 1 < text.size())
            bytes += static_cast<char>(((byte & 0x03) << 6) | (static_cast<unsigned char>(text[++i]) & 0x3f));
        else
            bytes += text[i];
    }
    return bytes;
}

Json json_of(const std::vector<SharedValue>& values) {
    Json all = Json::array();
    for (const SharedValue& one : values)
        all.push_back({{"value", one.value}, {"cells", one.cells}});
    return all;
}

Json json_of(const TilePlan& plan, const TileCost& cost) {
    Json words = Json::array();
    for (const std::string& word : plan.words)
        words.push_back(to_json(word));
    Json files = Json::array();
    for (const reading::SourceFile& file : plan.files)
        files.push_back({{"name", to_json(file.name)}, {"bytes", file.size}, {"modified", file.modified}});
    return {
        {"program", program},
        {"version", version},
        {"tiles", plan.tiles},
        {"tile", plan.side},
        {"arguments", words},
        {"folder", to_json(plan.folder)},
        {"parts", plan.parts},
        {"layers", layer_words[static_cast<std::size_t>(plan.layers)]},
        {"window", {plan.window.row, plan.window.col, plan.window.rows, plan.window.cols}},
        {"files", files},
        {"nodata_values", json_of(plan.undeclared.taken)},
        {"doubtful_values", json_of(plan.undeclared.named)},
        {"lowest_at_edge", plan.undeclared.lowest_at_edge ? Json(*plan.undeclared.lowest_at_edge) : Json()},
        {"blended_margin",
         {{"cells", plan.undeclared.margin.cells},
          {"missing", plan.undeclared.margin.missing},
          {"with", plan.undeclared.margin.with ? Json(*plan.undeclared.margin.with) : Json()},
          {"land", {plan.undeclared.margin.lowest, plan.undeclared.margin.highest}}}},
        {"expected",
         {{"find_seconds_a_tile", cost.find_seconds},
          {"draw_seconds_a_tile", cost.draw_seconds},
          {"memory_bytes_a_tile", cost.memory_bytes},
          {"bytes_read", cost.bytes_read}}}};
}

/// @throws std::out_of_range it is no whole number of these: it would be rounded, or come out as another one
std::int64_t whole(const Json& json, std::int64_t least, std::int64_t most) {
    const bool fits =
        json.is_number_integer() &&
        (!json.is_number_unsigned() || json.get<std::uint64_t>() <= static_cast<std::uint64_t>(max_whole));
    const std::int64_t number = fits ? json.get<std::int64_t>() : 0;
    if (!fits || number < least || number > most)
        throw std::out_of_range("a number is out of range");
    return number;
}

Window window_of(const Json& json) {
    const auto at = [&](std::size_t i) {
        return static_cast<std::int32_t>(whole(json.at(i), 0, most_cells));
    };
    return {at(0), at(1), at(2), at(3)};
}

std::vector<SharedValue> values_of(const Json& json) {
    std::vector<SharedValue> values;
    for (const Json& one : json)
        values.push_back({one.at("value").get<double>(), whole(one.at("cells"), 0, max_whole)});
    return values;
}

TilePlan plan_of(const Json& json) {
    TilePlan plan;
    for (const Json& word : json.at("arguments"))
        plan.words.push_back(from_json(word.get<std::string>()));
    plan.folder = from_json(json.at("folder").get<std::string>());
    const auto layers = json.at("layers").get<std::string>();
    for (std::size_t i = 0; i < layer_words.size(); ++i)
        if (layers == layer_words[i])
            plan.layers = static_cast<Layers>(i);
    plan.parts = json.at("parts").get<bool>();
    plan.side = static_cast<std::int32_t>(whole(json.at("tile"), 1, TilePlan::most_side));
    plan.tiles = whole(json.at("tiles"), 1, max_whole);
    plan.window = window_of(json.at("window"));
    for (const Json& file : json.at("files"))
        plan.files.push_back({from_json(file.at("name").get<std::string>()),
                              whole(file.at("bytes"), min_whole, max_whole),
                              whole(file.at("modified"), min_whole, max_whole)});
    plan.undeclared = {values_of(json.at("nodata_values")), values_of(json.at("doubtful_values")), {}, {}};
    if (const Json& lowest = json.at("lowest_at_edge"); !lowest.is_null())
        plan.undeclared.lowest_at_edge = lowest.get<double>();
    const Json& margin = json.at("blended_margin");
    plan.undeclared.margin = {
        static_cast<std::int32_t>(whole(margin.at("cells"), 0, most_cells)),
        margin.at("missing").get<std::vector<double>>(),
        margin.at("with").is_null() ? std::nullopt : std::optional(margin.at("with").get<double>()),
        margin.at("land").at(0).get<double>(), margin.at("land").at(1).get<double>()};
    return plan;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
    throw InputError("'" + path.string() + "' " + why +
                     "; run 'dem2buildings_tiles plan' with a new work folder.");
}

}  // namespace

std::string plan_text(const TilePlan& plan, const TileCost& cost) {
    return json_of(plan, cost).dump(2) + '\n';
}

void write_plan(const std::filesystem::path& work, const TilePlan& plan, const TileCost& cost) {
    std::error_code error;
    std::filesystem::create_directories(work, error);
    if (error)
        refuse_folder(work, error);
    writing::write_text_file(path_of(work), plan_text(plan, cost));
}

KnownPlan read_plan(const std::filesystem::path& work) {
    const std::filesystem::path path = path_of(work);
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw InputError(
            "'" + path.string() + "' cannot be read: " + std::generic_category().message(errno) +
            "; run 'dem2buildings_tiles plan' first, or give the work folder that it was given.");
    std::ostringstream text;
    text << file.rdbuf();
    return plan_from(work, std::move(text).str());
}

KnownPlan plan_from(const std::filesystem::path& work, const std::string& bytes) {
    const std::filesystem::path path = path_of(work);
    constexpr const char* no_plan = "is not a complete plan";
    KnownPlan known;
    try {
        const Json json = Json::parse(bytes, nullptr, false);
        if (!json.is_object() || json.value("program", "") != program)
            refuse(path, no_plan);
        if (json.value("version", "") != version)
            refuse(path, "was written by another version of dem2buildings");
        known.plan = plan_of(json);
    } catch (const Json::exception&) {
        refuse(path, no_plan);
    } catch (const std::out_of_range&) {
        refuse(path, no_plan);
    }
    known.work = {
        work, tiles::digest_of(std::as_bytes(std::span(bytes))), known.plan.side, {}, known.plan.undeclared};
    return known;
}

}  // namespace d2b
