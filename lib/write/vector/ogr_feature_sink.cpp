#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sinks.hpp"
#include "read/gdal_setup.hpp"
#include "read/vector_layer.hpp"
#include "write/destination.hpp"
#include "write/io_error_monitor.hpp"
#include "write/qgis/qgis_style.hpp"
#include "write/staging.hpp"
#include "write/standard_output.hpp"
#include "write/vector/dataset_writer.hpp"
#include "write/vector/dxf_sink.hpp"
#include "write/vector/layer_names.hpp"
#include "write/vector/preflight.hpp"

namespace d2b::writing {
namespace {

/// Transaction that changes layers of a database in place.
class PendingTransaction final : public PendingResult {
  public:
    PendingTransaction(DatasetWriter& writer, std::string name) : writer_(writer), name_(std::move(name)) {}

    [[nodiscard]] Kind kind() const override { return Kind::transaction; }
    void show() override { writer_.close(); }
    [[nodiscard]] std::string roll_back() override { return "\"" + name_ + "\" has been changed already"; }

  private:
    DatasetWriter& writer_;
    std::string name_;
};

class OgrFeatureSink final : public FileSink<FeatureSink> {
  public:
    OgrFeatureSink(WriteOptions options, VectorFormat format, Destination destination,
                   std::optional<ExistingDataset> existing, StopToken stop)
        : options_(std::move(options)),
          format_(std::move(format)),
          destination_(std::move(destination)),
          existing_(std::move(existing)),
          stop_(std::move(stop)) {
        warnings_.hold();
    }

    void require_crs(const std::string& wkt, const std::string& name, const Position& place) override;
    void preflight(std::span<const LayerSpec> layers, const Provenance& provenance,
                   const Position& place) override;
    void begin(std::span<const LayerSpec> layers, const Provenance& provenance) override;
    void add(std::size_t layer, const Feature& feature) override { writer_->add(layer, feature); }
    [[nodiscard]] CoordinateRounding rounding() const override {
        return rounding_.value_or(CoordinateRounding());
    }
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return warnings_.take(); }
    [[nodiscard]] std::int64_t first_id() const override { return writer_ ? writer_->first_id() : 1; }
    [[nodiscard]] bool takes_points() const override { return format_.multiple_layers; }
    [[nodiscard]] Layers layers(std::optional<Layers> asked) const override {
        return resolve_layers(options_, asked, format_);
    }
    [[nodiscard]] std::string layer_name(LayerRole role, Layers layers) const override {
        return name_of(options_, format_, role, layers);
    }

  private:
    /// True if layers of an existing database are changed in one transaction.
    [[nodiscard]] bool in_place() const { return existing_ && format_.transactions; }
    [[nodiscard]] DatasetWriter::Mode mode() const;
    [[nodiscard]] ReplacedFiles old_files() const { return existing_ ? existing_->old : ReplacedFiles{}; }

