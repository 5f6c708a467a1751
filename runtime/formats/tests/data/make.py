"""Makes the NetCDF files of this folder with software that is not ours: `python3 make.py`, with numpy, scipy and netCDF4."""

import numpy as np
from netCDF4 import Dataset
from scipy.io import netcdf_file

CUT = "../../../../missions/bathymetry/gulf_of_maine.csv"
elevation = np.loadtxt(CUT, delimiter=",", comments="#")
rows, columns = elevation.shape
lat = np.linspace(41.0, 44.5, rows)
lon = np.linspace(289.00268, 293.91939, columns)

# CDF-1, by scipy: elevations in single precision, as GMT and NCEI write them, and a text of odd length to be padded.
with netcdf_file("gulf_of_maine.nc", "w", version=1) as f:
    f.title = "ETOPO5 cut"
    for name, values, units in (("lat", lat, "degrees_north"), ("lon", lon, "degrees_east")):
        f.createDimension(name, len(values))
        variable = f.createVariable(name, "f8", (name,))
        variable[:] = values
        variable.units = units
    z = f.createVariable("elevation", "f4", ("lat", "lon"))
    z[:] = elevation
    z.units = "meters"
    z._FillValue = np.float32(-99999.0)

# CDF-2, by the netCDF library: packed depths, positive down, beside a variable of another size.
with Dataset("gulf_of_maine_packed.nc", "w", format="NETCDF3_64BIT_OFFSET") as f:
    f.createDimension("latitude", rows)
    f.createDimension("longitude", columns)
    f.createDimension("corner", 2)
    f.createVariable("bounds", "f8", ("latitude", "corner"))[:] = 0.0
    for name, values, units in (("latitude", lat, "degrees_north"), ("longitude", lon, "degrees_east")):
        variable = f.createVariable(name, "f4", (name,))
        variable[:] = values
        variable.units = units
    z = f.createVariable("depth", "i2", ("latitude", "longitude"), fill_value=np.int16(-32768))
    z.units = "m"
    z.positive = "down"
    z.scale_factor = 0.25
    z.add_offset = 1000.0
    z[:] = -elevation

# A small grid in metres, of four rows by five cells, with a byte variable that is padded.
with netcdf_file("metres.nc", "w", version=1) as f:
    for name, values in (("y", [-15.0, -5.0, 5.0, 15.0]), ("x", [0.0, 10.0, 20.0, 30.0, 40.0])):
        f.createDimension(name, len(values))
        variable = f.createVariable(name, "f8", (name,))
        variable[:] = values
        variable.units = "m"
    f.createVariable("quality", "b", ("y",))[:] = [1, 2, 3, 4]
    z = f.createVariable("z", "f4", ("y", "x"))
    z[:] = -np.arange(20.0).reshape(4, 5)
    z.units = "m"

# The same in the format that is not read.
with Dataset("metres_hdf5.nc", "w", format="NETCDF4") as f:
    f.createDimension("y", 4)
