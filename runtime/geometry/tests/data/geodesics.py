"""Reference values for the local frame: positions at a distance and azimuth from an origin, by Karney's geodesics, their
coordinates in a transverse Mercator projection with unit scale at the origin, and the convergence of the meridian there.

    pip install geographiclib==2.1 pyproj==3.7.2 && python3 geodesics.py > geodesics.csv
"""

import geographiclib
import pyproj
from geographiclib.geodesic import Geodesic

ORIGINS = [(0.0, 0.0), (0.0, -90.0), (36.18, -75.74), (-33.9, 179.99), (60.0, -180.0), (70.2, 19.0), (-77.85, 166.6), (89.99, 45.0)]
DISTANCES = [1.0, 400.0, 1_000.0, 5_000.0, 9_000.0, 50_000.0, 100_000.0]
AZIMUTHS = [0.0, 37.0, 90.0, 143.0, 180.0, 215.0, 270.0, 331.0]

print(f"# geographiclib {geographiclib.__version__}, pyproj {pyproj.__version__} with PROJ {pyproj.proj_version_str}, by geodesics.py")
print("origin_latitude_deg,origin_longitude_deg,azimuth_deg,distance_m,latitude_deg,longitude_deg,north_m,east_m,convergence_deg")
for latitude, longitude in ORIGINS:
    plane = pyproj.Proj(proj="tmerc", lat_0=latitude, lon_0=longitude, k=1, ellps="WGS84")
    for distance in DISTANCES:
        for azimuth in AZIMUTHS:
            to = Geodesic.WGS84.Direct(latitude, longitude, azimuth, distance)
            east, north = plane(to["lon2"], to["lat2"])
            convergence = plane.get_factors(to["lon2"], to["lat2"]).meridian_convergence
            print(
                f"{latitude},{longitude},{azimuth},{distance},{to['lat2']:.14f},{to['lon2']:.14f},"
                f"{north:.9f},{east:.9f},{convergence:.9f}"
            )