    WriteOptions options_;
    VectorFormat format_;
    Destination destination_;
    std::optional<ExistingDataset> existing_;
    std::optional<CoordinateRounding> rounding_ = CoordinateRounding();  ///< nothing if not decimal
    StopToken stop_;
    Warnings warnings_;
    std::optional<PendingFiles> files_;
    std::optional<CapturedOutput> captured_;
    std::optional<IoErrorMonitor> monitor_;
    WriteTarget target_;
    std::optional<DatasetWriter>
        writer_;  ///< declared after the staging folder, because it must be destroyed first
    std::optional<PendingTransaction> transaction_;
};

DatasetWriter::Mode OgrFeatureSink::mode() const {
    if (!existing_)
        return DatasetWriter::Mode::create;
    if (!options_.overwrite)
        return DatasetWriter::Mode::extend;
    // Databases are never replaced as a whole.
    return format_.transactions || is_connection(format_.driver, destination_.path)
               ? DatasetWriter::Mode::replace
               : DatasetWriter::Mode::create;
}

void OgrFeatureSink::require_crs(const std::string& wkt, const std::string& name, const Position& place) {
    if (!format_.preserves_crs)
        return;
    const CrsMismatch mismatch = find_crs_mismatch(format_, destination_.name, wkt, place);
    const std::string what = format_.name + " cannot hold the coordinate reference system '" + name + "'";
    if (!mismatch.lost.empty())
        throw OutputError("Cannot write \"" + destination_.name + "\": " + what + " (" + mismatch.lost +
                          "); choose another one with -t_srs, or another format.");
    if (!mismatch.read_as.empty())
        warnings_.add(what + ": programs will take the coordinates of \"" + destination_.name + "\" for '" +
                      mismatch.read_as + "'; choose that one with -t_srs, or another format.");
}

void OgrFeatureSink::preflight(std::span<const LayerSpec> layers, const Provenance& provenance,
                               const Position& place) {
    const PlannedOutput draft{destination_, format_, options_, layers, provenance, place};
    const bool is_exact = format_.transactions || is_connection(format_.driver, destination_.path);
    if (mode() == DatasetWriter::Mode::extend) {
        preflight_append(draft);
        if (!is_exact)
            rounding_ = coordinate_rounding(draft, true);
        return;
    }
    if (is_stream(destination_.path))
        preflight_stream(draft);
    // GeoPackage with default options is not tried, because that would take longer than a small raster.
    const bool plain = format_.name == "GPKG" && options_.layer_name.empty() &&
                       options_.layer_options.empty() && options_.dataset_options.empty();
    if (!plain && !is_connection(format_.driver, destination_.path)) {
        TrialDataset trial = preflight_create(draft);
        format_.in_memory = format_.in_memory && trial.in_memory;
        if (destination_.local && mode() == DatasetWriter::Mode::create)
            claim_files(destination_, format_, existing_, std::move(trial.names));
    }
    if (mode() == DatasetWriter::Mode::replace)
        preflight_replace(draft);
    if (!is_exact)
        rounding_ = coordinate_rounding(draft, false);
}

void OgrFeatureSink::begin(std::span<const LayerSpec> layers, const Provenance& provenance) {
    target_ = {.name = destination_.name, .hidden_folder = "", .warnings = &warnings_, .stop = stop_};
    std::string path = destination_.path;
    if (destination_.local && !in_place()) {
        files_.emplace(PendingResult::Kind::dataset, destination_.name, destination_.path, old_files(),
                       warnings_);
        StagingFolder& staging = files_->staging();
        const bool monitored = !format_.transactions && format_.in_memory;
        const auto called = [&](const std::filesystem::path& file) {
            return monitored ? monitor_->name_of(file.string()) : file.string();
        };
        if (monitored)
            target_.monitor = &monitor_.emplace();
        target_.hidden_folder = called(staging.folder()) + "/";
        path = called(staging.dataset());
        if (mode() == DatasetWriter::Mode::extend) {
            require_unchanged(destination_.name, existing_->old);
            staging.copy_in(existing_->old.files);
        }
    } else if (existing_ && mode() == DatasetWriter::Mode::create) {
        const reading::GdalMessages quiet;
        GDALDeleteDataset(format_.driver, path.c_str());
    }
    if (path.find("/vsistdout") != std::string::npos) {
        captured_.emplace();
    } else if (is_stream(path)) {
        captured_.emplace(path);
        path = "/vsistdout/";
    }
    // Prevent .aux.xml files of formats without metadata, because they would outlive a rollback.
    const reading::NoSidecar no_sidecar;
    // Staged files are synced once before the rename, so SQLite need not sync earlier.
    std::optional<CPLConfigOptionSetter> no_waiting;
    if (files_)
        no_waiting.emplace("OGR_SQLITE_SYNCHRONOUS", "OFF", true);
    writer_.emplace(target_, format_, options_);
    writer_->begin(path, mode(), layers, provenance);
}

void OgrFeatureSink::prepare(CommitList& commit) {
    writer_->complete();
    if (writer_->changes_in_place()) {
        commit.add(transaction_.emplace(*writer_, destination_.name));
        return;
    }
    writer_->close();
    if (captured_) {
        captured_->require_captured();
        commit.add(*captured_);
    } else if (files_) {
        StagingFolder& staging = files_->staging();
        keep_user_styles(staging.dataset(), destination_.path, existing_.has_value());
        staging.seal();
        verify_counts(target_, format_, staging.dataset().string(), writer_->counts());
        if (!rounding_)
            warn_of_invalid(target_, format_, staging.dataset().string());
        staging.sync();
        commit.add(*files_);
    } else {
        verify_counts(target_, format_, destination_.path, writer_->counts());
    }
}

std::optional<ExistingDataset> find_existing(Destination& destination, VectorFormat& format,
                                             const WriteOptions& options, Layers layers) {
    const std::vector<std::string> names = names_of(options, format, layers);
    if (is_connection(format.driver, options.destination))
        return inspect_database(destination, format, options, names);
    if (destination.exists)
        return inspect_existing(destination, format, options, names);
    return std::nullopt;
}

/// True if both names are the same file, also by way of links.
bool is_same_dataset(const std::string& one, const std::string& other) {
    std::error_code error;
    return one == other || std::filesystem::equivalent(one, other, error);
}

/// Polygons that an option reads.
struct InputPolygons {
    std::string option;
    std::string path;
    std::string layer;  ///< "": the first one
};

/// Refuses to replace a whole file that an option reads. @return true if the destination is this file, so
/// that its layers may be replaced
/// @throws OptionError
bool keep_file(const WriteOptions& options, const InputPolygons& input) {
    if (!options.overwrite || input.path.empty() || !is_same_dataset(input.path, options.destination))
        return false;
    if (!format_for(options).transactions)
        throw OptionError("\"" + options.destination + "\" is the file of " + input.option +
                          ", which -overwrite would replace; write to another file.");
    return true;
}

/// Refuses to replace what an option reads: its layer, or its file if -overwrite replaces it whole.
/// @throws OptionError
void keep_input(const WriteOptions& options, const InputPolygons& input) {
    if (!keep_file(options, input))
        return;
    const VectorFormat format = format_for(options);
    const std::string layer = reading::layer_name(input.path, input.layer);
    for (const std::string& name : names_of(options, format, resolve_layers(options, options.layers, format)))
        if (EQUAL(name.c_str(), layer.c_str()))
            throw OptionError("The layer \"" + layer + "\" of \"" + options.destination + "\" is that of " +
                              input.option +
                              ", which -overwrite would replace; give another name with -nln.");
}

}  // namespace
}  // namespace d2b::writing

