#include "write_truth.hpp"

#include <utility>
#include <vector>

#include <cpl_string.h>
#include <ogrsf_frmts.h>

#include "gdal_guard.hpp"
#include "roof_faces.hpp"

namespace d2b::sample {

namespace {

// Time that GeoPackages record as their last change; any fixed moment serves.
constexpr const char* written_at = "2025-01-01T00:00:00.000Z";

struct Field {
    const char* name;
    OGRFieldType type;
};
constexpr Field building_fields[] = {{"id", OFTInteger64}, {"kind", OFTString},  {"roof", OFTString},
                                     {"ground", OFTReal},  {"eave_h", OFTReal},  {"roof_h", OFTReal},
                                     {"unit", OFTString},  {"width_m", OFTReal}, {"length_m", OFTReal}};
constexpr Field parcel_fields[] = {{"parcel", OFTString}};
constexpr Field face_fields[] = {
    {"bldg_id", OFTInteger64}, {"roof_type", OFTString}, {"slope", OFTReal}, {"azimuth", OFTReal}};
constexpr Field change_fields[] = {{"id", OFTInteger64}, {"change", OFTString}};
constexpr Field dissolved_fields[] = {{"id", OFTInteger64}, {"area_m2", OFTReal}};

OGRLinearRing world_ring(const WorldRing& ring, const Grid& grid) {
    OGRLinearRing line;
    for (const Position& p : ring) {
        const Position world = grid.to_world(p);
        line.addPoint(world.x, world.y);
    }
    line.closeRings();
    return line;
}

OGRPolygon world_polygon(const WorldPolygon& polygon, const Grid& grid) {
    OGRPolygon result;
    OGRLinearRing exterior = world_ring(polygon.exterior, grid);
    result.addRing(&exterior);
    for (const WorldRing& interior : polygon.interiors) {
        OGRLinearRing hole = world_ring(interior, grid);
        result.addRing(&hole);
    }
    return result;
}

OGRPolygon world_polygon(const RoofFace& face, const RasterSpec& raster) {
    OGRPolygon result;
    for (const std::vector<RoofCorner>& ring : face.rings) {
        OGRLinearRing line;
        for (const RoofCorner& corner : ring) {
            const Position world = raster.grid.to_world(corner.at);
            line.addPoint(world.x, world.y, corner.elevation / raster.unit.metres);
        }
        line.closeRings();
        result.addRing(&line);
    }
    return result;
}

void set_values(OGRFeature& feature, const Building& building, const VerticalUnit& unit) {
    feature.SetField("id", static_cast<GIntBig>(building.id));
    feature.SetField("kind", building.kind.c_str());
    feature.SetField("roof", std::string(roof_name(building.main_part().roof)).c_str());
    feature.SetField("ground", building.ground / unit.metres);
    feature.SetField("eave_h", building.eave() / unit.metres);
    feature.SetField("roof_h", building.top() / unit.metres);
    feature.SetField("unit", unit.name.c_str());
    feature.SetField("width_m", building.width);
    feature.SetField("length_m", building.length);
}

/// Returns the union of polygons, in pieces that share no wall.
OGRMultiPolygon union_of(const OGRMultiPolygon& all, const std::string& path) {
    OGRMultiPolygon result;
    if (all.IsEmpty())
        return result;
    const std::unique_ptr<OGRGeometry> united(all.UnionCascaded());
    QuietGdal::require(united != nullptr, path);
    if (wkbFlatten(united->getGeometryType()) == wkbPolygon)
        result.addGeometry(united.get());
    else
        result = *united->toMultiPolygon();
    return result;
}

}  // namespace

struct TruthWriter::Impl {
    /// OGR_CURRENT_DATE for this thread while it lives.
    struct FixedDate {
        FixedDate() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", written_at); }
        FixedDate(const FixedDate&) = delete;
        FixedDate& operator=(const FixedDate&) = delete;
        ~FixedDate() { CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", nullptr); }
    };

    QuietGdal quiet;
    FixedDate date;
    std::string path;
    Dataset dataset;

