#!/usr/bin/env python3
"""make_mosaic.py <raster> <columns> <rows> <dst.vrt>: a mosaic that shows a raster so many times side by side."""
import sys

from osgeo import gdal

gdal.UseExceptions()
name, across, down, destination = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
source = gdal.Open(name)
cols, rows = source.RasterXSize, source.RasterYSize
vrt = gdal.GetDriverByName("VRT").Create("", cols * across, rows * down, 1, source.GetRasterBand(1).DataType)
vrt.SetProjection(source.GetProjection())
vrt.SetGeoTransform(source.GetGeoTransform())
band = vrt.GetRasterBand(1)
if (nodata := source.GetRasterBand(1).GetNoDataValue()) is not None:
    band.SetNoDataValue(nodata)
for i in range(across * down):
    band.SetMetadataItem(f"source_{i}", f"""<SimpleSource>
      <SourceFilename relativeToVRT="0">{name}</SourceFilename><SourceBand>1</SourceBand>
      <SourceProperties RasterXSize="{cols}" RasterYSize="{rows}" DataType="{gdal.GetDataTypeName(source.GetRasterBand(1).DataType)}"
        BlockXSize="{source.GetRasterBand(1).GetBlockSize()[0]}" BlockYSize="{source.GetRasterBand(1).GetBlockSize()[1]}"/>
      <SrcRect xOff="0" yOff="0" xSize="{cols}" ySize="{rows}"/>
      <DstRect xOff="{i % across * cols}" yOff="{i // across * rows}" xSize="{cols}" ySize="{rows}"/>
    </SimpleSource>""", "new_vrt_sources")
with open(destination, "w") as file:
    file.write(vrt.GetMetadata("xml:VRT")[0])
