#include "write/vector/dataset_writer.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "write/geopackage/geopackage_tables.hpp"
#include "write/ogr_util.hpp"
#include "write/postgresql/postgresql.hpp"
#include "write/qgis/qgis_style.hpp"
#include "write/staging.hpp"
#include "write/vector/vector_format.hpp"

namespace d2b::writing {

namespace {

using std::chrono::milliseconds;

/// Longest time that one attempt waits for a server.
constexpr milliseconds lock_timeout(2000);

/// Returns the existing tables of our layers, quoted.
std::vector<std::string> our_tables(GDALDatasetH database, std::span<const LayerSpec> layers) {
    std::vector<std::string> found;
    for (const LayerSpec& spec : layers)
        if (OGRLayerH layer = GDALDatasetGetLayerByName(database, spec.name.c_str()))
            found.push_back(sql_identifier(OGR_L_GetName(layer)));
    // A fixed order prevents deadlocks.
    std::sort(found.begin(), found.end());
    return found;
}

/// Statement that changes nothing, but waits for other writers.
std::string lock_statement(const VectorFormat& format, const std::vector<std::string>& tables) {
    if (format.name != "PostgreSQL")
        return "DELETE FROM " + tables.front() + " WHERE 0";
    std::string list;
    for (const std::string& table : tables)
        list += (list.empty() ? "" : ", ") + table;
    return "SET LOCAL lock_timeout = " + std::to_string(lock_timeout.count()) + "; LOCK TABLE " + list +
           " IN SHARE ROW EXCLUSIVE MODE";
}

/// Features per transaction of a new dataset; large, because each commit waits for the disk.
constexpr std::int64_t batch = 200'000;

/// Returns the state of a database and its log. Ignores an empty log, because opening the database creates
/// one.
std::string stamp_of_database(const std::string& path) {
    const std::string log = path + "-wal";
    std::error_code error;
    const auto size = std::filesystem::file_size(log, error);
    return stamp_of(error || size == 0 ? std::vector{path} : std::vector{path, log});
}

/// Takes a write lock on our layers until the transaction ends, so that values read from them stay true.
/// Needed because SQLite transactions begin as readers and PostgreSQL lets two writers run concurrently.
/// @return false if others held the database during the whole attempt; the transaction is then useless
/// @throws OutputError if the database refuses
bool acquire_write_lock(const WriteTarget& target, GDALDatasetH database, const VectorFormat& format,
                        std::span<const LayerSpec> layers) {
    const std::vector<std::string> names = our_tables(database, layers);
    const bool sqlite = GDALGetInternalHandle(database, "SQLITE_HANDLE") != nullptr;
    if (names.empty() || !(sqlite || format.name == "PostgreSQL"))
        return true;
    const auto start = std::chrono::steady_clock::now();
    OgrCall call(target);
    sql_run(database, lock_statement(format, names));
    // Messages of a server depend on its language, so a lock conflict is recognized by the time waited.
    const bool lock_timed_out = sqlite ? call.reason().find("locked") != std::string::npos
                                       : std::chrono::steady_clock::now() - start >= lock_timeout * 9 / 10;
    if (!call.succeeded() && lock_timed_out)
        return false;
    call.check(true, "waiting for the lock");
    return true;
}

}  // namespace

DatasetWriter::DatasetWriter(WriteTarget target, const VectorFormat& format, const WriteOptions& options)
    : target_(std::move(target)), format_(format), options_(options) {
    // GDAL 3.10 and later write placemark names into our field "id", which holds integers.
    if (format_.name == "LIBKML")
        no_id_field_.emplace("LIBKML_ID_FIELD", "placemark_id", true);
}

DatasetWriter::~DatasetWriter() {
    const reading::GdalMessages quiet;
    const bool undo = changes_in_place();
    if (in_transaction_)
        GDALDatasetRollbackTransaction(dataset_.get());
    layers_.clear();
    dataset_.reset();
    // After a disk error SQLite leaves the rollback to the next program that opens the file for writing.
    if (undo)
        open_dataset(format_, path_, GDAL_OF_UPDATE);
}

void DatasetWriter::open(const std::string& path, Mode mode) {
    OgrCall call(target_);
    path_ = path;
    if (mode == Mode::create) {
        NameValueList options(options_.dataset_options);
        // A GML names its schema file, and cannot be read if that name is not UTF-8.
        const std::string file = std::filesystem::path(path).filename().string();
        if (format_.name == "GML" && utf8_text(file) != file && !options.has("XSISCHEMA") &&
            !options.has("XSISCHEMAURI"))
            options.set("XSISCHEMA", "OFF");
        dataset_.reset(GDALCreate(format_.driver, path.c_str(), 0, 0, 0, GDT_Unknown, options.get()));
        call.check(dataset_ != nullptr, "creating the " + format_.name + " dataset");
    } else {
        dataset_ = open_dataset(format_, path, GDAL_OF_UPDATE);
        call.check(dataset_ != nullptr, "opening it for writing");
    }
    mode_ = mode;
    transactions_ = has_native_transactions(dataset_.get());
}

void DatasetWriter::start_transaction() {
    if (!transactions_)
        return;
    OgrCall call(target_);
    in_transaction_ = GDALDatasetStartTransaction(dataset_.get(), FALSE) == OGRERR_NONE;
    call.check(in_transaction_, "starting a transaction");
    uncommitted_ = 0;
}

void DatasetWriter::require_transaction() const {
    if (guard_.rolled_back())
        throw OutputError("Cannot write \"" + target_.name +
                          "\": SQLite rolled back all changes, which happens if a disk is full or fails.");
}

void DatasetWriter::commit() {
    if (!in_transaction_)
        return;
    require_transaction();
    OgrCall call(target_);
    const bool done = GDALDatasetCommitTransaction(dataset_.get()) == OGRERR_NONE;
    in_transaction_ = !done;
    call.check(done, "committing the transaction");
}

void DatasetWriter::open_locked(const std::string& path, Mode mode) {
    constexpr std::chrono::seconds longest_wait(60);
    const auto start = std::chrono::steady_clock::now();
    for (;;) {
        const std::string stamp = stamp_of_database(path);
        open(path, mode);
        start_transaction();
        if (!in_transaction_ || mode == Mode::create)
            return;
        const bool ours = acquire_write_lock(target_, dataset_.get(), format_, specs_);
        // Retry if the database changed after opening, because the driver has cached its contents.
        if (ours && stamp_of_database(path) == stamp)
            break;
        GDALDatasetRollbackTransaction(dataset_.get());
        in_transaction_ = false;
        dataset_.reset();
        target_.stop.check();
        if (!ours)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (std::chrono::steady_clock::now() - start > longest_wait)
            throw OutputError(
                "Cannot write \"" + target_.name +
                "\": another program has been writing to it for a minute; run again when it is done.");
    }
    guard_.watch(dataset_.get());
}

void DatasetWriter::begin(const std::string& path, Mode mode, std::span<const LayerSpec> specs,
                          const Provenance& provenance) {
    specs_.assign(specs.begin(), specs.end());
    pending_.resize(specs_.size());
    provenance_ = provenance;
    srs_ = srs_of(provenance.crs_wkt, target_);
    if (mode == Mode::extend && !format_.transactions)
        first_id_ = largest_id(target_, format_, path, specs) + 1;
    open_locked(path, mode);
    if (mode == Mode::extend && in_transaction_)
        first_id_ = largest_id(target_, dataset_.get(), specs) + 1;
    if (mode == Mode::replace)
        remove_layers();
    if (mode == Mode::create)
        describe(dataset_.get());
    // Formats such as KML write layers sequentially, so later layers wait in memory.
    const bool one_by_one =
        mode == Mode::create && GDALDatasetTestCapability(dataset_.get(), ODsCRandomLayerWrite) == FALSE;
    for (std::size_t i = 0; i < specs_.size() && (i == 0 || !one_by_one); ++i)
        open_layer(specs_[i]);
    if (mode == Mode::create) {
        create_tables();
        defer_indices();
        return;
    }
    // Flush now, because a driver with pending layers or metadata writes them even after a rollback.
    OgrCall call(target_);
    GDALFlushCache(dataset_.get());
    call.check(true, "creating the layers");
    defer_indices();
}

void DatasetWriter::create_tables() {
    if (!transactions_)
        return;
    // SQL drivers create a table on first use, that is in the order of features instead of layers. Reading
    // creates it too, and defers spatial indices.
    OgrCall call(target_);
    for (const LayerWriter& layer : layers_) {
        OGR_L_ResetReading(layer.handle());
        const reading::FeatureOwner none(OGR_L_GetNextFeature(layer.handle()));
    }
    call.check(true, "creating the layers");
}

void DatasetWriter::defer_indices() {
    const NameValueList chosen(options_.layer_options);
    if (format_.name != "GPKG" || !transactions_ || mode_ == Mode::extend || chosen.has("SPATIAL_INDEX"))
        return;
    // Boxes of features that are copied are not known here.
    for (std::size_t i = 0; i < layers_.size(); ++i)
        if (specs_[i].original == nullptr)
            layers_[i].defer_index(dataset_.get());
}

void DatasetWriter::remove_layers() {
    std::vector<std::string> there;
    for (const LayerSpec& spec : specs_)
        if (OGRLayerH layer = GDALDatasetGetLayerByName(dataset_.get(), spec.name.c_str()))
            there.emplace_back(OGR_L_GetName(layer));
    if (in_transaction_ && GDALGetInternalHandle(dataset_.get(), "SQLITE_HANDLE") != nullptr) {
        dependents_.emplace(dataset_.get(), there);
        // Have GDAL read the metadata of listed views now, because it counts their rows first, which it could
        // not without their table.
        for (int i = 0; i < GDALDatasetGetLayerCount(dataset_.get()); ++i)
            GDALGetMetadataItem(GDALDatasetGetLayer(dataset_.get(), i), "IDENTIFIER", nullptr);
    }
    for (const std::string& name : there)
        remove_layer(name);
}

void DatasetWriter::remove_layer(const std::string& name) {
    for (int i = GDALDatasetGetLayerCount(dataset_.get()) - 1; i >= 0; --i) {
        if (!EQUAL(OGR_L_GetName(GDALDatasetGetLayer(dataset_.get(), i)), name.c_str()))
            continue;
        OgrCall call(target_);
        const bool done = GDALDatasetDeleteLayer(dataset_.get(), i) == OGRERR_NONE;
        call.check(done, "replacing layer \"" + name + "\"");
    }
}

void DatasetWriter::open_layer(const LayerSpec& spec) {
    const LayerSettings setting{target_, format_, options_.layer_options, srs_.get()};
    OGRLayerH layer = mode_ == Mode::extend ? find_layer(dataset_.get(), format_, spec.name) : nullptr;
    if (layer != nullptr) {
        require_same_provenance(layer, provenance_, target_);
        layers_.push_back(LayerWriter::adopt(layer, spec, setting));
        if (in_transaction_)
            layers_.back().set_feature_count(count_rows(target_, dataset_.get(), layers_.back().name()));
        return;
    }
    layers_.push_back(LayerWriter::create(dataset_.get(), spec, setting));
    describe(layers_.back().handle());
}

void DatasetWriter::describe(GDALMajorObjectH object) {
    // Ignore errors of formats that cannot store metadata, because the result is complete without it.
    const reading::GdalMessages quiet;
    for (const auto& [name, value] : provenance_.metadata)
        GDALSetMetadataItem(object, name.c_str(), value.c_str(), nullptr);
}

void DatasetWriter::add(std::size_t layer, const Feature& feature) {
    if (layer >= specs_.size())
        throw OutputError("Cannot write \"" + target_.name + "\": it has no layer number " +
                          std::to_string(layer) + ".");
    if (layer >= layers_.size()) {
        pending_[layer].push_back(feature);
        return;
    }
    layers_[layer].add(feature);
    if (mode_ == Mode::create && in_transaction_ && ++uncommitted_ >= batch) {
        commit();
        start_transaction();
    }
}

void DatasetWriter::write_pending() {
    while (layers_.size() < specs_.size()) {
        const std::size_t next = layers_.size();
        open_layer(specs_[next]);
        for (const Feature& feature : pending_[next])
            layers_[next].add(feature);
        pending_[next] = {};
    }
}

void DatasetWriter::add_layer_tables() {
    const bool geopackage = format_.name == "GPKG" && transactions_;
    if (geopackage) {
        // GDAL creates its own metadata tables after the layers, so let it do so first.
        OgrCall call(target_);
        GDALFlushCache(dataset_.get());
        call.check(true, "writing the layers");
        if (mode_ == Mode::replace)
            replace_dataset_metadata(dataset_.get(), provenance_, target_);
    }
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        if (!layers_[i].is_new())
            continue;
        const NewLayer layer{specs_[i], layers_[i].name(), OGR_L_GetGeometryColumn(layers_[i].handle()),
                             layers_[i].columns(), layers_[i].take_heights()};
        if (geopackage)
            write_geopackage_tables(dataset_.get(), layer, provenance_, target_);
        else if (format_.name == "PostgreSQL")
            complete_postgresql_table(dataset_.get(), layer, target_);
        else if (format_.name == "ESRI Shapefile")
            write_style_sidecar(path_, layer);
    }
}

void DatasetWriter::complete() {
    write_pending();
    for (LayerWriter& layer : layers_) {
        layer.finish();
        counts_.emplace_back(layer.name(), layer.feature_count());
    }
    add_layer_tables();
    if (dependents_)
        dependents_->recreate(target_);
    require_transaction();
    if (changes_in_place())
        check_counts(target_, dataset_.get(), counts_);
    complete_ = true;
}

void DatasetWriter::close() {
    if (!complete_)
        complete();
    commit();
    layers_.clear();
    close_written(target_, std::move(dataset_));
}

}  // namespace d2b::writing