    OGRLayer& add_layer(const std::string& name, const RasterSpec& raster, std::span<const Field> fields,
                        const std::string& description, OGRwkbGeometryType type = wkbPolygon) {
        OGRSpatialReference reference = spatial_reference(raster.crs, path);
        CPLStringList options;
        options.SetNameValue("DESCRIPTION", description.c_str());
        // The index of roof planes would be a quarter of their file.
        options.SetNameValue("SPATIAL_INDEX", type == wkbPolygon ? "YES" : "NO");
        OGRLayer* const layer = dataset->CreateLayer(name.c_str(), &reference, type, options.List());
        QuietGdal::require(layer != nullptr, path);
        for (const Field& field : fields) {
            OGRFieldDefn definition(field.name, field.type);
            QuietGdal::require(layer->CreateField(&definition) == OGRERR_NONE, path);
        }
        QuietGdal::require(dataset->StartTransaction() == OGRERR_NONE, path);
        return *layer;
    }
    void write(OGRLayer& layer, OGRFeature& feature) const {
        QuietGdal::require(layer.CreateFeature(&feature) == OGRERR_NONE, path);
    }
    void commit() const { QuietGdal::require(dataset->CommitTransaction() == OGRERR_NONE, path); }
};

TruthWriter::TruthWriter(std::string path) : impl_(std::make_unique<Impl>()) {
    impl_->path = std::move(path);
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    QuietGdal::require(driver != nullptr, impl_->path);
    VSIUnlink(impl_->path.c_str());
    impl_->dataset.reset(driver->Create(impl_->path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    QuietGdal::require(impl_->dataset != nullptr, impl_->path);
}

TruthWriter::~TruthWriter() = default;

void TruthWriter::add_buildings(const std::string& name, const RasterSpec& raster,
                                std::span<const Building> buildings) {
    OGRLayer& layer =
        impl_->add_layer(name, raster, building_fields,
                         "True footprints; ground is an elevation, eave_h and roof_h are heights above "
                         "it, all in the unit of field unit");
    for (const Building& building : buildings) {
        OGRFeature feature(layer.GetLayerDefn());
        set_values(feature, building, raster.unit);
        const OGRPolygon polygon = world_polygon(building.footprint, raster.grid);
        feature.SetGeometry(&polygon);
        impl_->write(layer, feature);
    }
    impl_->commit();
}

void TruthWriter::add_dissolved(const std::string& name, const RasterSpec& raster,
                                std::span<const Building> buildings) {
    OGRLayer& layer = impl_->add_layer(name, raster, dissolved_fields,
                                       "True footprints without the walls that buildings share");
    OGRMultiPolygon all;
    for (const Building& building : buildings) {
        const OGRPolygon polygon = world_polygon(building.footprint, raster.grid);
        all.addGeometry(&polygon);
    }
    const OGRMultiPolygon united = union_of(all, impl_->path);
    GIntBig id = 0;
    for (const OGRPolygon* polygon : united) {
        OGRFeature feature(layer.GetLayerDefn());
        feature.SetField("id", ++id);
        feature.SetField("area_m2", polygon->get_Area());
        feature.SetGeometry(polygon);
        impl_->write(layer, feature);
    }
    impl_->commit();
}

void TruthWriter::add_roofs(const std::string& name, const RasterSpec& raster,
                            std::span<const Building> buildings) {
    OGRLayer& layer =
        impl_->add_layer(name, raster, face_fields,
                         "True planes of roofs; slope and azimuth in degrees, azimuth clockwise "
                         "from north, in the direction in which water runs",
                         wkbPolygon25D);
    for (const Building& building : buildings) {
        for (const RoofFace& face : roof_faces(building)) {
            OGRFeature feature(layer.GetLayerDefn());
            feature.SetField("bldg_id", static_cast<GIntBig>(building.id));
            feature.SetField("roof_type", std::string(roof_type(building)).c_str());
            feature.SetField("slope", face.slope);
            if (face.azimuth)
                feature.SetField("azimuth", *face.azimuth);
            const OGRPolygon polygon = world_polygon(face, raster);
            feature.SetGeometry(&polygon);
            impl_->write(layer, feature);
        }
    }
    impl_->commit();
}

void TruthWriter::add_parcels(const std::string& name, const RasterSpec& raster,
                              std::span<const Parcel> parcels) {
    OGRLayer& layer = impl_->add_layer(name, raster, parcel_fields, "Plots of land with a house each");
    for (const Parcel& parcel : parcels) {
        OGRFeature feature(layer.GetLayerDefn());
        feature.SetField("parcel", parcel.name.c_str());
        const OGRPolygon polygon = world_polygon(parcel.polygon, raster.grid);
        feature.SetGeometry(&polygon);
        impl_->write(layer, feature);
    }
    impl_->commit();
}

void TruthWriter::add_changes(const std::string& name, const RasterSpec& raster,
                              std::span<const TruthOfChange> changes) {
    OGRLayer& layer =
        impl_->add_layer(name, raster, change_fields, "Buildings of two moments, and their change");
    for (const TruthOfChange& truth : changes) {
        OGRFeature feature(layer.GetLayerDefn());
        feature.SetField("id", static_cast<GIntBig>(truth.building.id));
        feature.SetField("change", std::string(change_name(truth.change)).c_str());
        const OGRPolygon polygon = world_polygon(truth.building.footprint, raster.grid);
        feature.SetGeometry(&polygon);
        impl_->write(layer, feature);
    }
    impl_->commit();
}

void TruthWriter::finish() {
    close(std::move(impl_->dataset), impl_->path);
}

}  // namespace d2b::sample
