#include "write/database_turn.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "write/sql.hpp"

namespace d2b {

namespace {

using std::chrono::milliseconds;

/// Longest time that one attempt waits for a server.
constexpr milliseconds patience(2000);

/// Returns the existing tables of our layers, quoted.
std::vector<std::string> our_tables(GDALDatasetH database, std::span<const LayerSpec> layers) {
    std::vector<std::string> found;
    for (const LayerSpec& spec : layers)
        if (OGRLayerH layer = GDALDatasetGetLayerByName(database, spec.name.c_str()))
            found.push_back(sql_name(OGR_L_GetName(layer)));
    // A fixed order prevents deadlocks.
    std::sort(found.begin(), found.end());
    return found;
}

/// Statement that changes nothing, but waits for other writers.
std::string statement(const VectorFormat& format, const std::vector<std::string>& tables) {
    if (format.name != "PostgreSQL")
        return "DELETE FROM " + tables.front() + " WHERE 0";
    std::string list;
    for (const std::string& table : tables)
        list += (list.empty() ? "" : ", ") + table;
    return "SET LOCAL lock_timeout = " + std::to_string(patience.count()) + "; LOCK TABLE " + list +
           " IN SHARE ROW EXCLUSIVE MODE";
}

}  // namespace

bool take_turn(const WriteTarget& target, GDALDatasetH database, const VectorFormat& format,
               std::span<const LayerSpec> layers) {
    const std::vector<std::string> names = our_tables(database, layers);
    const bool sqlite = GDALGetInternalHandle(database, "SQLITE_HANDLE") != nullptr;
    if (names.empty() || !(sqlite || format.name == "PostgreSQL"))
        return true;
    const auto start = std::chrono::steady_clock::now();
    OgrCall call(target);
    sql_run(database, statement(format, names));
    // Messages of a server depend on its language, so a lock conflict is recognized by the time waited.
    const bool kept_waiting = sqlite ? call.reason().find("locked") != std::string::npos
                                     : std::chrono::steady_clock::now() - start >= patience * 9 / 10;
    if (!call.succeeded() && kept_waiting)
        return false;
    call.check(true, "taking its turn");
    return true;
}

}  // namespace d2b