namespace d2b {

void keep_inputs(const Options& options) {
    const DetectOptions& detect = options.detect;
    reading::register_formats();
    const writing::InputPolygons corrections{"-corrections", detect.corrections, detect.corrections_layer};
    if (corrections.layer.empty())
        writing::keep_file(options.write, corrections);  // its layers may have any name
    else
        writing::keep_input(options.write, corrections);
    writing::keep_input(options.write, {"-exclude", detect.exclude, detect.exclude_layer});
    writing::keep_input(options.write, {"-split_by", detect.split_by, detect.split_layer});
    writing::keep_input(options.write, {"-mask", detect.mask, detect.mask_layer});
    writing::keep_input(options.write, {"-cutline", options.read.cutline, options.read.cutline_layer});
}

std::unique_ptr<FeatureSink> open_sink(const WriteOptions& options, const Callbacks& callbacks) {
    reading::register_formats();
    writing::VectorFormat format = writing::format_for(options);
    const Layers layers = writing::resolve_layers(options, options.layers, format);
    writing::Destination destination = writing::locate(options, format);
    if (writing::is_drawing(format))
        return writing::open_dxf_sink(options, format, destination);
    writing::keep_input(options, {"-footprints", options.footprints, options.footprints_layer});
    std::optional<writing::ExistingDataset> existing =
        writing::find_existing(destination, format, options, layers);
    if (callbacks.on_warning && !options.layers && layers == Layers::buildings)
        callbacks.on_warning("\"" + options.destination + "\" holds one layer; only the " +
                             (options.has_footprints()
                                  ? "footprints are written; use a GeoPackage for their contours and for "
                                    "buildings without one."
                                  : "buildings are written; use -layers contours for the stack, or a "
                                    "GeoPackage for both."));
    return std::make_unique<writing::OgrFeatureSink>(options, std::move(format), std::move(destination),
                                                     std::move(existing), StopToken(callbacks.stop));
}

}  // namespace d2b
