#include "dem2buildings_tiles/plan_file.hpp"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "dem2buildings/error.hpp"
#include "dem2buildings/version.hpp"
#include "write/file_moves.hpp"

namespace d2b {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view program = "dem2buildings_tiles";
constexpr std::array<std::string_view, 3> layer_words{"both", "buildings", "contours"};

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

Json json_of(const TilePlan& plan, const TileCost& cost) {
    Json words = Json::array();
    for (const std::string& word : plan.words)
        words.push_back(to_json(word));
    Json files = Json::array();
    for (const SourceFile& file : plan.files)
        files.push_back({{"name", to_json(file.name)}, {"bytes", file.size}, {"modified", file.modified}});
    return {{"program", program},
            {"version", version},
            {"tiles", plan.tiles},
            {"tile", plan.side},
            {"arguments", words},
            {"folder", to_json(plan.folder)},
            {"parts", plan.parts},
            {"layers", layer_words[static_cast<std::size_t>(plan.layers)]},
            {"window", {plan.window.row, plan.window.col, plan.window.rows, plan.window.cols}},
            {"files", files},
            {"expected",
             {{"find_seconds_a_tile", cost.find_seconds},
              {"draw_seconds_a_tile", cost.draw_seconds},
              {"memory_bytes_a_tile", cost.memory_bytes},
              {"bytes_read", cost.bytes_read}}}};
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
    plan.side = json.at("tile").get<std::int32_t>();
    plan.tiles = json.at("tiles").get<std::int64_t>();
    const Json& window = json.at("window");
    plan.window = {window.at(0).get<std::int32_t>(), window.at(1).get<std::int32_t>(),
                   window.at(2).get<std::int32_t>(), window.at(3).get<std::int32_t>()};
    for (const Json& file : json.at("files"))
        plan.files.push_back({from_json(file.at("name").get<std::string>()),
                              file.at("bytes").get<std::int64_t>(), file.at("modified").get<std::int64_t>()});
    return plan;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
    throw InputError("'" + path.string() + "' " + why +
                     "; run 'dem2buildings_tiles plan' with a new work folder.");
}

}  // namespace

void write_plan(const std::filesystem::path& work, const TilePlan& plan, const TileCost& cost) {
    const std::filesystem::path path = path_of(work);
    const std::filesystem::path hidden = work / (".plan.json." + std::to_string(::getpid()));
    try {
        std::filesystem::create_directories(work);
        {
            std::ofstream file(hidden, std::ios::binary);
            file << json_of(plan, cost).dump(2) << '\n';
            file.flush();
            if (!file)
                throw std::system_error(errno, std::generic_category());
        }
        sync_to_disk(hidden);
        std::filesystem::rename(hidden, path);
    } catch (const std::system_error& error) {
        std::error_code ignored;
        std::filesystem::remove(hidden, ignored);
        throw OutputError("'" + path.string() + "' cannot be written: " + error.code().message() +
                          "; give another work folder, or make room in this one.");
    }
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
    const std::string bytes = std::move(text).str();
    const Json json = Json::parse(bytes, nullptr, false);
    try {
        if (!json.is_object() || json.value("program", "") != program)
            refuse(path, "is no plan, or a part of one");
        if (json.value("version", "") != version)
            refuse(path, "was written by another version of dem2buildings");
        KnownPlan known{plan_of(json), {}};
        if (known.plan.side < 1)
            refuse(path, "is no plan, or a part of one");
        known.work = {work, digest_of(std::as_bytes(std::span(bytes))), known.plan.side, {}};
        return known;
    } catch (const nlohmann::json::exception&) {
        refuse(path, "is no plan, or a part of one");
    }
}

}  // namespace d2b
