#include "sample_files.hpp"

#include <stdexcept>

namespace d2b::test {

namespace {

Dataset open(const std::string& path, unsigned flags) {
    GDALAllRegister();
    Dataset dataset(GDALDataset::Open(path.c_str(), flags | GDAL_OF_VERBOSE_ERROR));
    if (!dataset)
        throw std::runtime_error("cannot open " + path);
    return dataset;
}

std::string authority_code(const OGRSpatialReference* crs) {
    if (crs == nullptr || crs->GetAuthorityCode(nullptr) == nullptr)
        return {};
    return std::string(crs->GetAuthorityName(nullptr)) + ":" + crs->GetAuthorityCode(nullptr);
}

Footprint footprint(const OGRFeature& feature) {
    Footprint result;
    for (int i = 0; i < feature.GetFieldCount(); ++i)
        result.fields +=
            std::string(feature.GetFieldDefnRef(i)->GetNameRef()) + "=" + feature.GetFieldAsString(i) + ";";
    if (feature.GetFieldIndex("kind") >= 0) {
        result.kind = feature.GetFieldAsString("kind");
        result.roof = feature.GetFieldAsString("roof");
        result.unit = feature.GetFieldAsString("unit");
        result.ground = feature.GetFieldAsDouble("ground");
        result.eave_h = feature.GetFieldAsDouble("eave_h");
        result.roof_h = feature.GetFieldAsDouble("roof_h");
        result.width_m = feature.GetFieldAsDouble("width_m");
        result.length_m = feature.GetFieldAsDouble("length_m");
    }
    result.polygon.reset(feature.GetGeometryRef()->toPolygon()->clone());
    result.area = result.polygon->get_Area();
    std::vector<unsigned char> wkb(static_cast<std::size_t>(result.polygon->WkbSize()));
    OGR_G_ExportToWkb(OGRGeometry::ToHandle(result.polygon.get()), wkbNDR, wkb.data());
    result.wkb.assign(wkb.begin(), wkb.end());
    return result;
}

}  // namespace

OGRPoint Raster::centre(int row, int col) const {
    return {transform[0] + (col + 0.5) * transform[1], transform[3] + (row + 0.5) * transform[5]};
}

Raster read_raster(const std::string& folder, const std::string& name) {
    const Dataset dataset = open(folder + "/" + name + ".tif", GDAL_OF_RASTER);
    Raster raster;
    raster.cols = dataset->GetRasterXSize();
    raster.rows = dataset->GetRasterYSize();
    dataset->GetGeoTransform(raster.transform.data());
    raster.crs = authority_code(dataset->GetSpatialRef());
    GDALRasterBand* const band = dataset->GetRasterBand(1);
    raster.unit = band->GetUnitType();
    int has_nodata = 0;
    raster.nodata = band->GetNoDataValue(&has_nodata);
    raster.has_nodata = has_nodata != 0;
    raster.z.resize(static_cast<std::size_t>(raster.cols) * static_cast<std::size_t>(raster.rows));
    if (band->GetRasterDataType() != GDT_Float32 ||
        band->RasterIO(GF_Read, 0, 0, raster.cols, raster.rows, raster.z.data(), raster.cols, raster.rows,
                       GDT_Float32, 0, 0, nullptr) != CE_None)
        throw std::runtime_error("cannot read " + name);
    return raster;
}

bool Footprint::contains(const OGRPoint& p) const {
    bool inside = polygon->getExteriorRing()->isPointInRing(&p) != 0;
    for (int i = 0; i < polygon->getNumInteriorRings(); ++i)
        inside = inside && polygon->getInteriorRing(i)->isPointInRing(&p) == 0;
    return inside;
}

std::vector<TruthLayer> read_truth(const std::string& folder, const std::string& file) {
    const Dataset dataset = open(folder + "/" + file, GDAL_OF_VECTOR);
    std::vector<TruthLayer> layers;
    for (OGRLayer* layer : dataset->GetLayers()) {
        TruthLayer& truth = layers.emplace_back();
        truth.name = layer->GetName();
        truth.crs = authority_code(layer->GetSpatialRef());
        for (const auto& feature : *layer)
            truth.footprints.push_back(footprint(*feature));
    }
    return layers;
}

TruthLayer truth_of(const std::string& sample) {
    const bool town = sample == "town";
    for (TruthLayer& layer : read_truth(D2B_SAMPLES, town ? "town_truth.gpkg" : "samples_truth.gpkg")) {
        if (layer.name == (town ? "buildings" : sample))
            return std::move(layer);
    }
    throw std::runtime_error("no truth for " + sample);
}

}  // namespace d2b::test
